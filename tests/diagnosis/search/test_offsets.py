"""An offset of every record hides what a formula does wrong, and a curve in its place needs none."""

from types import SimpleNamespace

import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.search import free_forms

OFFSET = registry.RECORD_OFFSET


def system(*names, rmse):
    return SimpleNamespace(names=frozenset(names), rmse=rmse, cv_rmse=rmse)


@pytest.mark.parametrize(
    ("floor", "without", "curve", "names"),
    [
        (1.0, 1.40, 1.00, {"leakage-curve", OFFSET}),  # the formula needs offsets, the curve does not
        (1.0, 1.40, 1.09, {"leakage", OFFSET}),  # the records have offsets of their own, which no curve takes over
        (1.0, 1.08, 1.00, {"leakage", OFFSET}),  # nothing to speak of hides in the offsets
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


def asked_about(monkeypatch, alone, freed, floor):
    """A selection in which `alone` is a system without its offset, and `freed` the same with a curve in the place of
    its formula; creep is not needed."""

    def answer(questions):
        ((kind, one, name),) = questions
        return [alone] if kind == "reduced" else [system(*one.names, name, rmse=one.rmse)]

    monkeypatch.setattr(free_forms, "_in_place", lambda *rest: [freed])
    monkeypatch.setattr(free_forms, "_clearly", lambda *rest: True)
    return SimpleNamespace(
        adopted=lambda one: tuple(one.names & {"leakage", "creep"}),
        fitter=SimpleNamespace(stack=SimpleNamespace(effect=lambda name: SimpleNamespace(estimates=0))),
        workers=SimpleNamespace(map=answer),
        simplest=lambda systems: systems[0],
        without=lambda one, name: system(*one.names - {name}, rmse=one.rmse),
        needed=lambda smaller, larger: "creep" not in larger.names - smaller.names,
        floor=floor,
        forms=("leakage-curve",),
    )
