"""When what lies between the samples is asked for: the sooner, the more samples there are to decide between names."""

from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.reading import between_samples
from hysteresis_bench.signals import Record

FLOOR = 2.0


@pytest.mark.parametrize(
    ("samples", "change", "left", "few"),
    [
        (1500, 0.20, 1.0, True),  # 7.7 standard errors of the noise
        (400, 0.20, 1.0, False),  # 4
        (100, 0.35, 1.0, True),  # 3.5, and 6 % of what is left
        (1500, 0.10, 1.0, False),
        (5000, 0.20, 1.0, False),  # the search takes some of them only
        (1500, 0.20, 1.9, True),  # an effect may make up for it
        (1500, 0.90, 4.0, False),  # 23 % of what a wrong law leaves
        (1500, 1.60, 4.0, True),
    ],
)
def test_the_change_is_held_against_the_noise_or_what_is_left_of_a_wrong_law(monkeypatch, samples, change, left, few):
    """change, left : times the noise"""
    time = np.linspace(0.0, 1.0, samples)
    fitter = SimpleNamespace(
        stack=SimpleNamespace(records=(Record(time, time, time),)),
        fitted=lambda hypothesis: (hypothesis.change, time),
    )
    monkeypatch.setattr(between_samples, "between_samples", lambda system, records, values: FLOOR * system)
    base, best = (SimpleNamespace(change=each, rmse=FLOOR * left) for each in (0.0, change))
    found = SimpleNamespace(full=fitter, selection=SimpleNamespace(floor=FLOOR), base=base, best=best)
    assert between_samples.few_samples(found) is few
