"""The answer in plain words, computed from the numbers."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.report.paper.claims import FAILS, HOLDS, Judged
from hysteresis_bench.report.shared.page import listed, number, percent, probability, share
from hysteresis_bench.report.study.summary import EQUAL, Problem


def answer(problems: list[Problem], summary: pd.DataFrame, judged: list[Judged]) -> list[str]:
    """A sentence or two a problem, then one a claim about fitness."""
    told = [_winner(problem, summary[summary["problem"] == problem.name]) for problem in problems]
    return told + [claim_in_words(judged, says) for says in dict.fromkeys(found.claim.says for found in judged)]


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


def claim_in_words(judged: list[Judged], says: str) -> str:
    """The paper's claim: where it holds, where not, where nobody can tell."""
    parts = []
    for found in (found for found in judged if found.claim.says == says):
        numbers = ""
        if found.verdict in (HOLDS, FAILS):
            p = probability(found.p)
            effect = stats.magnitude(found.a12 or 0.0)
            numbers = f" (p {p if p.startswith('<') else f'= {p}'}, A12 = {share(found.a12)}, {effect} effect)"
        elif found.why:
            numbers = f" ({found.why})"
        told = found.why if found.why == stats.SAME else f"{_here(found.verdict)}{numbers}"
        parts.append(f"on “{found.problem}” {told}")
    return f"The paper says: {says}. Here, {listed(parts)}."


def _here(verdict: str) -> str:
    return {HOLDS: "this holds", FAILS: "this does not hold; the contrary does"}.get(verdict, "we cannot tell")


def run_in_words(trials: pd.DataFrame, problems: list[Problem]) -> str:
    """How many trials of what, and how many failed."""
    failed = int(trials["fitness"].isna().sum())
    labels = {label for problem in problems for label in problem.labels}
    least = min((len(problem.trials) for problem in problems), default=0)
    fate = "none failed" if failed == 0 else f"{failed} failed and rank as infinitely bad"
    return (
        f"{len(trials)} trials: {len(labels)} optimizers on {len(problems)} problem{'s' * (len(problems) != 1)}, "
        f"{least} trials that all of them have; {fate}."
    )
