"""What is no wider than the noise of a measured input is no effect of the device."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import DROWNED, Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.signals import Record

NOISE = 0.02


@pytest.fixture(scope="module")
def fitter():
    time = np.linspace(0.0, 8.0, 4001)
    drive = np.sin(2 * np.pi * time) + NOISE * np.random.default_rng(3).standard_normal(time.size)
    return Fitter(Stack(registry.build("models", "bouc-wen"), (Record(time, drive, drive),)))


@pytest.mark.parametrize(
    ("name", "widths", "drowned"),
    [
        ("backlash", {"half_width": 0.8}, True),
        ("backlash", {"half_width": 1.2}, False),
        ("backlash", {"half_width": 0.0}, False),  # it is not there
        ("input-dead-zone", {"half_width": 0.8, "rounding": 0.01}, True),
        ("input-dead-zone", {"half_width": 1.2, "rounding": 0.01}, False),  # with sharp edges
        ("input-cyclic-error", {"sine": 1.2, "cosine": 0.01}, False),  # its phase
        ("input-curve", {"bend0": 0.01, "bend1": -1.2}, False),  # it is straight elsewhere
        ("output-lag", {}, False),  # has no width
    ],
)
def test_the_widest_counts(fitter, name, widths, drowned):
    """widths : over what the noise drowns"""
    values = {f"{name}.{key}": share * DROWNED * NOISE for key, share in widths.items()}
    assert fitter.drowned(Hypothesis(frozenset({name}), values, np.zeros(1), np.zeros(1), ()), name) is drowned
