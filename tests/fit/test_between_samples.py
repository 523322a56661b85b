"""A prediction from few samples is told, and one from many is not."""

import numpy as np
import pytest

from hysteresis_bench import FitOptions, fit
from hysteresis_bench.signals import Dataset, Record


def loop(samples: int, *, noise: float = 0.0, shape=np.sin) -> Record:
    """Ten cycles of a curve with a loop that is none of Bouc-Wen's own, from rest."""
    time = np.linspace(0.0, 10.0, 10 * samples + 1)
    drive = shape(2.0 * np.pi * time) * np.minimum(time / 3.0, 1.0)
    output = 1.5 * drive - 0.3 * np.tanh(np.gradient(drive, time))
    return Record(
        time, drive, output + noise * np.random.default_rng(0).standard_normal(time.size), f"{samples} a cycle"
    )


@pytest.fixture(scope="module")
def model():
    return fit(Dataset((loop(200, noise=0.01),)), "bouc-wen", options=FitOptions(budget=2000)).model


def told(model, record: Record) -> list[str]:
    return [note for note in model.predict(Dataset((record,))).notes if "samples are few" in note]


@pytest.mark.parametrize(("samples", "few"), [(200, False), (60, False), (5, True)])
def test_a_coarse_record_is_told_with_its_prediction(model, samples, few):
    said = told(model, loop(samples))
    assert bool(said) is few
    assert all(f"record {samples} a cycle" in sentence and "Sample the input faster" in sentence for sentence in said)


def test_straight_pieces_have_nothing_between_their_samples(model):
    assert not told(model, loop(8, shape=lambda angle: 2.0 / np.pi * np.arcsin(np.sin(angle))))
