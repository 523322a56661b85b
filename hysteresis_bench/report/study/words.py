"""The answer in plain words, computed from the numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.report.paper import claims
from hysteresis_bench.report.shared.text import listed, number, percent
from hysteresis_bench.report.trials.problem import EQUAL, Problem


def answer(problems: Sequence[Problem], summary: pd.DataFrame, judged: Sequence[claims.Judged]) -> list[str]:
    """A sentence or two a problem, then one a claim."""
    winners = [_winner(problem, summary[summary["problem"] == problem.name]) for problem in problems]
    return winners + claims.in_words(judged)


def _winner(problem: Problem, rows: pd.DataFrame) -> str:
    if not math.isfinite(problem.best_known):
        return f"On “{problem.name}” every trial failed."
    best = rows.set_index("optimizer").loc[problem.winner]
    sentence = (
        f"On “{problem.name}”, {problem.winner} has the lowest median fitness, {number(best['fitness_median'])} "
        f"(relative RMS {percent(best['relative_rms_median'])}{_ratio(problem)}). It came within 1 % of the best known "
        f"in {best['successes']} of {best['trials']} trials."
    )
    return f"{sentence} {_apart(problem)}"


def _ratio(problem: Problem) -> str:
    if problem.reference not in problem.labels or problem.reference == problem.winner:
        return ""
    theirs = stats.quantile(problem.values(problem.reference, "fitness"), 0.5)
    ours = max(stats.quantile(problem.values(problem.winner, "fitness"), 0.5), problem.best_known)
    if not np.isfinite(theirs) or ours <= 0:
        return ""
    ratio = theirs / ours
    by = f"{number(ratio, 3)} times lower" if ratio >= 1.5 else f"{percent(1 - ours / theirs, 2)} lower"
    if max(ratio, 1 / ratio) < EQUAL:
        return f"; the same as the reference {problem.reference}"
    return f"; {by} than the reference {problem.reference}" if ratio > 1.0 else ""


def _apart(problem: Problem) -> str:
    others = len(problem.labels) - 1
    if others == 0:
        return "Nobody else was run."
    if len(problem.trials) < stats.ENOUGH:
        return (
            f"With {len(problem.trials)} trial{'s' * (len(problem.trials) != 1)} this describes what happened and "
            f"proves nothing: {stats.TOO_FEW} the optimizers apart ({stats.ENOUGH} are needed)."
        )
    same = problem.tied_with_winner
    if not same:
        return f"The trials tell it apart from each of the other {others} (Holm-corrected p < {stats.LEVEL})."
    rest = others - len(same)
    apart = f" The trials tell it apart from the other {rest}." if rest else ""
    return f"We cannot tell it apart from {listed(same, 8)}.{apart}"
