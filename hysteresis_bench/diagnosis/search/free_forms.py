"""A name is the claim that its formula does as well as a free form: where one beside it does clearly better on samples
left out, and explains most of what the formulas leave over the noise, the free form joins, and every name that is not
needed any more leaves.

So a free form takes the place of a formula of its family, of one of another family that stood in for it, or of none.
Names that were found beside the wrong formula may be its fault, and others may have been hidden by what it left: once a
curve has joined, the search for names goes on from there.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import is_curve
from hysteresis_bench.diagnosis.search.fallback import predicts_better, unseen_rmse
from hysteresis_bench.diagnosis.search.selection import ALIKE, LEVEL, NAMED, REACHED, Selection
from hysteresis_bench.diagnosis.search.sets import best_of_all, claims, fits
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage

CURVES, CLAIMS = 2, 3
"""At most so many free forms in a system, and so many names and forms together, or one more than there were names: more
of them follow any law's fault. Of 656 cases whose effects had other formulas than the program's, with four forms and
five claims at most, the family was right with one form in 60, with two in 6, with more in none."""

REMAINING = 0.1
"""Share of the excess of the mean square over the noise's, on records left out, up to which next to nothing remains. In
a made case 0.04 does, as on a measured ferroelectric gate stack whose loops had been passed as settled and were not:
half of it or twice changes neither. On the latter the free forms stood in for that, so that they are no names."""

WHOLE = 0.01
"""Of the ratio of two periods, within which it is a whole number. In a made case whose cogging is no sum of two
harmonics an error of the input was named beside it with half its period, within 1e-4: half and twice of this change
nothing there."""


def with_free_forms(selection: Selection, found: Hypothesis) -> Hypothesis:
    """The system with free forms where names do not do as well; `selection` counts those as candidates from now on.

    found : what passed every test. The wrong formula of one effect may leave so much that the right one of another
    explains less than what is left, and is not named: free forms are tried beside both first, and are taken if no more
    is claimed then: in the place of formulas, not beside them. Far from the noise as of `_foretelling`.
    """
    names, named = selection.candidates, selection.named(found)
    selection.forms = selection.fitter.stack.free_forms()
    current, others = named, []
    for start in [found, named] if found.names != named.names else [named]:
        adopted = len(selection.adopted(start))
        most = max(adopted + 1, CLAIMS) if start is named else adopted
        joined = _joined(selection, start, names, most)
        if joined is not start and fits(selection, joined) and claims(joined) <= claims(start) - adopted + most:
            current = joined
            break
        others.append(joined)
    else:
        current = _foretelling(selection, named, others)
        if current is not named:
            selection.candidates = _counted(selection, names, current)
    # neither parts of a lone record, maybe one loop again and again, nor what lies beyond all others tells of a shape
    if selection.fitter.excitations.inner and not fits(selection, current):
        current = _shaped(selection, current, names)
    current = best_of_all(selection, _in_place_of_two(selection, _in_place_of_offsets(selection, current)))
    selection.candidates = _counted(selection, names, current)
    return current


def _counted(selection: Selection, names: tuple[str, ...], system: Hypothesis) -> tuple[str, ...]:
    """Candidates, with the free forms of a system."""
    return (*names, *(form for form in selection.forms if form in system.names))


def _foretelling(selection: Selection, named: Hypothesis, others: list[Hypothesis]) -> Hypothesis:
    """Far from the noise, a system that leaves next to nothing of what the named one does where whole records are left
    out. What follows a law's own fault seldom does: on other records the fault is another one."""
    fitter = selection.fitter
    if fits(selection, named) or not fitter.excitations.inner:
        return named
    most = max(claims(named) + 1, CLAIMS)
    found = [one for one in others if claims(one) <= most and _foretells(selection, named, one)]
    return min(found, key=lambda one: unseen_rmse(fitter, one), default=named)


def _foretells(selection: Selection, smaller: Hypothesis, larger: Hypothesis) -> bool:
    """Does the larger system predict records left out clearly better, and leave less than `REMAINING`?"""
    fitter = selection.fitter
    more, less = (unseen_rmse(fitter, one) ** 2 - selection.floor**2 for one in (larger, smaller))
    clear = advantage(fitter.unseen(larger), fitter.unseen(smaller), fitter.blocks) > CLEAR
    return clear and more < REMAINING * less


