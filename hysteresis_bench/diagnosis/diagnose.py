"""Diagnosis: fit a model, see what is left, name what is missing, refit, and report before and after."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.memory import memory
from hysteresis_bench.diagnosis.evidence.noise import noise, pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import floor_of, without_hum
from hysteresis_bench.diagnosis.evidence.residual_tests import residual_tests
from hysteresis_bench.diagnosis.findings.advice import Advice, advise
from hysteresis_bench.diagnosis.findings.candidates import (
    candidate_rows,
    description_row,
    in_order,
    step_of,
    ties_of,
    waterfall_of,
)
from hysteresis_bench.diagnosis.findings.description import accepted
from hysteresis_bench.diagnosis.findings.result import Diagnosis, Stage, Verdict
from hysteresis_bench.diagnosis.findings.terms import Equation, find_terms
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis.findings.words import carries_over, headline, warnings
from hysteresis_bench.diagnosis.preparation import passes_to_close, thinned, with_held_out
from hysteresis_bench.diagnosis.search.hypotheses import Bench, Trial
from hysteresis_bench.diagnosis.search.selection import Selection, with_simplest_offset
from hysteresis_bench.diagnosis.search.systems import Stack
from hysteresis_bench.diagnosis.search.without_hysteresis import without_hysteresis
from hysteresis_bench.diagnosis.search.workers import Crew
from hysteresis_bench.diagnosis.threads import single_threaded
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.accuracy import accuracy, response_table, simulated
from hysteresis_bench.fit.identifiability import analyse
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.fit.model_file import FittedModel, Preparation, fitted_model
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.settling import gap_after, not_closed, open_loops
from hysteresis_bench.registry import COMMON_OFFSET, DESCRIPTION, OFFSETS, RECORD_OFFSET
from hysteresis_bench.signals import Dataset, Record

FOLLOWS = 0.5
"""Share of the output's variance that the response to the input must explain before any effect is named."""

REMAINS = 1.1
"""RMSE over noise from which what is left matters."""

TELLING = 0.03
"""Share of the residual's variance from which a dependence matters."""

FEWEST_SAMPLES = 20

QUIETER = 0.9
"""The noise without a hum that was found, over that with it, from which the search goes on with the new estimate."""


