"""An offset of every record hides what a formula does wrong, and a curve in its place needs none."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from hysteresis_bench import measure, registry
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search import free_forms

OFFSET = registry.RECORD_OFFSET
BEND = 0.012
"""Per unit of the output, whose range is 8."""

pytestmark = pytest.mark.usefixtures("few_laws")


def system(*names, rmse):
    return SimpleNamespace(names=frozenset(names), rmse=rmse, cv_rmse=rmse, values={})


@pytest.mark.parametrize(
    ("floor", "without", "curve", "names"),
    [
        (1.0, 1.40, 1.00, {"leakage-curve", OFFSET}),  # the formula needs offsets, the curve does not
        (1.0, 1.40, 1.09, {"leakage", OFFSET}),  # the records have offsets of their own, which no curve takes over
        (1.0, 1.06, 1.00, {"leakage", OFFSET}),  # nothing to speak of hides in the offsets
        (0.5, 1.40, 1.00, {"leakage", OFFSET}),  # far from the noise the curve follows the law's own fault
    ],
)
def test_a_curve_that_does_what_offsets_did_is_taken(monkeypatch, floor, without, curve, names):
    current, alone = system("leakage", OFFSET, rmse=1.05), system("leakage", rmse=without)
    selection = asked_about(monkeypatch, alone, system("leakage-curve", rmse=curve), floor)
    assert free_forms._in_place_of_offsets(selection, current).names == names


def test_what_was_named_beside_the_wrong_formula_leaves_where_the_curve_does_without(monkeypatch):
    current, alone = system("leakage", "creep", OFFSET, rmse=1.05), system("leakage", "creep", rmse=1.40)
    selection = asked_about(monkeypatch, alone, system("leakage-curve", "creep", rmse=1.00), 1.0)
    assert free_forms._in_place_of_offsets(selection, current).names == {"leakage-curve", OFFSET}


def test_a_curve_of_another_family_is_taken_in_the_place_of_a_bend(monkeypatch):
    """Of the output in the place of one of the input, which has no other of its own that does as well."""
    current, alone = system("asymmetry", OFFSET, rmse=1.01), system("asymmetry", rmse=1.04)
    selection = asked_about(monkeypatch, alone, system("input-curve", rmse=1.03), 1.0, elsewhere=1.0)
    assert free_forms._in_place_of_offsets(selection, current).names == {"output-curve", OFFSET}
    selection = asked_about(monkeypatch, alone, system("input-curve", rmse=1.03), 1.0, elsewhere=1.02)
    assert free_forms._in_place_of_offsets(selection, current) is current


def test_a_bend_of_the_sensor_is_none_of_the_input():
    """With an offset of every record an asymmetry of the input comes to 1.005 times the noise on what is fitted."""
    settings = {"model": "bouc-wen", "noise": 0.003}
    straight = measure("hidden-effects", "slow", "fast", "nested", "mixed", settings=settings)
    bent = straight.map(lambda record: replace(record, output=record.output + BEND * record.output**2))
    options = DiagnosisOptions(jobs=1)
    found = diagnose(bent.split(["mixed"]), Question("bouc-wen", among=("asymmetry", "saturation"), options=options))
    assert found.effects == ("output-curve",)
    assert found.after.held_out.rmse < 0.42 * found.before.held_out.rmse


def asked_about(monkeypatch, alone, freed, floor, elsewhere=9.0):
    """A selection in which `alone` is a system without its offset, and `freed` the same with a curve in the place of
    its formula; creep is not needed.  elsewhere : RMSE of curves of another family in the place of a bend"""
    families = {"asymmetry": "curve of the input", "output-curve": "curve of the output"}

    def effect(name):
        return SimpleNamespace(estimates=0, family=families.get(name, "change with time, path or temperature"))

    def answer(questions):
        return [
            alone if kind == "reduced" else system(*one.names, name, rmse=elsewhere if more else one.rmse)
            for kind, one, name, *more in questions
        ]

    monkeypatch.setattr(free_forms, "_in_place", lambda *rest: [freed])
    monkeypatch.setattr(free_forms, "_told", lambda _, smaller, larger: larger.rmse < 0.99 * smaller.rmse)
    return SimpleNamespace(
        adopted=lambda one: tuple(one.names & {"leakage", "creep", "asymmetry"}),
        fitter=SimpleNamespace(stack=SimpleNamespace(effect=effect)),
        workers=SimpleNamespace(map=answer),
        simplest=lambda systems: systems[0],
        without=lambda one, name: system(*one.names - {name}, rmse=one.rmse),
        needed=lambda smaller, larger: "creep" not in larger.names - smaller.names,
        share=lambda smaller, larger: 1.0,
        floor=floor,
        forms=("leakage-curve", "output-curve"),
    )
