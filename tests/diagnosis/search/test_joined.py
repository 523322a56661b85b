"""A free form joins beside the names where they leave much, and not for a little misfit."""

from types import SimpleNamespace

import pytest

from hysteresis_bench.diagnosis.search.free_forms import _joined
from tests.diagnosis.search.handmade import FLOOR, fit, leaving, selection_of


@pytest.mark.parametrize(("left", "joins"), [(1.1, False), (1.5, True)])
def test_beside_all_that_is_named_it_is_one_claim_more(left, joins):
    """The formula a leaves a little or much, the form c beside it comes down to the noise, and cannot stand alone."""
    current, beside = fit("a", left * FLOOR), fit("ac", 1.0 * FLOOR)
    selection = selection_of(current, beside, fit("", leaving(2.0)), fit("c", leaving(1.0)), candidates="a")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="one")
    assert _joined(selection, current, ("a",), 3) is (beside if joins else current)


def test_a_form_is_not_asked_whether_it_would_do_as_well_in_a_names_place():
    """It is tried there itself; a name that would do as well there, b, has another form tried, d, of its family."""
    current, far = fit("a", 1.1 * FLOOR), [fit(names, leaving(1.0)) for names in ("", "b", "c", "d", "ac", "ad")]
    selection = selection_of(current, *far, fit("b", 1.1 * FLOOR), candidates="ab")
    selection.forms = ("c", "d")
    families = {"a": "one", "c": "one", "b": "two", "d": "two"}
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family=families[name])
    assert _joined(selection, current, ("a", "b"), 3) is current
    tried = [question[2] for question in selection.workers.asked if question[0] == "extended"]
    assert sorted(tried) == ["b", "c", "c", "d", "d"]  # c and d once beside a, once in its place