def _shaped(selection: Selection, current: Hypothesis, names: tuple[str, ...]) -> Hypothesis:
    """Far from the noise, with curves of the input and of the output, where records left out are predicted better.

    They have no dynamics, and make with any law another one of another shape, which may be the device's."""
    forms = selection.forms
    selection.forms = tuple(form for form in forms if is_curve(selection.fitter.stack.effect(form)))
    joined = _joined(selection, current, names, max(len(selection.adopted(current)) + 1, CLAIMS))
    selection.forms = forms
    better = joined is not current and predicts_better(selection.fitter, joined, current, selection.floor)
    return joined if better else current


def _in_place_of_offsets(selection: Selection, current: Hypothesis) -> Hypothesis:
    """What a formula does wrong may hide in an offset of every record, which no other record has. A free form in the
    place of a name that leaves no more without these offsets does what they did; and in the place of a curve that has
    no dynamics, one of another family too, as a bend of the sensor passes for one of the input."""
    offset, effect = registry.RECORD_OFFSET, selection.fitter.stack.effect
    if offset not in current.names or not selection.adopted(current):
        return current
    (without,) = selection.workers.map([("reduced", current, offset)])
    if not _told(selection, without, current):
        return current
    forms = [form for form in selection.forms if form not in current.names and not effect(form).estimates]
    curves = [form for form in forms if is_curve(effect(form))]
    bent = {name: selection.without(without, name) for name in selection.adopted(without) if is_curve(effect(name))}
    other = (without.values, without.rmse)
    elsewhere = [("extended", bent[n], f, *other) for n in bent for f in curves if effect(f).family != effect(n).family]
    tried = [*_in_place(selection, without, forms), *selection.workers.map(elsewhere)]
    found = [one for one in tried if one.rmse <= current.rmse and one.cv_rmse <= current.cv_rmse]
    clear = [
        one
        for one in found
        if fits(selection, one) and selection.share(without, one) > NAMED and _told(selection, without, one)
    ]
    if not clear:
        return current
    return _alone(selection, selection.workers.map([("extended", selection.simplest(clear), offset)])[0])


def _told(selection: Selection, smaller: Hypothesis, larger: Hypothesis) -> bool:
    """Do the data tell that the larger one is better, by however little?"""
    test, gain = selection.compared(smaller, larger)
    return test.p < LEVEL and gain > CLEAR


def _in_place_of_two(selection: Selection, current: Hypothesis) -> Hypothesis:
    """Two formulas may come near the noise together where one effect has another formula: a free form of the family of
    one of them that does clearly better than both on samples left out is one claim less. So it must do than another
    name that would do as well in the place of one of them. Two that are one wave are so by themselves: the form of
    their family only has to do no worse."""
    effect, adopted = selection.fitter.stack.effect, selection.adopted(current)
    forms = [form for form in selection.forms if form not in current.names and not effect(form).estimates]
    tried: list[Hypothesis] = []
    waves = set()
    for first, second in combinations([name for name in adopted if name not in selection.forms], 2):
        families = {effect(first).family, effect(second).family}
        asked = [form for form in forms if effect(form).family in families]
        smaller = selection.without(selection.without(current, first), second) if asked else current
        other = (current.values, current.rmse)
        tried += selection.workers.map([("extended", smaller, form, *other) for form in asked])
        if len(families) == 1 and _one_wave(current, first, second):
            waves |= {smaller.names | {form} for form in asked}
    fitting = [one for one in tried if fits(selection, one)]
    if not fitting:
        return current
    rivals = [selection.rivals(current, name) for name in adopted]
    named = [one for each in rivals for key, one in each.items() if key not in selection.forms]
    least = min([current, *named], key=lambda one: one.cv_rmse)
    blocks = selection.fitter.blocks
    clear = [
        one
        for one in fitting
        if advantage(one.left_out, least.left_out, blocks) > (0.0 if one.names in waves else CLEAR)
    ]
    if not clear:
        return current
    return _alone(selection, selection.refitted(selection.simplest(clear)))


