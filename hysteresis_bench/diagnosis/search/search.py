"""The search: from the bare model to the effects that the data ask for, with all that was tried on the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.ceiling.ceiling import Ceiling, ceiling
from hysteresis_bench.diagnosis.evidence.evidence import Evidence
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import fitter_of
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.preparation import Prepared, thinned
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.disturbance import undisturbed
from hysteresis_bench.diagnosis.search.fallback import Fallback, fall_back, misleading, unseen_rmse
from hysteresis_bench.diagnosis.search.follows import follows
from hysteresis_bench.diagnosis.search.free_forms import with_free_forms
from hysteresis_bench.diagnosis.search.offset import with_simplest_offset
from hysteresis_bench.diagnosis.search.round import Round
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.fit.accuracy import simulated
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.progress import Step

QUIETER = 0.9
"""The noise without a disturbance that was found, over that with it, from which the search goes on with the new
estimate; and what the bare model leaves, over the floor, from which the noise is that in what it leaves: it explains
what moves fast, such as what a controller feeds back. In 144 made cases in open loop the latter was 0.95 at least, so
that twice the distance from 1 changes none of them."""


@dataclass(frozen=True, eq=False)
class Found:
    """What the search found.

    full, thin : fitters of all samples, and of those that the search worked on
    base : the bare model with each record's offset;  best : what was selected, with each record's offset
    final : the same with the simplest offset;  follows : does the response to the input explain the output?
    order : the adopted effects, the one that helps most first, each with the system that it completes
    given_up : what predicted excitations left out worse, or what one loop cannot test
    rivals : for each adopted effect, what would do as well in its place, and that system
    without : for each adopted effect, the selected system without it;  beyond : every other candidate on top of it
    impossible : effects that cannot be tried, with the reason
    """

    full: Fitter
    thin: Fitter
    evidence: Evidence
    selection: Selection
    base: Hypothesis
    best: Hypothesis
    final: Hypothesis
    follows: bool
    order: tuple[tuple[str, Hypothesis], ...]
    given_up: Fallback | None
    rivals: Mapping[str, Mapping[str, Hypothesis]]
    without: Mapping[str, Hypothesis]
    beyond: Round
    impossible: Mapping[str, str]

    @cached_property
    def ceiling(self) -> Ceiling:
        """What the best black box reaches on excitations left out, beside the final system."""
        return ceiling(self.thin, self.final, self.evidence.floor, self.evidence.noise)


def search(prepared: Prepared, evidence: Evidence, question: Question) -> Found:
    """In as many processes as the question's options say."""
    records, options, own = thinned(prepared.views), question.options, tuple(question.effects)
    like = judged(records, prepared.dataset).like
    full, thin = (
        fitter_of(Stack(prepared.model, part, own, question.bounds, question.fixed), options.seed, like=like)
        for part in (prepared.dataset.fitted, records)
    )
    possible, impossible = thin.stack.candidates()
    if question.among is not None:
        possible = tuple(name for name in possible if name in question.among)
    on_step = options.on_step
    with Workers[Hypothesis](thin, options.processes, on_step, options.kept) as workers:
        (base,) = workers.map([("bare", frozenset({registry.RECORD_OFFSET}))])
        evidence = _beside(evidence, full, base)
        selection = Selection(thin, workers, evidence.floor, possible)
        best = selection.run(base)
        quieter = evidence.heard_anew(undisturbed(full, selection.named(best)))
        if quieter.noise.floor < QUIETER * evidence.noise.floor:
            evidence = quieter
            selection.floor = evidence.floor
            best = selection.run(selection.named(best))
        on_step(Step("free forms in the place of names"))
        best = with_free_forms(selection, best)
        # what an effect led to, the model alone may reach as well
        base = min(base, selection.known.get(base.names, base), key=lambda one: one.rmse)
        on_step(Step("what the data say of the selection"))
        answers = follows(full, best)
        bare = Found(
            full=full,
            thin=thin,
            evidence=evidence,
            selection=selection,
            base=base,
            best=base,
            final=base,
            follows=answers,
            rivals={},
            without={},
            beyond=selection.rounds[0],
            order=(),
            given_up=None,
            impossible=impossible,
        )
        return _ending_with(bare, best if answers else base)


def _beside(evidence: Evidence, full: Fitter, system: Hypothesis) -> Evidence:
    """With the noise in what a system leaves, where that is clearly less than the floor: the floor was too high."""
    if system.rmse >= QUIETER * evidence.floor:
        return evidence
    built, values = full.fitted(system)
    return evidence.heard_beside(simulated(built, full.stack.records, values))


def with_more(found: Found, asked: Sequence[Sequence[str]]) -> Found:
    """With one of each of these groups of like effects, where it is needed and helps to predict records left out."""
    selection, best = found.selection, found.best
    for names in asked:
        needed = [system for system in selection.with_each(best, names) if selection.needed(best, system)]
        if needed:
            more = selection.refitted(selection.simplest(needed))
            best = more if unseen_rmse(found.thin, more) < unseen_rmse(found.thin, best) else best
    return found if best is found.best else replace(_ending_with(found, best), given_up=found.given_up)


def with_fewer(found: Found, names: Sequence[str]) -> Found:
    """Without these adopted effects, which nothing could test."""
    best = found.best
    for name in names:
        best = found.selection.without(best, name)
    ended = _ending_with(found, best)
    untested = Fallback(tuple(names), found.best.rmse, ended.best.rmse, found.base.rmse, tested=False)
    before = [one for one in (found.given_up, untested, ended.given_up) if one is not None]
    return replace(ended, given_up=reduce(Fallback.and_then, before))


def _ending_with(found: Found, best: Hypothesis) -> Found:
    """What is told of a selected system; where it predicts records left out worse than the bare model, of a smaller
    one."""
    selection, base = found.selection, found.base
    order = _in_order(selection, base, best)
    given_up = fall_back(found.thin, base, order, selection.floor)
    if given_up:
        order = order[: len(order) - len(given_up.dropped)]
        best = order[-1][1] if order else base
    without = {name: selection.without(best, name) for name in selection.adopted(best)}
    while worse := misleading(found.thin, base, best, without, selection.floor):
        best = without[worse.dropped[0]]
        given_up = worse if given_up is None else given_up.and_then(worse)
        without = {name: selection.without(best, name) for name in selection.adopted(best)}
        order = _in_order(selection, base, best)
    return replace(
        found,
        best=best,
        final=with_simplest_offset(selection, best),
        rivals={name: selection.rivals(best, name) for name in selection.adopted(best)},
        without=without,
        beyond=selection.tried_on(best),
        order=order,
        given_up=given_up,
    )


def _in_order(selection: Selection, base: Hypothesis, best: Hypothesis) -> tuple[tuple[str, Hypothesis], ...]:
    """The adopted effects, the one that helps most first, each with the system that it completes."""
    current, steps = base, []
    while left := best.names - current.names:
        names = sorted(left)
        ranked = zip(selection.with_each(current, names), names, strict=True)
        current, most = min(ranked, key=lambda pair: pair[0].rmse)
        steps.append((most, current))
    return tuple(steps)
