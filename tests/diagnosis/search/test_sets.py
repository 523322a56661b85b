"""What the search ends with is the best of all that it fitted."""

import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.search.sets import best_of_all
from tests.diagnosis.search.handmade import fit, leaving, selection_of

OFFSET = registry.RECORD_OFFSET


def ended(current, *others):
    selection = selection_of(current, *others)
    selection.known = {one.names: one for one in (current, *others)}
    return best_of_all(selection, current)


@pytest.mark.parametrize(("share", "taken"), [(0.02, True), (-0.02, False)])
def test_a_set_that_was_passed_by_is_taken_where_it_is_clearly_better(share, taken):
    current, passed_by = fit("ab", leaving(1.0)), fit("cd", leaving(1.0 - share))
    assert ended(current, passed_by) is (passed_by if taken else current)


@pytest.mark.parametrize(("share", "taken"), [(0.45, False), (0.55, True)])
def test_with_more_parameters_it_must_explain_more_than_it_leaves(share, taken):
    current, richer = fit("a", leaving(1.0)), fit("bcd", leaving(1.0 - share))
    object.__setattr__(richer, "names", frozenset("b"))
    assert ended(current, richer) is (richer if taken else current)


def test_no_set_that_claims_more_is_taken():
    current = fit("ab", leaving(1.0))
    assert ended(current, fit("abc", leaving(0.1))) is current
    beside = fit([*"cd", OFFSET], leaving(0.1))
    assert ended(current, beside) is beside, "an offset is no claim"


def test_near_the_noise_names_stay():
    current = fit("ab", 1.05 * 0.1)
    assert ended(current, fit("cd", 1.0 * 0.1)) is current


@pytest.mark.parametrize(("left", "taken"), [(1.15, True), (1.25, False)])
def test_a_free_form_joins_only_where_it_comes_near_the_noise(left, taken):
    current, free = fit("ab", 2.0 * 0.1), fit("ac", left * 0.1)
    selection = selection_of(current, free)
    selection.known, selection.forms = {one.names: one for one in (current, free)}, ("c",)
    assert best_of_all(selection, current) is (free if taken else current)
