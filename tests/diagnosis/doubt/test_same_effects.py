"""A law that contains the right one follows as well as it: the right one is asked too."""

import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.doubt.same_effects import simpler_law
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.search import search

RECORDS = ("slow", "fast", "nested")


@pytest.fixture(scope="module")
def around(names_only):
    """What is found around the generalized Bouc-Wen law in records of the one of Bouc and Wen, with a lag behind it."""
    settings = {"model": "bouc-wen", "effects": ("output-lag",), "noise": 0.004}
    question = Question("bouc-wen-generalized", options=DiagnosisOptions(jobs=1))
    prepared = prepare(measure("hidden-effects", *RECORDS, settings=settings, seed=3), question)
    with names_only():
        return search(prepared, gather(prepared.views), question)


def test_the_law_that_it_contains_follows_as_well(around):
    assert around.selection.adopted(around.best) == ("output-lag",)
    assert simpler_law("bouc-wen-generalized", around, ("bouc-wen", "ferroelectric"), 0) == "bouc-wen"
    assert simpler_law("bouc-wen-generalized", around, ("ferroelectric",), 0) == ""
    assert simpler_law("bouc-wen-generalized", around, (), 0) == ""


def test_they_are_asked_in_their_order(around):
    assert simpler_law("bouc-wen-generalized", around, ("bouc-wen", "dahl"), 0) == "bouc-wen"
    assert simpler_law("bouc-wen-generalized", around, ("ferroelectric", "bouc-wen"), 0) == "bouc-wen"
