"""A search begins also where one effect is off, at the very points at which it would begin without that effect."""

import numpy as np
import pytest

from hysteresis_bench.fit.smooth.starts import SCREENED, starts
from hysteresis_bench.parameters import Parameter

LAW = Parameter("coupling", 0.0, 2.0)
SHARE = Parameter("creep.share", -1.0, 1.0, null=0.0)
TIME = Parameter("creep.time_constant", 0.01, 10.0, scaling="log")
DELAY = Parameter("transport-delay.delay", 1e-4, 1.0, scaling="log", null=0.0)


def test_without_effects_the_box_is_filled_evenly():
    points = starts([LAW])
    assert points.shape == (2 * SCREENED, 2)
    assert np.all((points > 0.0) & (points < 1.0))
    assert starts([]).shape == (SCREENED, 1)


@pytest.mark.parametrize(
    ("effect", "others", "off"), [((SHARE, TIME), [LAW, DELAY], [0.5, 0.5]), ((DELAY,), [LAW, SHARE, TIME], [0.0])]
)
def test_a_system_begins_where_it_begins_without_an_effect(effect, others, off):
    parameters = [LAW, SHARE, TIME, DELAY]
    own = np.array([p in effect for p in parameters] + [False])
    points = starts(parameters)
    smaller = starts(others)[: SCREENED * (len(others) + 1)]
    without = points[np.all(points[:, own] == off, axis=1)][:, ~own]
    assert all(np.any(np.all(without == point, axis=1)) for point in smaller)


def test_what_has_no_null_is_never_left_out():
    assert len(starts([LAW, Parameter("law.exponent", 1.0, 2.0)])) == 3 * SCREENED
