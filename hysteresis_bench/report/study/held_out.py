"""Fitted and held-out error, by optimizer and record by record."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from hysteresis_bench.report.paper.by_record import by_record
from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, number, percent
from hysteresis_bench.report.study.signals import shown
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import Results


def section(
    results: Results, here: Sequence[Problem], summary: pd.DataFrame, *, published: Published
) -> Section | None:
    """None without trials."""
    how = (
        "Held-out records were not seen by any search. The best trial is the one with the lowest fitness on the fitted "
        "records."
    )
    tables = [_table(problem, summary) for problem in here]
    tables += _by_record(results, here, published)
    return Section("held-out", "Fitted and held-out error", [how, *tables]) if here else None


def _by_record(results: Results, here: Sequence[Problem], published: Published) -> list[Table]:
    if results.responses.empty:
        return []
    found = []
    for problem in here:
        rows = results.responses[results.responses["problem"] == problem.name]
        labels = shown(problem, published.optimizers, rows["optimizer"])
        found.append(by_record(problem.name, rows, labels, published=published))
    return [table for table in found if table]


def _table(problem: Problem, summary: pd.DataFrame) -> Table:
    """Fitted and held-out error of every optimizer: of its best trial, and the medians."""
    rows: list[list[str | Cell]] = []
    for label in problem.ranked:
        trials = problem.rows[label]
        median = summary[(summary["problem"] == problem.name) & (summary["optimizer"] == label)].iloc[0]
        best = problem.best_trial(label)
        numbers = [NONE] * 3 if best is None else [number(best["rmse"]), number(best["held_out_rmse"]),
                                                   percent(best["max_error"])]  # fmt: skip
        fitted = problem.middle(label, "rmse")
        held = NONE if trials["held_out_rmse"].isna().all() else number(median["held_out_rmse_median"])
        rows.append([label, *numbers, number(fitted), held, percent(median["max_error_median"])])
    header = ["Optimizer", "Fitted RMSE, best trial", "Held-out RMSE, best trial", "Largest error, best trial"]
    header += ["Fitted RMSE, median", "Held-out RMSE, median", "Largest error, median"]
    return Table(f"{problem.name}: error on fitted and on held-out records", header, rows)
