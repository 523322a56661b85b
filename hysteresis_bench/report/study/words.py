"""The answer in plain words, computed from the numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.report.paper import claims
from hysteresis_bench.report.shared.text import listed, number, percent
from hysteresis_bench.report.trials.best_known import EQUAL
from hysteresis_bench.report.trials.problem import Problem


def answer(problems: Sequence[Problem], summary: pd.DataFrame, judged: Sequence[claims.Judged]) -> list[str]:
    """One sentence on the paper's claims, one on who found the best fits."""
    told = [claims.in_words(judged), _best(problems, summary)]
    return [sentence for sentence in told if sentence]


def _best(problems: Sequence[Problem], summary: pd.DataFrame) -> str:
    """Of every problem the winner and whom nobody can tell it apart from."""
    parts = []
    for problem in (problem for problem in problems if not problem.failed):
        best = _row(problem, summary)
        same = problem.tied_with_winner
        beside = f", beside {len(same)} that nobody can tell apart from it" if same else ""
        rms = percent(best["relative_rms_median"])
        parts.append(f"{problem.winner} on “{problem.name}” (relative RMS {rms}{beside})")
    return f"The best fits by median come from {listed(parts, len(parts))}." if parts else "Every trial failed."


def winners(problems: Sequence[Problem], summary: pd.DataFrame) -> list[str]:
    """A sentence or two a problem."""
    return [_winner(problem, summary) for problem in problems]


def _row(problem: Problem, summary: pd.DataFrame) -> pd.Series:
    return summary[(summary["problem"] == problem.name) & (summary["optimizer"] == problem.winner)].iloc[0]


def _winner(problem: Problem, summary: pd.DataFrame) -> str:
    if problem.failed:
        return f"On “{problem.name}” every trial failed."
    best = _row(problem, summary)
    sentence = (
        f"On “{problem.name}”, {problem.winner} has the lowest median fitness, {number(best['fitness_median'])} "
        f"(relative RMS {percent(best['relative_rms_median'])}{_ratio(problem)}). It came within 1 % of the best known "
        f"in {best['successes']} of {best['counted']} trials."
    )
    return f"{sentence} {_apart(problem)}"


def _ratio(problem: Problem) -> str:
    if problem.reference not in problem.labels or problem.reference == problem.winner:
        return ""
    theirs, ours = (
        statistics.quantile(problem.per_block(label, problem.ratios(label)), 0.5)
        for label in (problem.reference, problem.winner)
    )
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
    if problem.blocks < statistics.ENOUGH:
        return (
            f"With {problem.counted} this describes what happened and proves nothing: {statistics.TOO_FEW} the "
            f"optimizers apart ({statistics.ENOUGH} are needed)."
        )
    where = f"Over {problem.counted}" if problem.several else "In this instance"
    same = problem.tied_with_winner
    if not same:
        level = f"(Holm-corrected p < {statistics.LEVEL})"
        return f"{where}, the trials tell it apart from each of the other {others} {level}."
    rest = others - len(same)
    apart = f" The trials tell it apart from the other {rest}." if rest else ""
    return f"{where}, we cannot tell it apart from {listed(same, 8)}.{apart}"
