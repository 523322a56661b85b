"""Other targets and budgets than the study's: does the answer hang on where success begins, or when one stops?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import number, percent, whole
from hysteresis_bench.report.trials.anytime import note, signed
from hysteresis_bench.report.trials.problem import Problem

EXCESSES = (0.001, 0.01, 0.03, 0.1)
"""Shares above the best known at which success may begin."""
POINTS = 200
"""Of a convergence curve, for the area over it."""
BUDGET_SHARES = (0.1, 0.3, 1.0)
"""Of the budget, at which one may stop."""


def section(problems: Sequence[Problem], budget: int) -> Section | None:
    """None where every trial failed."""
    tables = [_table(problem, budget) for problem in problems if not problem.failed]
    how = (
        "Success may begin elsewhere than 1 % above the best known of an instance, and a search may be stopped "
        "earlier. Trials that come so near; evaluations spent for each that does (ERT); median fitness over the best "
        "known after a share of the budget. The area over the convergence curve asks all of them at once: 1 is at the "
        "best known from the first evaluation, 0 never within ten times of it, evaluations and excess on logarithmic "
        "scales."
    )
    return Section("targets", "At other targets, and stopped earlier", [how, *tables]) if tables else None


def _table(problem: Problem, budget: int) -> Table:
    rows: list[list[str | Cell]] = []
    for label in problem.ranked:
        ratios = problem.ratios(label)
        name = signed(label, problem.anytime) if problem.traces else label
        row: list[str | Cell] = [name, *(percent(np.mean(ratios <= 1.0 + excess), 3) for excess in EXCESSES)]
        if problem.traces:
            row += [whole(_running_time(problem, label, excess)) for excess in EXCESSES[1:]]
            row += [number(_after(problem, label, round(share * budget)), 4, "none yet") for share in BUDGET_SHARES]
            row.append(f"{area_over_curve(problem, label, budget):.3f}")
        rows.append(row)
    header = ["Optimizer", *(f"Within {percent(excess)}" for excess in EXCESSES)]
    if problem.traces:
        header += [f"ERT to {percent(excess)}" for excess in EXCESSES[1:]]
        header += [*(f"At {percent(share)} of the budget" for share in BUDGET_SHARES), "Area over curve"]
    told = note(problem.ranked, problem.anytime) if problem.traces else ""
    return Table(f"{problem.name}: other targets and budgets", header, rows, told)


def _running_time(problem: Problem, label: str, excess: float) -> float:
    targets = (1.0 + excess) * problem.known(label)
    hits = problem.reached(label, targets[:, None])[:, 0]
    spent = pd.to_numeric(problem.rows[label]["evaluations"]).to_numpy(dtype=float, na_value=0.0)
    return statistics.expected_running_time(hits, spent)


def area_over_curve(problem: Problem, label: str, budget: int) -> float:
    """Median over blocks of the area over the convergence curve, from 0 to 1, more is better.

    [1] López-Ibáñez, Vermetten, Dreo, Doerr, "Using the empirical attainment function for analyzing single-objective
    black-box optimization algorithms" (2024): an ECDF over all targets has this area.
    Ours: targets from ten times the best known down to it, both axes logarithmic.
    """
    counts = np.geomspace(1, max(budget, 2), POINTS)
    best = problem.best_after(label, counts)
    known = problem.known(label)[:, None]
    over = np.divide(best, known, out=np.full(best.shape, np.inf), where=(known > 0.0) & np.isfinite(known))
    areas = 1.0 - np.log10(np.clip(over, 1.0, 10.0)).mean(axis=1)
    return statistics.quantile(problem.per_block(label, areas), 0.5)


def _after(problem: Problem, label: str, evaluations: int) -> float:
    """Median fitness over the best known after so many evaluations."""
    count = np.array([evaluations])
    best: Array = problem.best_after(label, count)[:, 0]
    known = problem.known(label)
    over = np.divide(best, known, out=np.full(best.size, np.inf), where=(known > 0.0) & np.isfinite(known))
    return statistics.quantile(problem.per_block(label, np.maximum(over, 1.0)), 0.5)
