"""A diagnosis in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from hysteresis_bench import registry
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.doubt.cause import Cause
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.evidence.evidence import Evidence
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.findings.remainder import Remainder, other_zero
from hysteresis_bench.diagnosis.findings.stages import Stage, own_zeros, refuted
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis.search.fallback import was_or_were
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import MISFIT
from hysteresis_bench.fit.checks.advised import advice_with, more_parts
from hysteresis_bench.fit.checks.edges import edges_told
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.unseen.between_samples import TELLING, between_samples

CAUSES = "slow noise, noise of the input, a cause that was not measured, or the law's own fault"


@dataclass(frozen=True, eq=False)
class Outcome:
    """What is to be told: both ends, what was adopted on the way, and whether something remains.

    left : in the residual;  units : of the output, as the records have it
    model : the law that was asked about;  doubt : whether the law is wrong, and what holds whatever the law
    alone : one record was measured, and what is held out is a part of it
    """

    before: Stage
    after: Stage
    adopted: tuple[str, ...]
    found: Found
    ties: Sequence[Tie]
    left: Remainder
    units: Mapping[str, str]
    model: str
    doubt: Doubt
    alone: bool

    @property
    def cause(self) -> Cause | None:
        return self.doubt.cause

    @property
    def evidence(self) -> Evidence:
        return self.found.evidence

    @property
    def unit(self) -> str:
        """Of the output, as it follows a number; "" where it is plain."""
        own = self.units.get("output", "1")
        return "" if own == "1" else f" {own}"

    @property
    def carries_over(self) -> bool:
        """Does what was adopted also help where it was not fitted? True where nothing was held out."""
        before, after = self.before.held_out, self.after.held_out
        return before is None or after is None or after.rmse <= before.rmse

    @property
    def refuted(self) -> bool:
        """Does what was held out contradict what was adopted?"""
        return refuted(self.before, self.after, self.evidence.floor)

    @property
    def stand_ins(self) -> tuple[str, ...]:
        """Of what was adopted, what only stands in for the law: all of it where what was held out contradicts it. An
        offset for all records is a finding only where nothing else is left, and neither a curve nor what follows a
        temperature was needed, whose zero is as it happens."""
        names = [name for name in self.adopted if name != registry.DESCRIPTION]
        spare = {*names} - {*(() if self.refuted else self.doubt.holding(names))}
        if self.unexplained or forms_of(tuple(names)) or any(registry.effect(name).wants for name in names):
            spare.add(registry.COMMON_OFFSET)
        return tuple(name for name in self.adopted if name in spare)

    @property
    def named(self) -> tuple[str, ...]:
        """Of what was adopted, what is claimed."""
        return tuple(name for name in self.adopted if name not in self.stand_ins)

    @property
    def unexplained(self) -> bool:
        left = self.left.matters or self.left.louder or self.leaves_much
        wrong = self.cause is not None or bool(self.doubt.carrying or self.doubt.own)
        return left or not self.found.follows or not self.carries_over or wrong

    @property
    def leaves_much(self) -> bool:
        """Is much more left than the noise, of any kind, on what was fitted or on what was held out?"""
        fitted, held_out = self.leaves
        noise = fitted if self.left.noise else 1.0
        return max(fitted, held_out) > WRONG * noise

    @property
    def doubted(self) -> bool:
        """Is so much left that the names may stand in for what is wrong with the law?"""
        raised = self.doubt.of_the_law or bool(self.doubt.carrying)
        return (self.leaves_much or bool(self.doubt.free)) and not raised

    @property
    def doubtful(self) -> bool:
        """May the names be wrong, because much is left, or because they do not help where they were not fitted? That
        all laws need them on what was fitted is no answer to the latter."""
        return self.doubted or not self.carries_over or self.left.louder

    @property
    def leaves(self) -> tuple[float, float]:
        """RMSE of the final system over the floor: on what was fitted, and on what was held out."""
        return self.after.fitted.rmse / self.evidence.floor, self.after.missed / self.evidence.floor

    @property
    def reaches(self) -> bool:
        """Does the final system come down to the noise, on what was fitted and on what was held out?"""
        return max(self.leaves) <= MISFIT


def headline(outcome: Outcome) -> str:
    """The verdict, with the error before and after; an effect that is tied is never named alone, and one beside
    which much more than the noise is left is named with a doubt."""
    before, after, doubt = outcome.before, outcome.after, outcome.doubt
    unit = outcome.unit
    first, last = (stage.held_out or stage.fitted for stage in (before, after))
    where = "on what was held out" if after.held_out else "on what was fitted"
    if not outcome.found.follows:
        return "The output does not follow the input: the model explains less than half of it, and no effect is named."
    effects = [name for name in outcome.named if name != registry.DESCRIPTION]
    moves = "falls" if last.rmse < first.rmse else "does NOT fall, it goes"
    moved = f"{where} the RMSE {moves} from {first.rmse:.3g} to {last.rmse:.3g}{unit}"
    if effects:
        named = listed([_or_its_rivals(name, outcome.ties) for name in effects])
        said = f"The model {'may lack' if outcome.doubtful else 'lacks'} {named}: {moved}"
    elif outcome.refuted and outcome.stand_ins:
        said = f"No effect is named, as what helps on what was fitted does not carry over: with it, {moved}"
    elif outcome.stand_ins and doubt.undecided:
        said = f"No effect is named, as what helps may be the law's own: with it, {moved}"
    elif (outcome.cause or doubt.carrying) and outcome.stand_ins:
        said = f"No effect is named, as the law itself is the cause: with what makes up for it, {moved}"
    elif doubt.agreement:
        said = f"No effect is named: {where} the RMSE is {last.rmse:.3g}{unit}"
    elif outcome.cause:
        said = f"No effect is named, as the law itself is the cause: {where} the RMSE is {last.rmse:.3g}{unit}"
    else:
        none = "No effect is named" if outcome.unexplained else "No effect that is known here is missing"
        said = f"{none}: {where} the RMSE is {last.rmse:.3g}{unit}"
    said = f"{said}; {outcome.evidence.told}."
    said += other_zero(after, outcome.evidence.floor, unit)
    if registry.DESCRIPTION in outcome.adopted:
        said += " Terms that describe what was left, without explaining it, have been added."
    if doubt.raised:
        said += f" {' '.join(_of_the_law(outcome, unit))}"
    elif outcome.left.louder and outcome.leaves[0] <= WRONG:
        said += f" What was held out is missed by {rounded(outcome.leaves[1])} times the noise: something is lacking."
    elif outcome.unexplained:
        said += " Something is left that no effect explains."
    elif outcome.left.slow and outcome.leaves[0] > WRONG:
        left = f"{rounded(outcome.leaves[0])} times the noise from sample to sample"
        said += f" What is left is {left}: slow noise, or a cause that these records do not show."
    return f"{said} {outcome.left.shape}".rstrip()


def _of_the_law(outcome: Outcome, unit: str) -> Iterator[str]:
    """What a better law does, what all laws need, and what then only stands in for the law."""
    cause, agreed = outcome.cause, outcome.doubt.agreement
    if cause:
        better = f"{cause.model} with {listed(cause.effects)}" if cause.effects else f"{cause.model} alone"
        own = f"{outcome.model} with all that helps it" if outcome.adopted else outcome.model
        words = "Another law follows as well" if cause.as_well else "What is left is the law's"
        where = "parts of what was fitted, left out in turn," if outcome.alone else "fitted records left out in turn"
        yield f"{words}: on {where} {better} leaves {cause.unseen:.3g}{unit}, {own} leaves {cause.own:.3g}{unit}."
    elif outcome.doubt.carrying:
        carried = f"{listed(outcome.doubt.carrying)} carries the loop, without which {outcome.model} has next to none:"
        yield f"{carried} no effect around this law, but another law."
    elif outcome.reaches:
        helping = "these effects" if outcome.named else "what helps"
        yield f"{outcome.model} alone does not follow the data; with {helping} it does."
    elif outcome.found.ceiling.finds_nothing:
        yield f"No law here reaches the noise, and no black box does clearly better: what is left may be {CAUSES}."
    else:
        yield "The law itself does not follow the data, and no other one here does clearly better."
    if agreed and (names := [name for name in outcome.named if name != registry.DESCRIPTION]):
        _, *others = agreed.needs
        without = f"does without {listed(names)} or the like"
        if len(others) > 1:
            yield f"None of the {len(others)} other laws that leave no more {without}."
        elif others or (outcome.reaches and not cause):
            yield f"No other law that leaves no more {without}." if others else "No other law here leaves as little."
    if refused := outcome.doubt.asks_for(outcome.adopted):
        yield f"{listed(refused)} would be needed too, but does not help {outcome.model} to predict records left out."
    if outcome.stand_ins:
        alike: dict[str, list[str]] = {}
        for name in (one for one in outcome.stand_ins if one not in outcome.doubt.carrying):
            why = outcome.doubt.own.get(name) or (agreed.without(name) if agreed else "")
            alike.setdefault(why, []).append(name)
        disputed = [f"{listed(names)} ({reason})" if reason else listed(names) for reason, names in alike.items()]
        if disputed:
            yield f"{', and '.join(disputed)} may stand in for the law."


def _or_its_rivals(name: str, ties: Sequence[Tie]) -> str:
    rivals = [tie.rival for tie in ties if tie.effect == name]
    if family := forms_of((name,)).get(name):
        return f"{name} (of the family {family}; no formula here fits)"
    return f"{name} (or {', '.join(rivals)}: these records cannot tell)" if rivals else name


def _times(outcome: Outcome) -> str:
    fitted, held_out = outcome.leaves
    if fitted > WRONG:
        return f"{rounded(fitted)} times the noise"
    return f"{rounded(held_out)} times the noise on what was held out, and {rounded(fitted)} times on what was fitted"


def warnings(outcome: Outcome) -> tuple[str, ...]:
    """What a user must know before believing the names."""
    found, final, after, floor = outcome.found, outcome.found.final, outcome.after, outcome.evidence.floor
    records = found.full.stack.records
    said = list(advice_with(found.full.stack.model, final.names, records))
    if found.given_up:
        said.insert(0, found.given_up.told(floor))
    if outcome.refuted and outcome.stand_ins:
        were, them = was_or_were(outcome.stand_ins)
        selected = f"{listed(outcome.stand_ins)} {were} selected on what was fitted, and {were} not named"
        said.insert(
            0,
            f"{selected}: what was held out is predicted worse with {them} than by the bare model, which `fit` writes.",
        )
    elif not outcome.carries_over:
        said.insert(0, "What was adopted does not carry over to the held-out records: do not believe the names.")
    # a zero that lies elsewhere is no fault of a law that follows what was fitted
    followed = outcome.reaches or (outcome.leaves[0] <= MISFIT and other_zero(after, floor, ""))
    if found.follows and not followed and (outcome.doubted or outcome.doubt.agreement):
        blamed = (
            f"of which a black box finds nothing in the input's past: {CAUSES}"
            if found.ceiling.finds_nothing and not outcome.cause
            else "and the model's own law does not follow these data"
        )
        may = ". What is named may stand in for that" if outcome.doubted and outcome.named else ""
        said += [
            f"The final system still leaves {_times(outcome)}, {blamed}{may}.",
            *more_parts(found.full.stack.model),
        ]
    fitted, held_out = outcome.leaves
    if after.between > TELLING * max(floor, after.fitted.rmse):
        said.append(
            f"The samples of what was held out are few for this law: finer steps between them change its response by "
            f"{after.between:.2g} (RMS), {rounded(after.between / floor)} times the noise. Its error says little."
        )
    elif after.held_out and MISFIT * max(fitted, 1.0) < held_out <= WRONG * max(fitted, 1.0):
        said += [
            f"What was held out is missed by {rounded(held_out)} times the noise, what was fitted by {rounded(fitted)}:"
            " what was fitted does not tell all. Fit what was held out too, and hold out another excitation.",
            *more_parts(found.full.stack.model),
        ]
    if zeros := own_zeros(after, records, after.held_out is not None, outcome.unit):
        said.append(zeros)
    if outcome.cause:
        said.append(f"Ask again with the law {outcome.cause.model}: what is missing around it is another question.")
    elif outcome.doubt.carrying:
        said.append("Ask again without a model: then the law is looked for among all that are known here.")
    if outcome.left.noise and not outcome.cause:
        said.append(outcome.left.told_as_noise(after.fitted.rmse / floor))
    steps = between_samples(after.problem.system, records, after.values)
    if steps > TELLING * floor:
        said.append(
            f"The samples are few for this law: finer steps between them change its response by {steps:.2g} (RMS), "
            f"{rounded(steps / floor)} times the noise. Effects may make up for that. Records with more samples a "
            "cycle would tell."
        )
    if not found.follows:
        said.append("The output does not follow the input; whatever would fit it is no diagnosis.")
    at_edges: dict[str, dict[str, float]] = {}
    for name in final.at_bound:
        at_edges.setdefault(name.rpartition(".")[0], {})[name] = final.values[name]
    for effect, values in at_edges.items():
        said.append(f"{edges_told(values)}{f': {effect} may stand in for something else' if effect else ''}.")
    if outcome.alone and after.held_out:
        said.append(
            "One record only: what is held out comes from the same experiment, at the same speed and amplitude."
        )
    if max(outcome.evidence.noise.floor, outcome.evidence.unknown) < 0.5 * floor:
        said.append("The data have next to no noise; below a few parts in ten thousand of the range nothing is judged.")
    for one in outcome.ties:
        said.append(f"{one.effect} and {one.rival} cannot be told apart on these records: {one.reason}.")
    return tuple(said)
