"""Space: the unit box and the physical one are the same box."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hysteresis_bench.parameters import Parameter, Space

SPACE = Space((Parameter("alpha", 1e-14, 1e-2, scaling="log"), Parameter("c", -3.0, 5.0)))


@given(st.lists(st.floats(0, 1), min_size=2, max_size=2))
def test_there_and_back(point):
    column = np.array(point)[:, None]
    assert SPACE.to_unit(SPACE.from_unit(column)) == pytest.approx(column, abs=1e-12)


def test_edges_and_middle():
    values = SPACE.from_unit(np.array([[0.0, 0.5, 1.0], [0.0, 0.5, 1.0]]))
    assert values[0] == pytest.approx([1e-14, 1e-8, 1e-2], rel=1e-12)
    assert values[1] == pytest.approx([-3.0, 1.0, 5.0])


def test_every_fault_of_a_box_is_told():
    assert "above" in Parameter("a", 2.0, 1.0).faults()[0]
    assert "both" in Parameter("a", 1.0, 1.0).faults()[0]
    assert "finite" in Parameter("a", 1.0, np.inf).faults()[0]
    assert len(Parameter("a", 1.0, -1.0, scaling="log").faults()) == 1
    assert len(Parameter("a", -1.0, -2.0, scaling="log").faults()) == 2
    assert not Parameter("a", 0.0, 1.0).faults()
    assert "above 0" in Parameter("a", 0.0, 1.0, positive=True).faults()[0]
    assert len(Parameter("a", 0.0, 1.0, scaling="log", positive=True).faults()) == 1


def test_bounds_that_reach_down_to_0_are_linear_unless_a_scaling_is_asked_for():
    decades = Parameter("a", 1.0, 10.0, scaling="log")
    assert decades.bounded(0.5, 2.0) == Parameter("a", 0.5, 2.0, scaling="log")
    assert decades.bounded(0.0, 2.0) == Parameter("a", 0.0, 2.0)
    assert decades.bounded(-1.0, 2.0, "log").faults()
    assert Parameter("a", 1.0, 10.0).bounded(0.5, 2.0, "log").scaling == "log"


def test_a_value_that_makes_no_sense_is_refused():
    width = Parameter("b", 1.0, 2.0, positive=True)
    assert "above 0" in width.refuses(0.0)
    assert "finite" in width.refuses(np.nan)
    assert not width.refuses(5.0)
    assert not Parameter("a", 1.0, 2.0).refuses(-1.0)
