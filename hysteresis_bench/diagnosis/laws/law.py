"""One law, fitted: a model with known effects and an offset a record, and how it predicts what is left out."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.laws.surroundings import drifts, linear_dynamics
from hysteresis_bench.fit.accuracy import accuracy, simulated
from hysteresis_bench.fit.checks.asked import around_faults
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.fit.least_squares import point_of
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.settling import gap_after
from hysteresis_bench.fit.smooth.rough import Rough, solvable
from hysteresis_bench.fit.smooth.smoothing import Smoothing
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.left_out import FURTHER, errors_without, left_out_errors
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.fit.unseen.outside import outside
from hysteresis_bench.fit.unseen.whole import last_part, left_out
from hysteresis_bench.signals import Dataset, Record

SEARCHES, ALIKE = 4, 1e-3
"""Searches from different seeds, and the share by which the errors of two that agree differ at most."""
CHEAP = 20000
"""Simulated samples times parameters up to which a search is made again."""


@dataclass(frozen=True, eq=False)
class Law:
    """A model as the law of some records.

    unseen : (scored samples of the thinned records,) errors of what was left out, by a fit to the rest
    parameters : how many, effectively where they are smooth
    fitted, held_out : RMSE over all samples, unit of the output; NaN where there are none
    seconds : CPU time;  reason : why there is no fit, "" where there is one
    ahead : errors of a lone record's last part, by a fit to what came before; empty where there are several
    outside : share of the fitted outputs' range by which it leaves it on inputs that are held out
    gap : how far the last two passes of a loop that is passed before it is scored differ, a share of its range
    found : as it was fitted to thinned records; None where it was not, or is smooth
    """

    model: str
    reason: str = ""
    fitted: float = np.nan
    held_out: float = np.nan
    unseen: Array = field(default_factory=lambda: np.empty(0))
    parameters: int = 0
    seconds: float = 0.0
    ahead: Array = field(default_factory=lambda: np.empty(0))
    outside: float = 0.0
    gap: float = 0.0
    found: Hypothesis | None = field(default=None, repr=False)

    @property
    def rmse(self) -> float:
        """On what was left out, unit of the output; infinite where there is no fit."""
        return both(self.unseen, self.ahead) if self.unseen.size else np.inf


@dataclass(frozen=True, eq=False)
class Laws:
    """Fits laws to records, each by itself, so that they can be fitted side by side.

    records : thinned, that a law is searched on;  dataset : all samples, and what is held out
    effects : known to act around every law
    loops : whole, of which the fitted records are what is fitted;  passes : of them before they are scored, 0 for none
    """

    records: tuple[Record, ...]
    dataset: Dataset
    effects: tuple[str, ...] = ()
    seed: int = 0
    loops: tuple[Record, ...] = ()
    passes: int = 0

    def fitter(self, name: str, records: Sequence[Record], run: int = 0) -> Fitter:
        """Of one law, with its default settings; run : changes the seed."""
        return Fitter(Stack(registry.build("models", name, {}), tuple(records), self.effects), self.seed + run)

    def law(self, name: str, known: Hypothesis | None = None) -> Law:
        """Fitted, or with the reason why not; from a `known` fit to fewer passes where there is one."""
        begun = time.process_time()
        if faults := around_faults(name, self.effects):
            return Law(name, " ".join(faults))
        fitter = self.fitter(name, self.records)
        if reasons := self._reasons(fitter):
            return Law(name, " ".join(reasons))
        problem = fitter.stack.problem({registry.RECORD_OFFSET})
        if isinstance(problem.system.model, Rough):
            return self._smoothed(name, problem, begun)
        found = self._found(name) if known is None else fitter.followed(known)
        count = problem.space.dimension
        if found.rmse >= 0.999 * _spread(self.records):
            return Law(name, "it follows these records no better than a constant.", parameters=count)
        unseen, ahead = self._left_out(problem, found)
        full = self.fitter(name, self.dataset.fitted)
        system, values = full.stack.problem(found.names).system, full.polished(found)
        law = self._law(name, system, values, unseen=unseen, parameters=count, begun=begun, ahead=ahead)
        return replace(law, found=found)

    def with_dynamics(self, law: Law) -> Law:
        """Beside drifts, and behind or before free linear dynamics, as far as it predicts what is left out better so.
        What it predicts, its parameters and what was found are then those with them; all else is the law's."""
        fitter = self.fitter(law.model, self.records)
        best = law
        for names in (drifts(fitter.stack), linear_dynamics(fitter.stack)):
            best = self._moved(fitter, best, best, names)
        return best

    def with_any(self, law: Law, known: Law, asked: Callable[[Stack], Sequence[str]]) -> Law:
        """What is `known` of a law, or the law alone with one of the effects that are asked of its stack, where that
        predicts better."""
        fitter = self.fitter(law.model, self.records)
        return self._moved(fitter, law, known, asked(fitter.stack))

    def _moved(self, fitter: Fitter, law: Law, known: Law, names: Sequence[str]) -> Law:
        """What is `known` of a law, or the law with that one of these effects more that predicts best.

        A least-squares fit to all parts leaves no more of each than one to the other parts does. So what leaves more of
        what it was fitted to than the best so far leaves of what was left out cannot be better, and is not asked."""
        if law.found is None:
            return known
        best, last = known, last_part(self.records)
        for found in sorted((fitter.extended(law.found, name) for name in names), key=lambda one: one.rmse):
            if both(found.residuals, found.residuals[last]) < best.rmse:
                problem = fitter.stack.problem(found.names)
                unseen, ahead = self._left_out(problem, found)
                moved = replace(law, unseen=unseen, ahead=ahead, parameters=problem.space.dimension, found=found)
                best = min(best, moved, key=lambda one: one.rmse)
        return best

    def _left_out(self, problem: Problem, found: Hypothesis) -> tuple[Array, Array]:
        """Errors of what is left out, and of a lone record's last part, as of `Law`."""
        point, last = point_of(problem, found.values), last_part(self.records)
        unseen = left_out_errors(problem, point, left_out(self.records).blocks, FURTHER)
        return unseen, errors_without(problem, point, Blocks(~last, ~last, 1))[last, 0] if last.any() else unseen[last]

    def _found(self, name: str) -> Hypothesis:
        """The best of searches from different seeds, where they are cheap until two of them agree, and of what is come
        upon from the law without effects, which agrees with itself whatever the seed."""
        found, names = list[Hypothesis](), frozenset({registry.RECORD_OFFSET})
        for run in range(SEARCHES):
            fitter = self.fitter(name, self.records, run)
            found.append(fitter.from_anywhere(names))
            first, *others = sorted(one.rmse for one in found)
            size = sum(record.time.size for record in self.records) * len(found[0].values)
            if size > CHEAP or any(other <= (1.0 + ALIKE) * first for other in others):
                break
        return min([*found, *self.fitter(name, self.records).step_by_step(names)], key=lambda one: one.rmse)

    def _smoothed(self, name: str, problem: Problem, begun: float) -> Law:
        """A law of many linear parameters, as smooth as predicts best."""
        found = Smoothing(problem).searched(judged(self.records, self.dataset))
        full = self.fitter(name, self.dataset.fitted).stack.problem({registry.RECORD_OFFSET})
        values, last = Smoothing(full).refitted(found), last_part(self.records)
        ahead = Smoothing(problem).without(found, Blocks(~last, ~last, 1))[last, 0] if last.any() else np.empty(0)
        judged_by = {"unseen": found.left_out, "ahead": ahead}
        return self._law(name, full.system, values, parameters=round(found.freedom), begun=begun, **judged_by)

    def _law(
        self, name: str, system: System, values: Array, *, unseen: Array, ahead: Array, parameters: int, begun: float
    ) -> Law:
        """With its errors over all samples of the fitted and of the held-out records; NaN where there are none."""
        fitted, held_out = (
            accuracy(system, records, values).rmse if records else np.nan
            for records in (self.dataset.fitted, self.dataset.held_out)
        )
        away = outside(simulated(system, self.dataset.held_out, values), self.dataset)
        gap = gap_after(system, self.loops, values, repeats=self.passes) if self.passes else 0.0
        return Law(
            name,
            fitted=fitted,
            held_out=held_out,
            unseen=unseen,
            parameters=parameters,
            seconds=time.process_time() - begun,
            ahead=ahead,
            outside=away,
            gap=gap,
        )

    def _reasons(self, fitter: Fitter) -> list[str]:
        system = fitter.stack.system(())
        reasons = [f"{name}: {why}" for name, effect in system.effects if (why := effect.inapplicable(self.records))]
        if isinstance(system.model, Rough) and not solvable(system):
            reasons.append("behind these effects its output is not linear in its many weights, which are solved for.")
        samples = sum(record.measured.size for record in self.records)
        count = len(system.parameters)
        if samples <= 2 * count and not isinstance(system.model, Rough):
            reasons.append(f"{samples} samples are too few for its {count} parameters.")
        return reasons or broken_promises(system, self.records)


def both(unseen: Array, ahead: Array) -> float:
    """RMS of what was left out, the last part of a lone record as much as the parts within it."""
    squares = [float(np.mean(errors**2)) for errors in (unseen, ahead) if errors.size]
    return float(np.sqrt(np.mean(squares)))


def _spread(records: Sequence[Record]) -> float:
    """RMS of the outputs about each record's own mean."""
    return float(np.sqrt(np.mean(np.concatenate([(r.measured - np.mean(r.measured)) ** 2 for r in records]))))
