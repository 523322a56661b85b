"""How far a law leaves the range of the fitted outputs, where held-out inputs lie within the fitted ones."""

import numpy as np
import pytest

from hysteresis_bench.fit.unseen.outside import outside
from hysteresis_bench.signals import Dataset, Record


def records(held_out_input):
    time = np.arange(5.0)
    fitted = Record(time, np.linspace(0.0, 1.0, 5), np.linspace(2.0, 4.0, 5), "fitted")
    held_out = Record(time, np.array(held_out_input), np.zeros(5), "held out")
    return Dataset((fitted, held_out), ("held out",))


def test_it_is_a_share_of_the_range_on_either_side():
    within = [1.0, 0.75, 0.5, 0.25, 0.0]
    assert outside([np.array([4.0, 4.5, 3.0, 2.0, 2.0])], records(within)) == pytest.approx(0.25)
    assert outside([np.array([4.0, 3.0, 1.0, 2.0, 2.0])], records(within)) == pytest.approx(0.5)
    assert outside([np.array([4.0, 3.5, 3.0, 2.5, 2.0])], records(within)) == 0.0


def test_a_record_that_goes_beyond_the_fitted_inputs_does_not_count():
    response = np.array([9.0, 4.0, 3.0, 2.5, 2.2])
    assert outside([response], records([1.5, 1.0, 0.5, 0.3, 0.1])) == 0.0
    assert outside([response], records([1.04, 1.0, 0.5, 0.3, 0.1])) == pytest.approx(2.5)


def test_nothing_held_out_leaves_nothing():
    dataset = records([0.0, 0.1, 0.2, 0.3, 0.4])
    assert outside([], Dataset(dataset.records[:1])) == 0.0
