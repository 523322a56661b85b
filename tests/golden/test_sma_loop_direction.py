"""The published optima of the SMA paper (Table 2, c > 1) run their loop the wrong way."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.signals import Record

PUBLISHED = {
    "pso": (1.000e-14, 7.982261, 58.11999, 2.2722e7, 1.552548),
    "mpso": (1.000e-14, 9.771736, 33.80507, 2.6155e7, 1.938721),
}


def branches(values):
    """Output at 30 degC on the way up and on the way down, after a first cycle from 0 to 60 degC."""
    time = np.arange(2401) / 10.0
    temperature = 30.0 * (1.0 - np.cos(2 * np.pi * time / 120.0))
    record = Record(time, temperature, None)
    output = System(registry.build("models", "jiles-atherton")).respond(record, np.array(values)[:, None])[:, 0]
    return output[1500], output[2100]


@pytest.mark.parametrize("name", sorted(PUBLISHED))
def test_the_rising_branch_lies_above_the_falling_one(name):
    rising, falling = branches(PUBLISHED[name])
    assert rising > falling + 1.0


def test_within_the_physical_range_of_c_it_lies_below():
    rising, falling = branches((*PUBLISHED["mpso"][:4], 0.5))
    assert rising < falling - 1.0
