"""A device with two modes, which no resonance can be, is told by its family, and the modes are the true ones."""

import numpy as np
import pytest
from scipy.signal import bilinear, lfilter, lfilter_zi

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.free_forms import with_free_forms
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.signals import Record

pytestmark = pytest.mark.long

TIME = np.linspace(0.0, 4.0, 1000)
TURN = 2.0 * np.pi * TIME
DRIVES = (np.sin(TURN) * TIME / 4.0, 0.4 * (np.sin(1.3 * TURN) + 0.5 * np.sin(3.1 * TURN)))
NOISE = 2e-3
NAMES = ("output-lag", "resonance", "second-order-lag", "transport-delay", "asymmetry")


def mode(x, frequency):
    omega = 2.0 * np.pi * frequency
    b, a = bilinear([omega**2], [1.0, 0.2 * omega, omega**2], 1.0 / TIME[1])
    return lfilter(b, a, x, zi=lfilter_zi(b, a) * x[0])[0]


@pytest.fixture(scope="module")
def asked():
    """The selection among linear dynamics, and what it ends with, by names and with free forms."""
    law, rng = registry.build("models", "bouc-wen"), np.random.default_rng(3)
    p, records = np.array([[0.5], [4.0], [1.0], [0.8]]), []
    for k, drive in enumerate(DRIVES):
        x = System(law, ()).respond(Record(TIME, drive, None), p)[:, 0]
        y = 0.8 * mode(x, 7.0) + 0.2 * mode(x, 17.0) + NOISE * rng.standard_normal(TIME.size)
        records.append(Record(TIME, drive, y, name=str(k)))
    fitter = Fitter(Stack(law, tuple(records)))
    with Workers(fitter, jobs=1) as workers:
        selection = Selection(fitter, workers, NOISE, NAMES)
        named = selection.named(selection.run(fitter.bare(frozenset({registry.RECORD_OFFSET}))))
        return selection, named, with_free_forms(selection, named)


def test_the_family_is_told(asked):
    selection, named, freed = asked
    assert named.rmse > 1.5 * NOISE
    assert selection.adopted(freed) == ("modes-after",)
    assert freed.rmse < 1.05 * NOISE


def test_the_modes_are_the_true_ones(asked):
    _, _, freed = asked
    slow, fast = sorted((freed.values[f"modes-after.period{k}"] for k in (1, 2)), reverse=True)
    assert 1.0 / slow == pytest.approx(7.0, rel=0.02)
    assert 1.0 / fast == pytest.approx(17.0, rel=0.05)
