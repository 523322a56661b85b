"""A name is the claim that its formula does as well as a free form in its place: where one does clearly better on
samples left out, and explains most of what the formula leaves over the noise, the free form takes the place.

Where no formula was named at all, or a formula of another family stands in for what is missing, the free form that
does best joins all the same. What is named beside it and no longer needed leaves.
"""

from __future__ import annotations

from collections.abc import Iterator

from hysteresis_bench.diagnosis.hypotheses.cross_validation import CLEAR, advantage
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.selection import MATTERS, MISFIT, MOST, NAMED, Selection


def with_free_forms(selection: Selection, named: Hypothesis) -> Hypothesis:
    """The system with free forms where names do not do as well; `selection` counts those as candidates from now on."""
    forms = selection.fitter.stack.free_forms()
    names, selection.candidates = selection.candidates, (*selection.candidates, *forms)
    current = named
    for _ in range(MOST):
        better = _freed(selection, current, forms)
        if better is None:
            break
        current = _thinned(selection, better)
    selection.candidates = (*names, *(form for form in forms if form in current.names))
    return current


def _freed(selection: Selection, current: Hypothesis, forms: tuple[str, ...]) -> Hypothesis | None:
    """With the free form that does best in the place of a name, or beside all; None where the names do as well."""
    if current.rmse <= MATTERS * selection.floor:
        return None
    found = [system for system in _tried(selection, current, forms) if _clearly(selection, current, system)]
    if not found:
        return None
    return selection.workers.map([("refitted", selection.simplest(found))])[0]


def _tried(selection: Selection, current: Hypothesis, forms: tuple[str, ...]) -> Iterator[Hypothesis]:
    """Every free form in the place of every name, and where the names leave much more than the noise beside them."""
    others = [form for form in forms if form not in current.names]
    adopted = selection.adopted(current)
    smaller = [selection.without(current, name) for name in adopted]
    beside = [current] if current.rmse > MISFIT * selection.floor and len(adopted) < MOST else []
    for system in [*smaller, *beside]:
        values = None if system is current else current.values
        found = selection.workers.map([("extended", system, form, values) for form in others])
        yield from (larger for larger in found if selection.needed(system, larger, len(selection.candidates)))


def _clearly(selection: Selection, current: Hypothesis, system: Hypothesis) -> bool:
    """Does a system do clearly better, and explain more than what then remains?"""
    gain = advantage(system.left_out, current.left_out, selection.fitter.blocks)
    return gain > CLEAR and selection.share(current, system) > NAMED


def _thinned(selection: Selection, current: Hypothesis) -> Hypothesis:
    """Without what is not needed any more, the least telling first."""
    while True:
        smaller = [selection.without(current, name) for name in selection.adopted(current)]
        spare = [system for system in smaller if not selection.needed(system, current)]
        if not spare:
            return current
        current = min(spare, key=lambda system: system.cv_rmse)
