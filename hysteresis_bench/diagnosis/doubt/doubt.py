"""Where more is left than the noise allows: is another law the cause? If none is, which names hold whatever the law?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.agreement import Agreement, agreement, alike, is_rate_independent, is_shape
from hysteresis_bench.diagnosis.doubt.carrying import carrying
from hysteresis_bench.diagnosis.doubt.cause import Cause, law_as_cause, made_of_shapes, most_parameters
from hysteresis_bench.diagnosis.doubt.other_laws import OFFSET, Contender, OtherLaws
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.search import Found, with_fewer, with_more
from hysteresis_bench.diagnosis.search.selection import MISFIT, REACHED
from hysteresis_bench.diagnosis.search.sets import fits

SCREENED = 1000
"""Samples to which every law is fitted first. With half and with twice as many the same laws passed on four made cases,
in 0.9 and in 1.4 times the time."""


@dataclass(frozen=True)
class Doubt:
    """cause : the law that does clearly better;  agreement : of the laws, where none leaves about the noise
    untested : far from the noise, only one excitation speaks for what was adopted, of one amplitude and frequency
    carrying : what was adopted and carries the loop alone; what has no dynamics may be of its shape then
    free : free forms that were adopted though the noise is not reached: they follow any law's fault
    own : effects that the law says may be its own shape, and why
    """

    cause: Cause | None = None
    agreement: Agreement | None = None
    untested: bool = False
    carrying: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    own: Mapping[str, str] = field(default_factory=dict)

    @property
    def raised(self) -> bool:
        """Is there any?"""
        return self.of_the_law or bool(self.carrying or self.free or self.own)

    @property
    def of_the_law(self) -> bool:
        """Is the law itself in question: does another one do better, were laws asked, or is there too little to ask?"""
        return self.cause is not None or self.agreement is not None or self.untested

    @property
    def undecided(self) -> bool:
        """May what was adopted be a part of the right law, though no other law does better for certain?"""
        cause = self.cause
        return self.agreement is not None or self.untested or (cause.as_well if cause else bool(self.free or self.own))

    def asks_for(self, adopted: Sequence[str]) -> list[str]:
        """Effects that are needed, and for which nothing alike was adopted."""
        matched = self._matched(adopted)
        return [name for name in self._needed if name not in matched.values()]

    def holding(self, adopted: Sequence[str]) -> dict[str, tuple[str, ...]]:
        """Of the adopted effects those that are more than stand-ins for the law, as far as is known, each with what is
        taken in its place around other laws."""
        others = {*self.carrying, *self.free, *self.own, *(filter(is_shape, adopted) if self.carrying else ())}
        adopted = [name for name in adopted if name not in others]
        if not self.of_the_law:
            return {name: () for name in adopted}
        likes = self.agreement.effects if self.agreement else {}
        groups = {name: (needed, *likes.get(needed, ())) for name, needed in self._matched(adopted).items()}
        return {name: tuple(other for other in group if other != name) for name, group in groups.items()}

    def _matched(self, adopted: Sequence[str]) -> dict[str, str]:
        """One adopted effect for each that is needed: itself, or else the first one like it."""
        matched = {name: name for name in adopted if name in self._needed}
        for needed in (name for name in self._needed if name not in matched):
            left = [name for name in adopted if name not in matched and alike(name, needed)]
            matched |= {name: needed for name in left[:1]}
        return matched

    @property
    def _needed(self) -> tuple[str, ...]:
        """Around the better law, and whatever the law, where these are known."""
        if self.agreement is None:
            return self.cause.effects if self.cause else ()
        agreed = tuple(self.agreement.effects)
        around = self.cause.effects if self.cause else agreed
        return tuple(name for name in agreed if any(alike(name, other) for other in around))


def doubt(found: Found, question: Question, laws: Sequence[str], witnesses: Sequence[str]) -> Doubt:
    """laws : which may be the right one
    witnesses : which are asked what they need; without any only a better law is sought
    """
    options, stack, asked, floor = question.options, found.thin.stack, question.model, found.selection.floor
    final = Contender(asked, found.selection.adopted(found.best), found.thin.unseen(found.final))
    forms = tuple(forms_of(final.effects))
    known = Doubt(
        carrying=carrying(found),
        free=() if fits(found.selection, found.best) else forms,
        own={name: why for name, why in stack.model.own_shapes.items() if name in final.effects},
    )
    imitated = made_of_shapes(final, floor)
    if not found.follows or (final.rmse <= REACHED * floor and not forms and not imitated):
        return known
    few = thinned(views_of(stack.records), SCREENED)
    # together with a law, what has no dynamics may make another law: does one follow without?
    effects = tuple(name for name in in_question(found) if not (imitated and is_shape(name)))
    around = OtherLaws(asked, stack, few, effects, floor, options.seed, _values(found))
    level = _level(found)
    own = final if level is found else replace(final, errors=found.thin.unseen(level.final))
    untested = bool(final.effects) and found.final.rmse > WRONG * floor and not found.thin.excitations.varied
    wrong = found.final.rmse > WRONG * floor or final.rmse > MISFIT * floor
    others = [name for name in dict.fromkeys([*laws, *(witnesses if wrong else ())]) if name != asked]
    most = most_parameters(level, own)
    if not wrong and own.rmse <= REACHED * floor:  # at the noise none does clearly better
        others = [name for name in others if len(registry.build("models", name, {}).parameters) <= most]
    with Workers[Contender](around, options.processes, options.on_step, options.kept) as workers:
        screened = workers.map([("screened", name) for name in others])
        cause = law_as_cause(level, own, [one for one in screened if one.model in laws], most, few, workers)
        if not wrong or not witnesses or (cause and cause.unseen <= REACHED * floor):
            return replace(known, cause=cause, untested=untested)
        (own,) = workers.map([("needy", asked)])
        good = [one.model for one in screened if one.rmse <= own.rmse and is_rate_independent(one.model)]
        needy = workers.map([("needy", name) for name in good])
        shaped = is_rate_independent(asked) and any(map(is_shape, (*own.effects, *forms)))
        agreed = agreement(own, needy) if needy or shaped else None
        return replace(known, cause=cause, agreement=agreed, untested=untested)


def answered(found: Found, doubted: Doubt, options: DiagnosisOptions) -> Found:
    """With what is needed and was not adopted, and with the rivals that other laws take in the place of what was."""
    with Workers[Hypothesis](found.thin, 1, options.on_step, options.kept) as workers:
        selection = found.selection
        selection.workers = workers
        lacking = doubted.asks_for(selection.adopted(found.best))
        left = [name for name in selection.candidates if name not in found.best.names]
        found = with_more(found, [[one for one in left if alike(one, name)] for name in lacking])
        held = doubted.holding(tuple(found.rivals))
        # what may stand in for the law stays where it helps to predict; of one loop nobody knows
        if found.thin.excitations.only_one and (spare := [name for name in found.rivals if name not in held]):
            found = with_fewer(found, spare)
        rivals = {
            name: {
                other: system
                for other, system in selection.alternatives(found.best, name).items()
                if other in known or (other in held.get(name, ()) and system.rmse <= WRONG * found.best.rmse)
            }
            for name, known in found.rivals.items()
        }
        return replace(found, rivals=rivals)


def in_question(found: Found) -> tuple[str, ...]:
    """The formulas that were adopted, on the way too or to be given up, and what would do as well in their place."""
    names = {*found.selection.adopted(found.best), *(found.given_up.dropped if found.given_up else ())}
    names |= {one.chosen for one in found.selection.rounds if one.chosen}
    names |= {rival for rivals in found.rivals.values() for rival in rivals}
    return tuple(sorted(names - {*forms_of(tuple(names))}))


def _level(found: Found) -> Found:
    """With a constant a record, as every other law has: whatever lifts a record is no other law's."""
    names = (found.final.names - {*registry.OFFSETS}) | OFFSET
    if names == found.final.names:
        return found
    return replace(found, final=found.thin.followed(replace(found.final, names=names)))


def _values(found: Found) -> dict[str, float]:
    """Of all parameters that were tried, each in the best system with it, the final one before all."""
    known = sorted(found.selection.known.values(), key=lambda one: one.rmse, reverse=True)
    return {name: value for one in (*known, found.final) for name, value in one.values.items()}
