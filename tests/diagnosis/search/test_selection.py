"""Which system is taken, of hand-made ones."""

from dataclasses import replace

import pytest

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Behind
from tests.diagnosis.search.handmade import ASIDE, FLOOR, fit, leaving, selection_of


@pytest.mark.parametrize(("share", "tied"), [(0.04, True), (0.09, True), (0.11, False), (0.3, False)])
def test_two_wrong_systems_differ_by_their_share_of_the_excess(share, tied):
    one, other = fit("a", leaving(1.0)), fit("b", leaving(1.0 - share))
    assert selection_of().tied(one, other) is tied
    assert selection_of().tied(other, one) is tied


def test_near_the_noise_a_small_share_tells_them_apart():
    """Every block says so, and nothing else is missing that could be the reason."""
    one, other = fit("a", leaving(0.21, floor=1.0)), fit("b", leaving(0.21 * 0.95, floor=1.0))
    assert not selection_of(floor=1.0).tied(one, other)
    assert selection_of(floor=0.5).tied(one, other)


@pytest.mark.parametrize(("apart", "tied"), [(0.05, True), (0.2, False)])
def test_what_noise_never_tells_apart_is_tied_however_significant(apart, tied):
    """480 samples tell outputs apart by two standard errors that differ by 0.091 times the noise."""
    one, other = fit("a", FLOOR), fit("bc", FLOOR)
    other = replace(other, residuals=other.residuals + apart * FLOOR * ASIDE, left_out=0.995 * other.left_out)
    assert selection_of().tied(other, one) is tied


def test_two_wrong_systems_that_err_differently_are_no_tie():
    one = fit("a", leaving(1.0))
    other = fit("b", leaving(0.96), wave=ASIDE)
    assert not selection_of().tied(one, other)


def test_what_is_better_by_too_little_to_take_a_names_place_is_told_beside_it():
    """`b` leaves a tenth less than `a`, and is no tie; `c` leaves more, and is none either."""
    bare, one = fit("", 0.5), fit("a", 0.115)
    selection = selection_of(bare, one, fit("b", 0.111), fit("c", 0.13), candidates="abc")
    assert not selection.tied(one, selection.alternatives(one, "a")["b"])
    assert [*selection.rivals(one, "a")] == ["b"]


def test_far_from_the_noise_what_is_a_little_better_is_no_rival():
    bare, one, better = fit("", leaving(9.0)), fit("a", leaving(1.0)), fit("b", leaving(0.85), wave=ASIDE)
    selection = selection_of(bare, one, better, candidates="ab")
    assert better.cv_rmse < one.cv_rmse
    assert not selection.rivals(one, "a")


@pytest.mark.parametrize(("share", "named"), [(0.3, ""), (0.45, ""), (0.55, "a"), (0.9, "a")])
def test_an_effect_is_named_that_explains_more_than_it_leaves(share, named):
    """All of them join, because they pass every test; in the end the smaller ones are dropped."""
    base, larger = fit("", leaving(1.0)), fit("a", leaving(1.0 - share))
    selection = selection_of(base, larger, candidates="a")
    found = selection.named(selection.run(base))
    assert selection.rounds[0].chosen == "a"
    assert found.names == set(named)


def test_what_stays_is_weighed_again_without_what_was_dropped():
    """b explains most, c little of what b leaves; next to c alone, b stays."""
    both, b, c = fit("bc", 1.0), fit("b", 1.2), fit("c", 3.0)
    selection = selection_of(fit("", 3.2), both, b, c, candidates="bc")
    assert selection.named(both) is b


def test_a_better_fit_found_later_replaces_the_known_one():
    bad, good = fit("a", 2.0), fit("a", 1.0)
    current, worse, better = fit("ab", 0.8), fit("ac", 1.9), fit("ad", 0.5)
    unrelated = fit("cd", 1.9)
    selection = selection_of(good)
    selection.known = {hypothesis.names: hypothesis for hypothesis in (bad, current, worse, better, unrelated)}
    assert selection.without(current, "b") is good
    kept = {hypothesis.names: hypothesis for hypothesis in (good, current, better, unrelated)}
    assert selection.known == kept  # {a, c} was built on the worse {a}


def test_a_worse_fit_found_later_is_forgotten():
    known, larger = fit("a", 1.0), fit("ac", 1.05)
    selection = selection_of(fit("a", 1.2))
    selection.known = {hypothesis.names: hypothesis for hypothesis in (known, larger)}
    assert selection.without(fit("ab", 0.8), "b") is known
    assert selection.known == {known.names: known, larger.names: larger}


def test_the_same_question_is_asked_once():
    current = fit("ab", 0.8)
    selection = selection_of(fit("a", 1.0), fit("b", 1.1))
    assert selection._reduced(current, "ab") == selection._reduced(current, "ab")
    assert [question[2] for question in selection.workers.asked] == ["a", "b"]
    del selection.known[frozenset("a")]
    assert selection.without(current, "b").names == {"a"}
    assert len(selection.workers.asked) == 3


def test_an_effect_that_only_led_to_a_better_fit_of_the_model_leaves_again():
    """The model alone had ended elsewhere: fitted again from the system with `a`, it leaves no more than that."""
    astray, found = fit("", 1.3), fit("", 1.0)
    selection = selection_of(found, fit("a", 0.999), candidates="a")
    assert selection.run(astray) is found
    assert [one.chosen for one in selection.rounds] == ["a", ""]


def test_what_was_left_behind_is_no_alternative_and_is_asked_once():
    current, far = fit("a", 0.2), fit("b", 0.5)
    behind = Behind(far.names, far.values, far.residuals, far.left_out, ())
    selection = selection_of(fit("", 1.0), current, behind, fit("c", 0.21), candidates="abc")
    assert [*selection.alternatives(current, "a")] == ["c"]
    assert behind.names not in selection.known
    asked = len(selection.workers.asked)
    assert [*selection.alternatives(current, "a")] == ["c"]
    assert len(selection.workers.asked) == asked
    worse = fit("a", 0.4)
    selection.alternatives(worse, "a")
    assert [question[2] for question in selection.workers.asked[asked:] if question[0] == "extended"] == ["b"]