@single_threaded
def diagnose(
    dataset: Dataset,
    model: str,
    *,
    settings: Mapping[str, Any] | None = None,
    effects: Sequence[str] = (),
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    seed: int = 0,
    settle: bool = False,
    input_offset: float = 0.0,
    flip: bool = False,
    jobs: int | None = None,
    accept_terms: bool = False,
) -> Diagnosis:
    """Find what a registered model lacks on the fitted records; the held-out ones are opened once, at the end.

    effects : known to act, around the model from the beginning
    accept_terms : add what describes the remaining residual to the model, as the effect "description"
    jobs : processes; default: as many as cores, at most 4
    Raises UserError telling every fault at once.
    """
    _check(dataset, model, settings or {}, effects, settle)
    preparation = Preparation(input_offset, flip)
    seen = dataset.map(preparation)
    built = registry.build("models", model, settings)
    passes = passes_to_close(built, seen, effects, bounds, fixed, seed) if settle else 0
    seen = seen.map(lambda record: record.settled(passes)) if passes else seen
    ready, how = with_held_out(seen)
    remembers = memory(ready.fitted)
    off = {} if remembers.needed or remembers.ambiguous else without_hysteresis(built, ready.fitted)
    known = {**off, **(fixed or {})}
    full, bench = (
        Bench(Stack(built, records, tuple(effects), bounds, known), seed)
        for records in (ready.fitted, thinned(ready.fitted))
    )
    loud = pooled_noise(ready.fitted)
    floor = floor_of(ready.fitted, loud)
    possible, impossible = bench.stack.candidates()
    with Crew(bench, jobs or min(4, os.cpu_count() or 1)) as crew:
        selection = Selection(bench, crew, floor, possible)
        base = bench.bare(frozenset({RECORD_OFFSET}))
        found = selection.run(base)
        quieter = pooled_noise(without_hum(full, found))
        if quieter.floor < QUIETER * loud.floor:  # a fast hum had passed for noise
            loud, floor = quieter, floor_of(ready.fitted, quieter)
            selection.floor = floor
            found = selection.run(found)
        alone = not _follows(full, found)
        found = base if alone else found
        final = with_simplest_offset(selection, found)
        ties, rivals = ties_of(selection, found)
        steps = tuple(step_of(selection, number) for number in range(len(selection.rounds)))
        candidates = candidate_rows(selection, found, impossible, ties)
        order = in_order(selection, base, found)
    offset = next((name for name in OFFSETS if name in final.names), "")
    adopted = (*(name for name, _ in order), *([COMMON_OFFSET] if offset == COMMON_OFFSET else []))
    # where more than an offset is missing, before has the offset too: the gain is the effects' own
    nuisance = frozenset(OFFSETS if order else [RECORD_OFFSET]) & final.names
    whole, thin = (replace(one, stack=replace(one.stack, fixed=fixed)) for one in (full, bench))
    bare = thin.bare(nuisance)
    if final.names == nuisance and final.rmse < bare.rmse:
        before = after = _stage(full, final, ready)
    else:
        before = _stage(whole, bare, ready)
        after = before if final.names == nuisance else _stage(full, final, ready)
    waterfall = waterfall_of(full, model, before, order, final, after)
    equation, remains = _left(ready.fitted, after, floor)
    if accept_terms and equation and equation.terms:
        candidates = (description_row(equation, after), *candidates)
        after = _stage(*_described(full, final, equation), ready)
        adopted, waterfall = (*adopted, DESCRIPTION), (*waterfall, (DESCRIPTION, after.fitted.rmse))
        equation, remains = _left(ready.fitted, after, floor)
    verdict: Verdict = "effect-found" if adopted else "no-effect-needed"
    if remains or alone or not carries_over(before, after):
        verdict = "unexplained-residual"
    told = warnings(built, ready.fitted, final, after, alone, floor, loud.floor, ties)
    if passes:
        told = (*told, *not_closed(gap_after(after.problem.system, ready.fitted, after.values, passes), passes))
    if not carries_over(before, after):
        told = ("What was adopted does not carry over to the held-out records: do not believe the names.", *told)
    return Diagnosis(
        model,
        verdict,
        headline(verdict, adopted, alone, before, after, loud, floor, ties, dataset.units),
        adopted,
        offset,
        before,
        after,
        loud,
        floor,
        candidates,
        steps,
        (*waterfall, ("noise", loud.floor)),
        ties,
        _advice(bench, found, rivals, ready.fitted, floor, ties),
        remembers,
        equation,
        _model(after, ready, model, settings or {}, preparation),
        _responses(ready, before, after),
        {"fitted": [r.name for r in ready.fitted], "held_out": [r.name for r in ready.held_out], "how": how},
        told,
        dataset.units,
    )


def _check(dataset: Dataset, model: str, settings: Mapping[str, Any], effects: Sequence[str], settle: bool) -> None:
    faults = registry.faults("models", model, settings)
    for name in effects:
        faults += registry.effect_faults(name, model)
    if not faults:
        known = registry.build_effects(registry.build("models", model, settings), effects)
        reasons = {name: effect.inapplicable(dataset.records) for name, effect in known}
        faults += [f"effect {name}: {reason}" for name, reason in reasons.items() if reason]
    faults += open_loops(dataset.records) if settle else []
    for record in dataset.fitted:
        if np.ptp(record.measured) == 0:
            faults.append(f"record {record.name}: the output is constant; there is nothing to diagnose.")
        elif record.measured.size < 2 * FEWEST_SAMPLES:
            faults.append(
                f"record {record.name}: {record.measured.size} samples are too few; {2 * FEWEST_SAMPLES} are needed."
            )
    if faults:
        raise UserError("diagnose", faults)


