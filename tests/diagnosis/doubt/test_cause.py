"""A law that follows without a curve is no cause where the asked one needs none either."""

from types import SimpleNamespace

import pytest

from hysteresis_bench.diagnosis.doubt.cause import _without_curves
from tests.diagnosis.search.handmade import FLOOR, fit, selection_of


@pytest.mark.parametrize(
    ("names", "left", "unseen", "needs_none"),
    [
        (("droop", "output-lag"), 1.02, 1.03, True),
        (("droop", "output-lag"), 1.3, 1.03, False),  # it does not follow what was fitted
        (("droop", "output-lag"), 1.02, 1.3, False),  # nor does it predict
        (("droop", "lags-after"), 1.02, 1.03, False),  # with a curve as well
        (("droop", "lags-before"), 1.02, 1.03, False),  # with one that is no candidate any more
    ],
)
def test_formulas_alone_that_predict_as_well_need_no_curve(names, left, unseen, needs_none):
    free, plain = fit(["lags-after"], FLOOR), fit(names, left * FLOOR)
    selection = selection_of(free, plain, candidates=("droop", "output-lag", "lags-after"))
    selection.known = {one.names: one for one in (free, plain)}
    thin = SimpleNamespace(unseen=lambda one: one.left_out * unseen / left)
    found = SimpleNamespace(selection=selection, thin=thin)
    assert _without_curves(found, 1.06 * FLOOR) is needs_none
