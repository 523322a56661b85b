"""A free form in the place of two names does clearly better than both, and than a name in the place of one of them."""

from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.hypotheses.nested_test import NestedTest
from hysteresis_bench.diagnosis.search.free_forms import _in_place_of_two
from tests.diagnosis.search.handmade import FLOOR, WAVE, fit, leaving, selection_of

UNEVEN = WAVE * np.repeat(np.linspace(1.05, 0.95, 48), 10)
"""As much in all, in some blocks more and in others less: nothing is clearly better."""


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


@pytest.mark.parametrize(("left", "leaves"), [(1.0, True), (1.3, False)])
def test_what_was_named_beside_both_leaves_where_the_form_comes_near_the_noise_without(left, leaves):
    """Where the data cannot show that d is needed, and next to nothing follows them without, it stays."""
    current, form, beside = fit("abd", 1.05 * FLOOR), fit("cd", 1.0 * FLOOR), fit("c", left * FLOOR)
    far = [fit(names, leaving(1.0)) for names in ("a", "b", "d", "ab", "ad", "bd", "ac", "bc")]
    selection = selection_of(current, form, beside, *far, candidates="abd")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="b" if name == "d" else "a")
    selection.fitter.test = lambda smaller, larger: NestedTest(1.0, 0.5 if smaller is beside else 1e-12, 1)
    assert _in_place_of_two(selection, current) is (beside if leaves else form)


@pytest.mark.parametrize(
    ("periods", "left", "taken"),
    [
        ((0.73, 0.365), 0.999, True),
        ((0.73, 0.73), 0.999, True),
        ((0.73, 0.73), 1.01, False),
        ((0.73, 0.47), 0.999, False),
    ],
)
def test_two_that_are_one_wave_are_told_as_one(periods, left, taken):
    """One that repeats itself after half of the other's period is its harmonic; the form only has to do no worse."""
    current, form = fit("ab", 1.0 * FLOOR), fit("c", left * FLOOR, UNEVEN)
    current.values.update({f"{name}.period": period for name, period in zip("ab", periods, strict=True)})
    far = [fit(names, leaving(1.0)) for names in ("", "a", "b", "ac", "bc")]
    selection = selection_of(current, form, *far, candidates="ab")
    selection.forms = ("c",)
    selection.fitter.stack.effect = lambda name: SimpleNamespace(estimates=False, family="one")
    assert _in_place_of_two(selection, current) is (form if taken else current)
