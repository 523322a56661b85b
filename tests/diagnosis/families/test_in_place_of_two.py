"""A free form in the place of two names does clearly better than both, and than a name in the place of one of them."""

from types import SimpleNamespace

import pytest

from hysteresis_bench.diagnosis.families.free_forms import _in_place_of_two
from tests.diagnosis.search.handmade import FLOOR, fit, leaving, selection_of


@pytest.mark.parametrize(("other", "taken"), [(1.05, True), (1.0, False)])
def test_a_name_that_does_as_well_keeps_it_out(other, taken):
    """a and b come near the noise, the form c alone down to it, and so may b with d, which has one parameter more."""
    current, form, beside = fit("ab", 1.05 * FLOOR), fit("c", 1.0 * FLOOR), fit("bd", other * FLOOR)
    far = [fit(names, leaving(1.0)) for names in ("", "a", "b", "ad")]
    selection = selection_of(current, form, beside, *far, candidates="abd")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="one")
    assert _in_place_of_two(selection, current) is (form if taken else current)


def test_the_form_itself_beside_one_of_them_does_not():
    """With more parameters it does a little better, and is one claim more."""
    current, form, beside = fit("ab", 1.05 * FLOOR), fit("c", 1.0 * FLOOR), fit("bc", 0.99 * FLOOR)
    far = [fit(names, leaving(1.0)) for names in ("", "a", "b", "ac")]
    selection = selection_of(current, form, beside, *far, candidates="abc")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="one")
    assert _in_place_of_two(selection, current) is form


def test_what_was_named_beside_both_leaves_where_the_form_does_without():
    current, form, beside = fit("abd", 1.05 * FLOOR), fit("cd", 1.0 * FLOOR), fit("c", 1.0 * FLOOR)
    far = [fit(names, leaving(1.0)) for names in ("a", "b", "d", "ab", "ad", "bd", "ac", "bc")]
    selection = selection_of(current, form, beside, *far, candidates="abd")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="b" if name == "d" else "a")
    assert _in_place_of_two(selection, current) is beside