def _one_wave(current: Hypothesis, first: str, second: str) -> bool:
    """Does one of them repeat itself after the same length as the other, or after a whole part of it?"""
    periods = [current.values[key] for name in (first, second) if (key := f"{name}.period") in current.values]
    ratio = max(periods) / min(periods) if len(periods) == 2 else np.inf
    return ratio < np.inf and abs(ratio / round(ratio) - 1.0) < WHOLE


def _alone(selection: Selection, taken: Hypothesis) -> Hypothesis:
    """A free form that has taken a name's place, without the names beside it that it does not need near the noise."""
    fewer = _thinned(selection, taken)
    return fewer if fits(selection, fewer) else taken


def _joined(selection: Selection, start: Hypothesis, names: tuple[str, ...], most: int) -> Hypothesis:
    """With the free forms that the system asks for, each with the names that are found beside it, `most` in all."""
    current, seen, room = start, {start.names}, max(len(selection.adopted(start)) + 1, CLAIMS)
    for _ in range(CURVES):
        selection.candidates = (*names, *selection.forms)
        beside = len(selection.adopted(current)) < room
        better = _freed(selection, current, [form for form in selection.forms if form not in current.names], beside)
        if better is None or better.names in seen:
            break
        selection.candidates = _counted(selection, names, better)
        # what was named beside the wrong formula may be its fault, and it may have hidden what has a name
        current = selection.settled(selection.named(selection.run(better, most)))
        seen |= {better.names, current.names}
    return current


def _freed(selection: Selection, current: Hypothesis, forms: list[str], beside: bool) -> Hypothesis | None:
    """With one free form more, the one that does best; None where the names do as well as all of them.

    beside : where there is room for one, or else in the place of names alone"""
    if current.rmse <= REACHED * selection.floor:
        return None
    tried = [*selection.with_each(current, forms if beside else []), *_in_place(selection, current, forms)]
    found = [system for system in tried if _clearly(selection, current, system)]
    if not found:
        return None
    better = _thinned(selection, selection.refitted(selection.simplest(_fixed(selection, found))))
    # beside all that is named a free form is one claim more: a little misfit is too little for it
    more = len(selection.adopted(better)) > len(selection.adopted(current))
    return None if more and fits(selection, current) else better


def _fixed(selection: Selection, found: list[Hypothesis]) -> list[Hypothesis]:
    """Those that estimate nothing anew on every record, blocks left out too, where one of them is about as good."""
    effect = selection.fitter.stack.effect
    fixed = [one for one in found if not any(effect(name).estimates for name in selection.adopted(one))]
    best = min(found, key=lambda system: system.cv_rmse)
    return fixed if any(one.cv_rmse < ALIKE * best.cv_rmse for one in fixed) else found


def _in_place(selection: Selection, current: Hypothesis, forms: list[str]) -> list[Hypothesis]:
    """Every free form in the place of each name of its family, whose part it may not take over from beside it, such as
    a hum's fundamental from its overtone; or of a name that is tied with one of its family."""
    effect, candidates = selection.fitter.stack.effect, selection.candidates
    # a name tells a family as well as a free form does, which takes ten times as long to fit
    selection.candidates = tuple(one for one in candidates if one not in selection.forms or one in current.names)
    alike = {name: (name, *selection.rivals(current, name)) for name in selection.adopted(current)}
    selection.candidates = candidates
    pairs = [(n, f) for n in alike for f in forms if effect(f).family in {effect(one).family for one in alike[n]}]
    smaller = {name: selection.without(current, name) for name, _ in pairs}
    other = (current.values, current.rmse)
    return selection.workers.map([("extended", smaller[name], form, *other) for name, form in pairs])


def _clearly(selection: Selection, current: Hypothesis, system: Hypothesis) -> bool:
    """Does a system do clearly better, and explain more than what then remains?"""
    gain = advantage(system.left_out, current.left_out, selection.fitter.blocks)
    enough = gain > CLEAR and selection.share(current, system) > NAMED
    return enough and selection.needed(current, system, len(selection.candidates))


def _thinned(selection: Selection, current: Hypothesis) -> Hypothesis:
    """Without what is not needed any more, the least telling first."""
    while True:
        smaller = [selection.without(current, name) for name in selection.adopted(current)]
        spare = [system for system in smaller if not selection.needed(system, current)]
        if not spare:
            return current
        current = min(spare, key=lambda system: system.cv_rmse)
