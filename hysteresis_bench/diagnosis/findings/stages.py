"""Before and after: the bare and the final system fitted to all samples, with the same offset."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest, residual_tests
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.preparation import Prepared
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.reading.lone_samples import lone_part
from hysteresis_bench.diagnosis.search.fallback import WORSE
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.accuracy import Accuracy, accuracy, constant_error
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.smooth.rough import Rough
from hysteresis_bench.fit.unseen.between_samples import between_samples
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class Stage:
    """A system with its parameters, and how far it is from the measurements.

    values : (dimension,), in units;  names : of its effects
    between : RMS of what finer steps change of the response to what was held out, unit of the output
    constant : RMS of the constants by which what was held out is missed
    lone : RMS that lone samples add to it, which are no fault of the system's
    """

    names: tuple[str, ...]
    problem: Problem
    values: Array
    fitted: Accuracy
    held_out: Accuracy | None
    tests: tuple[ResidualTest, ...]
    between: float = 0.0
    constant: float = 0.0
    lone: float = 0.0

    @property
    def missed(self) -> float:
        """RMSE on what was held out without lone samples, or on what was fitted where nothing was held out."""
        return float(np.sqrt(max(self.held_out.rmse**2 - self.lone**2, 0.0))) if self.held_out else self.fitted.rmse


@dataclass(frozen=True, eq=False)
class Stages:
    """offset : "" or the name of the effect that both have as an offset, or that only the final system needs
    adopted : effects that the final system has more
    waterfall : label and RMSE on all fitted samples, from the bare model to the final system
    """

    before: Stage
    after: Stage
    offset: str
    adopted: tuple[str, ...]
    waterfall: tuple[tuple[str, float], ...]


def refuted(before: Stage, after: Stage, floor: float) -> bool:
    """Is what was held out predicted worse after than before, by more than an effect must gain where it is fitted?

    floor : RMS below which nothing is judged
    """
    if before.held_out is None or after.held_out is None:
        return False
    return after.held_out.rmse > WORSE * max(before.held_out.rmse, floor)


def settle_offset(prepared: Prepared, found: Found, question: Question) -> Stages:
    """Fit both ends to all samples. Where more than an offset is missing, before has the offset too: the gain is the
    effects' own."""
    final, order = found.final, found.order
    offset = next((name for name in registry.OFFSETS if name in final.names), "")
    common = registry.COMMON_OFFSET
    # the curves of a density begin at 0, wherever the output does
    own = isinstance(prepared.model, Rough)
    adopted = (*(name for name, _ in order), *([common] if offset == common and not own else []))
    nuisance = frozenset(registry.OFFSETS if order or own else [registry.RECORD_OFFSET]) & final.names
    bare = found.thin.bare(nuisance)
    if final.names == nuisance and final.rmse < bare.rmse:
        before = after = stage_of(found, final, prepared)
    else:
        before = stage_of(found, bare, prepared)
        after = before if final.names == nuisance else stage_of(found, final, prepared)
    return Stages(before, after, offset, adopted, _waterfall(found, question.model, before, after))


def stage_of(found: Found, hypothesis: Hypothesis, prepared: Prepared) -> Stage:
    """A system fitted to all samples, and its errors on what was fitted and what was not."""
    fitter = found.full
    problem = fitter.stack.problem(hypothesis.names)
    values = fitter.polished(hypothesis)
    ready, system = prepared.dataset, problem.system
    residuals = split(fitter.errors(hypothesis.names, values), ready.fitted)
    return Stage(
        tuple(name for name, _ in system.effects),
        problem,
        values,
        accuracy(system, ready.fitted, values),
        accuracy(system, ready.held_out, values) if ready.held_out else None,
        tuple(residual_tests(found.evidence.views, residuals)),
        between_samples(system, ready.held_out, values),
        constant_error(system, ready.held_out, values),
        lone_part(system, values, ready.held_out, found.selection.floor),
    )


def own_zeros(stage: Stage, records: Sequence[Record], held_out: bool, unit: str) -> str:
    """A sentence, where every record has a constant of its own, estimated on it, held-out ones too; else "".

    records : those that were fitted;  unit : of the output, as it is told"""
    if registry.RECORD_OFFSET not in stage.names or len(records) == 1:
        return ""
    at, column = stage.names.index(registry.RECORD_OFFSET), stage.values[:, None]
    zeros = {record.name: float(stage.problem.system.offsets(record, column)[at][0]) for record in records}
    low, high = min(zeros, key=lambda name: zeros[name]), max(zeros, key=lambda name: zeros[name])
    return (
        f"Every record has a zero of its own, from {zeros[low]:.3g}{unit} ({low}) to {zeros[high]:.3g}{unit} ({high}): "
        f"errors are told beside it{', also of what was held out' if held_out else ''}. Of a new record nobody knows "
        f"it; `predict` takes the middle one, {float(np.median([*zeros.values()])):.3g}{unit}."
    )


def left_by(stage: Stage, views: Sequence[View]) -> tuple[list[Array], list[Array]]:
    """Residuals (scored samples,) and simulated outputs (samples,), a record each."""
    column = stage.values[:, None]
    simulated = [stage.problem.system.respond(view.record, column)[:, 0] for view in views]
    return [view.y - part[view.record.scored] for view, part in zip(views, simulated, strict=True)], simulated


def _waterfall(found: Found, model: str, before: Stage, after: Stage) -> tuple[tuple[str, float], ...]:
    offsets = frozenset(before.names) & {*registry.OFFSETS}
    label = f"{model} with a bias" if registry.COMMON_OFFSET in offsets else f"{model} alone"
    bars = [(label, before.fitted.rmse)]
    for name, step in found.order[:-1]:
        values = {**found.final.values, **step.values}
        same = replace(step, names=(step.names - {*registry.OFFSETS}) | offsets, values=values)
        left = found.full.errors(same.names, found.full.polished(same))
        bars.append((name, float(np.sqrt(np.mean(left**2)))))
    if found.order or after is not before:
        bars.append((found.order[-1][0] if found.order else registry.COMMON_OFFSET, after.fitted.rmse))
    return tuple(bars)
