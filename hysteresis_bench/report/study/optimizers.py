"""All optimizers side by side: at the study's budget, at others, and after the paper's number of iterations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.report.searches.figures import all_trials
from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.searches.section import drawable
from hysteresis_bench.report.shared.blocks import Cell, Figures, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import (
    NONE,
    listed,
    number,
    p_equals,
    percent,
    probability,
    seconds,
    share,
    whole,
)
from hysteresis_bench.report.study.definitions import SUCCESS
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.report.trials.summary import at_iterations, other_budgets, problems, summarise
from hysteresis_bench.study.results import Results


def at_equal_evaluations(
    here: Sequence[Problem], summary: pd.DataFrame, reference: str, *, looks: Mapping[str, Look], folder: Path
) -> Section:
    """Every trial in a figure, every optimizer in a table."""
    how = (
        f"{SUCCESS} Tests compare fitness, each optimizer with the reference, {reference}, and with the best by median"
    )
    trials = [all_trials(folder, f"trials-{i}", problem, looks=looks) for i, problem in drawable(here)]
    tables = [_table(problem, summary) for problem in here]
    return Section("optimizers", "All optimizers at equal evaluations", [f"{how} only.", Figures(trials), *tables])


def at_other_budgets(results: Results) -> Section | None:
    """None where all optimizers have the study's budget."""
    tables = [
        _table(problem, summarise(results, budget))
        for budget in other_budgets(results)
        for problem in problems(results, budget)
    ]
    how = "Optimizers that the study gives more or fewer evaluations, compared among themselves only."
    return Section("budgets", "At other budgets", [how, *tables]) if tables else None


def at_the_papers_iterations(results: Results, here: Sequence[Problem], count: int | None) -> Section | None:
    """count : of iterations after the first swarm; None where the paper does not say."""
    if not count or not here or not results.traces:
        return None
    how = (
        "An iteration costs different algorithms different numbers of evaluations, and some have none. Read from the "
        "same trials, whose schedules were set for the whole budget."
    )
    frame = at_iterations(results, count)
    tables = [_at(frame, problem, count) for problem in here]
    return Section("iterations", "At the paper’s number of iterations", [how, *tables])


def _table(problem: Problem, summary: pd.DataFrame) -> Table:
    """Every optimizer at equal evaluations, best median first."""
    rows: list[list[str | Cell]] = []
    for _, row in summary[summary["problem"] == problem.name].iterrows():
        strong = row["optimizer"] in (problem.winner, problem.reference)
        low, high = row["success_low"], row["success_high"]
        rows.append(
            [
                Cell(row["optimizer"], strong=strong),
                number(row["fitness_best"]),
                number(row["fitness_median"]),
                f"{number(row['fitness_q1'], 3)} to {number(row['fitness_q3'], 3)}",
                percent(row["relative_rms_median"]),
                f"{row['successes']} of {row['trials']} ({100 * low:.0f} to {100 * high:.0f}\u202f%)",
                whole(row["evaluations_to_success_median"]),
                whole(row["expected_running_time"]),
                whole(row["evaluations_median"]),
                seconds(row["seconds_median"]),
                str(row["failed"]) if row["failed"] else NONE,
                number(row["mean_rank"], 3),
                *_compared(row, "reference"),
                *_compared(row, "best"),
            ]
        )
    header = ["Optimizer", "Best", "Median", "Quartiles", "Relative RMS", "Success (95 %)", "Evaluations to success"]
    header += ["ERT", "Evaluations", "Time", "Failed", "Mean rank", "Against reference", "p", "A12"]
    header += ["Against best", "p", "A12"]
    return Table(f"{problem.name}: fitness at equal evaluations", header, rows, note=_friedman(problem))


def _compared(row: pd.Series, name: str) -> list[str | Cell]:
    verdict = row[f"verdict_{name}"]
    tone = "good" if verdict.startswith("better") else "bad" if verdict.startswith("worse") else "quiet"
    return [Cell(verdict, f"{tone} line"), probability(row[f"p_{name}"]), share(row[f"a12_{name}"])]


def _friedman(problem: Problem) -> str:
    found = problem.friedman
    if found.p is None:
        enough = len(problem.trials) >= stats.ENOUGH
        return "" if enough else f"Friedman test: {stats.TOO_FEW}; {len(problem.trials)} common trials."
    verdict = "at least one optimizer differs" if found.p < stats.LEVEL else "we cannot tell the optimizers apart"
    count, statistic = len(problem.trials), number(found.statistic)
    return f"Friedman test over {count} trials: χ² = {statistic}, {p_equals(found.p)}; {verdict}."


def _at(frame: pd.DataFrame, problem: Problem, count: int) -> Table:
    """Every optimizer that has iterations, after the paper's number of them."""
    here = frame[frame["problem"] == problem.name]
    without = here["evaluations_per_iteration"].isna()
    rows: list[list[str | Cell]] = []
    for _, row in here[~without].iterrows():
        spread = f"{number(row['fitness_q1'], 3)} to {number(row['fitness_q3'], 3)}"
        rows.append(
            [
                row["optimizer"],
                whole(row["evaluations_per_iteration"]),
                whole(row["evaluations"]),
                number(row["fitness_best"]),
                number(row["fitness_median"]),
                Cell(row["note"], "quiet") if row["note"] else spread,
            ]
        )
    header = ["Optimizer", "Evaluations an iteration", "Evaluations", "Best", "Median", "Quartiles"]
    others = listed(list(here[without]["optimizer"]), len(here))
    note = f"Without iterations in this sense: {others}." if without.any() else ""
    return Table(f"{problem.name}: fitness after the first swarm and {count} iterations", header, rows, note)
