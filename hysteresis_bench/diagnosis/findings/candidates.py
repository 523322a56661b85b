"""What the search found, as the result tells it: ties, rounds, rows of candidates, the waterfall of errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.diagnosis.findings.result import Candidate, Stage, Step
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.findings.ties import Tie, tie
from hysteresis_bench.diagnosis.search.hypotheses import Bench, Trial
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.registry import COMMON_OFFSET, DESCRIPTION, OFFSETS


def ties_of(selection: Selection, found: Trial) -> tuple[tuple[Tie, ...], list[Trial]]:
    """Every adopted effect against what would do as well in its place."""
    ties, rivals = [], []
    for name in selection.adopted(found):
        for rival, trial in selection.alternatives(found, name).items():
            if selection.tied(found, trial):
                ties.append(tie(name, rival, found.apart(trial)))
                rivals.append(trial)
    return tuple(ties), rivals


def step_of(selection: Selection, number: int) -> Step:
    at = selection.rounds[number]
    return Step(
        tuple(sorted(at.current.names)),
        at.current.rmse,
        {name: trial.cv_rmse for name, trial in at.trials.items()},
        {name: test.p for name, test in at.tests.items()},
        at.chosen,
    )


def candidate_rows(
    selection: Selection, found: Trial, impossible: Mapping[str, str], ties: Sequence[Tie]
) -> tuple[Candidate, ...]:
    rows = []
    last = selection.rounds[-1]
    for name in selection.candidates:
        adopted = name in found.names
        smaller, larger = (selection.without(found, name), found) if adopted else (last.current, last.trials.get(name))
        if larger is None:
            continue
        test, gain = selection.compared(smaller, larger)
        rows.append(
            Candidate(
                name,
                True,
                adopted=adopted,
                rmse=larger.rmse,
                cv_rmse=larger.cv_rmse,
                p=test.p,
                advantage=gain,
                share=float(np.clip(selection.share(smaller, larger), 0.0, 1.0)),
                parameters={
                    key.removeprefix(f"{name}."): value
                    for key, value in larger.values.items()
                    if key.startswith(f"{name}.")
                },
                at_bound=tuple(key for key in larger.at_bound if key.startswith(f"{name}.")),
                tied_with=tuple(
                    one.rival if one.effect == name else one.effect for one in ties if name in (one.effect, one.rival)
                ),
            )
        )
    rows.sort(key=lambda row: (not row.adopted, row.cv_rmse))
    return (*rows, *(Candidate(name, False, reason) for name, reason in impossible.items()))


def description_row(equation: Equation, before: Stage) -> Candidate:
    """What an accepted description did; p of its least significant term."""
    left_out = before.fitted.rmse * float(np.sqrt(max(1.0 - equation.share, 0.0)))
    coefficients = {part.term.symbol: part.coefficient for part in equation.terms}
    worst = max(part.p for part in equation.terms)
    return Candidate(
        DESCRIPTION,
        True,
        adopted=True,
        rmse=left_out,
        cv_rmse=left_out,
        p=worst,
        share=equation.share,
        parameters=coefficients,
    )


def in_order(selection: Selection, base: Trial, found: Trial) -> list[tuple[str, Trial]]:
    """The adopted effects, the one that helps most first, each with the system that it completes."""
    current, steps = base, []
    while left := found.names - current.names:
        names = sorted(left)
        current, best = min(zip(selection.with_each(current, names), names, strict=True), key=lambda pair: pair[0].rmse)
        steps.append((best, current))
    return steps


def waterfall_of(
    full: Bench, model: str, before: Stage, steps: Sequence[tuple[str, Trial]], final: Trial, after: Stage
) -> tuple[tuple[str, float], ...]:
    """Label and RMSE on all fitted samples, from the bare model to the final system, all with the same offset."""
    offsets = frozenset(before.names) & {*OFFSETS}
    label = f"{model} with a bias" if COMMON_OFFSET in offsets else f"{model} alone"
    bars = [(label, before.fitted.rmse)]
    for name, trial in steps[:-1]:
        same = replace(trial, names=(trial.names - {*OFFSETS}) | offsets, values={**final.values, **trial.values})
        left = full.errors(same.names, full.polished(same))
        bars.append((name, float(np.sqrt(np.mean(left**2)))))
    if steps or after is not before:
        bars.append((steps[-1][0] if steps else COMMON_OFFSET, after.fitted.rmse))
    return tuple(bars)
