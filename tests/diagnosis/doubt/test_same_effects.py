"""With what was found around one law others are asked: one of fewer parameters, or any that follows better."""

import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.doubt.same_effects import better_law, simpler_law
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.search import search

RECORDS = ("slow", "fast", "nested")


ONE = DiagnosisOptions(jobs=1)


def found_around(law, effects, names_only):
    """In records of Bouc and Wen's law with these effects."""
    settings = {"model": "bouc-wen", "effects": effects, "noise": 0.004}
    likely = ("backlash", "creep", "drift", "output-lag")
    question = Question(law, among=likely, options=ONE)
    prepared = prepare(measure("hidden-effects", *RECORDS, settings=settings, seed=3), question)
    with names_only():
        return search(prepared, gather(prepared.views), question)


@pytest.fixture(scope="module")
def around(names_only):
    """The generalized Bouc-Wen law, where the one of Bouc and Wen has a lag behind it."""
    return found_around("bouc-wen-generalized", ("output-lag",), names_only)


@pytest.fixture(scope="module")
def around_a_wrong_one(names_only):
    return found_around("jiles-atherton", ("output-lag", "drift"), names_only)


@pytest.mark.long
def test_the_law_that_it_contains_follows_as_well(around):
    assert around.selection.adopted(around.best) == ("output-lag",)
    assert simpler_law("bouc-wen-generalized", around, ("bouc-wen", "ferroelectric"), 0) == "bouc-wen"
    assert simpler_law("bouc-wen-generalized", around, ("ferroelectric",), 0) == ""
    assert simpler_law("bouc-wen-generalized", around, (), 0) == ""


def test_they_are_asked_in_their_order(around):
    assert simpler_law("bouc-wen-generalized", around, ("bouc-wen", "dahl"), 0) == "bouc-wen"
    assert simpler_law("bouc-wen-generalized", around, ("ferroelectric", "bouc-wen"), 0) == "bouc-wen"


def test_with_what_was_found_around_a_wrong_law_the_right_one_follows_better(around_a_wrong_one):
    assert "output-lag" in around_a_wrong_one.selection.adopted(around_a_wrong_one.best)
    laws = {"bouc-wen-generalized": 12, "dahl": 5, "bouc-wen": 4}
    assert better_law("jiles-atherton", around_a_wrong_one, laws, ONE) == "bouc-wen"
    assert better_law("jiles-atherton", around_a_wrong_one, {}, ONE) == ""


def test_around_the_right_law_none_follows_better(around):
    assert better_law("bouc-wen-generalized", around, {"dahl": 5, "jiles-atherton": 5}, ONE) == ""
