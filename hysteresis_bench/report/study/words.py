"""The answer in plain words, computed from the numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.report.paper import claims
from hysteresis_bench.report.shared.text import listed, number, percent, whole
from hysteresis_bench.report.trials.best_known import EQUAL, EXACT
from hysteresis_bench.report.trials.metrics import TO_SUCCESS
from hysteresis_bench.report.trials.problem import Problem


def answer(problems: Sequence[Problem], summary: pd.DataFrame, judged: Sequence[claims.Judged]) -> list[str]:
    """One sentence on the paper's claims, one on who found the best fits."""
    told = [claims.in_words(judged), _best(problems, summary)]
    return [sentence for sentence in told if sentence]


def _best(problems: Sequence[Problem], summary: pd.DataFrame) -> str:
    """Of every problem the winner and whom nobody can tell it apart from."""
    parts = [_from_whom(problem, summary) for problem in problems if not problem.failed]
    return f"The best fits by median come from {listed(parts, len(parts))}." if parts else "Every trial failed."


def _from_whom(problem: Problem, summary: pd.DataFrame) -> str:
    if exactly := exact(problem):
        others = len(exactly) - 1
        beside = f", as {'is' if others == 1 else 'are'} {others} other{'s' * (others > 1)}" if others else ""
        return f"{quoted(exactly[0])} on “{problem.name}” (exact{beside})"
    same = problem.tied_with_winner
    beside = f", beside {len(same)} that nobody can tell apart from it" if same else ""
    rms = percent(_row(problem, summary)["relative_rms_median"])
    return f"{quoted(problem.winner)} on “{problem.name}” (relative RMS {rms}{beside})"


def exact(problem: Problem) -> list[str]:
    """The optimizers whose median fit is exact, first those of the fewest evaluations; none on data with noise.

    Below EXACT nobody is better than another, and neither a lower fitness nor a ratio of two says anything.
    """
    found = [label for label in problem.ranked if problem.middle(label, "relative_rms") <= EXACT]
    return sorted(found, key=lambda label: problem.middle(label, TO_SUCCESS)) if problem.traces else found


def quoted(label: str) -> str:
    """An optimizer's label in a sentence; between quotation marks where it has a comma of its own."""
    return f"“{label}”" if "," in label else label


def winners(problems: Sequence[Problem], summary: pd.DataFrame) -> list[str]:
    """A sentence or two a problem."""
    return [_winner(problem, summary) for problem in problems]


def _row(problem: Problem, summary: pd.DataFrame) -> pd.Series:
    return summary[(summary["problem"] == problem.name) & (summary["optimizer"] == problem.winner)].iloc[0]


def _winner(problem: Problem, summary: pd.DataFrame) -> str:
    if problem.failed:
        return f"On “{problem.name}” every trial failed."
    if exactly := exact(problem):
        return f"{_who_fits_exactly(problem, exactly)} {_apart(problem)}"
    best, winner = _row(problem, summary), quoted(problem.winner)
    sentence = (
        f"On “{problem.name}”, {winner} has the lowest median fitness, {number(best['fitness_median'])} (relative "
        f"RMS {percent(best['relative_rms_median'])}{_ratio(problem)}). It came within 1 % of the best known in "
        f"{best['successes']} of {best['counted']} trials."
    )
    return f"{sentence} {_apart(problem)}"


def _who_fits_exactly(problem: Problem, exactly: Sequence[str]) -> str:
    first, several = exactly[0], len(exactly) > 1
    who = f"{len(exactly)} optimizers fit" if several else f"{quoted(first)} alone fits"
    said = f"On “{problem.name}”, {who} exactly (relative RMS of at most {number(EXACT)})"
    reached = problem.middle(first, TO_SUCCESS) if problem.traces else np.inf
    if not np.isfinite(reached):
        return f"{said}."
    return f"{said}{f'; the first, {quoted(first)},' if several else ','} after {whole(reached)} evaluations."


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
        return f"; the same as the reference {quoted(problem.reference)}"
    return f"; {by} than the reference {quoted(problem.reference)}" if ratio > 1.0 else ""


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
    same, exactly = problem.tied_with_winner, exact(problem)
    best = quoted(problem.winner) if len(exactly) > 1 else "it"
    if not same:
        level = f"(Holm-corrected p < {statistics.LEVEL})"
        return f"{where}, the trials tell {best} apart from each of the other {others} {level}."
    rest = others - len(same)
    apart = f" The trials tell it apart from the other {rest}." if rest else ""
    return f"{where}, we cannot tell {best} apart from {listed([quoted(label) for label in same], 8)}.{apart}"