def _follows(bench: Bench, trial: Trial) -> bool:
    """Does the response to the input, without what is merely added to it, explain the output?"""
    stack = bench.stack
    names = frozenset(n for n in trial.names if n == RECORD_OFFSET or stack.effect(n).acts != "added")
    answering, own = bench.fitted(replace(trial, names=names))
    whole, every = bench.fitted(trial)
    left = explained = 0.0
    for record in bench.stack.records:
        response = answering.respond(record, own[:, None])[record.scored, 0]
        error = record.measured - whole.respond(record, every[:, None])[record.scored, 0]
        left += float(error @ error)
        explained += float(np.sum((response - response.mean()) ** 2))
    return explained > FOLLOWS / (1.0 - FOLLOWS) * left


def _stage(bench: Bench, trial: Trial, ready: Dataset) -> Stage:
    """A system fitted to all samples, and its errors on what was fitted and what was not."""
    problem = bench.stack.problem(trial.names)
    values = bench.polished(trial)
    residuals = split(bench.errors(trial.names, values), ready.fitted)
    system = problem.system
    return Stage(
        tuple(name for name, _ in system.effects),
        problem,
        values,
        accuracy(system, ready.fitted, values),
        accuracy(system, ready.held_out, values) if ready.held_out else None,
        tuple(residual_tests(ready.fitted, residuals, [noise(record) for record in ready.fitted])),
    )


def _described(full: Bench, final: Trial, equation: Equation) -> tuple[Bench, Trial]:
    """The final system with an equation's terms added to its output."""
    stack = replace(full.stack, ready={DESCRIPTION: accepted(equation)})
    return replace(full, stack=stack), replace(final, names=final.names | {DESCRIPTION})


def _left(records: Sequence[Record], stage: Stage, floor: float) -> tuple[Equation | None, bool]:
    """What describes the remaining residual, and whether it matters."""
    scope = "all" if len(records) > 1 else records[0].name
    tests = [test for test in stage.tests if test.record == scope and test.significant]
    loud = stage.fitted.rmse > REMAINS * floor and any(test.name == "noise-floor" for test in tests)
    telling = [
        t for t in tests if t.share > TELLING and t.name not in ("noise-floor", "offset") and "scatter" not in t.name
    ]
    if stage.fitted.rmse <= floor or not (loud or telling):
        return None, False
    column = stage.values[:, None]
    simulated = [stage.problem.system.respond(record, column)[:, 0] for record in records]
    residuals = [record.measured - part[record.scored] for record, part in zip(records, simulated, strict=True)]
    return find_terms(records, residuals, simulated), True


def _advice(
    bench: Bench, found: Trial, rivals: Sequence[Trial], records: Sequence[Record], floor: float, ties: Sequence[Tie]
) -> Advice | None:
    if not ties:
        return None

    first = ties[0].effect
    together = [(one, trial) for one, trial in zip(ties, rivals, strict=True) if one.effect == first]
    names = [first, *(one.rival for one, _ in together)]
    return advise(bench.fitted(found), [bench.fitted(trial) for _, trial in together], records, floor, names)


def _model(
    stage: Stage,
    ready: Dataset,
    model: str,
    settings: Mapping[str, Any],
    preparation: Preparation,
) -> FittedModel:
    return fitted_model(
        stage.problem,
        stage.values,
        _standard_errors(stage.problem, stage.values),
        dataset=ready,
        model=model,
        settings=settings,
        preparation=preparation,
    )


def _standard_errors(problem: Problem, values: Array) -> Array:
    try:
        return analyse(problem, values).standard_errors
    except (ValueError, np.linalg.LinAlgError):
        return np.full(values.size, np.inf)


def _responses(ready: Dataset, before: Stage, after: Stage) -> pd.DataFrame:
    stages = {"before": before, "after": after}
    responses = {name: simulated(stage.problem.system, ready.records, stage.values) for name, stage in stages.items()}
    return response_table(ready, responses)
