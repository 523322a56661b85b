"""All optimizers side by side: at the study's budget, at others, and after the paper's number of iterations."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Figures, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import (
    NONE,
    listed,
    number,
    p_equals,
    percent,
    seconds,
    share,
    whole,
)
from hysteresis_bench.report.shared.theme import Picture
from hysteresis_bench.report.study.definitions import SUCCESS
from hysteresis_bench.report.study.words import winners
from hysteresis_bench.report.trials.compared import Compared
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.report.trials.seeds import anchor
from hysteresis_bench.report.trials.summary import at_iterations
from hysteresis_bench.study.results import Results


def at_equal_evaluations(
    here: Sequence[Problem], summary: pd.DataFrame, reference: str, pictures: Sequence[Picture]
) -> Section:
    """Who won, and every optimizer in a table. pictures : of all trials, of problems that have none elsewhere"""
    known = any(reference in problem.labels for problem in here)
    others = f"with the reference, {reference}, and with the best" if known else "with the best"
    beforehand = "The reference was named beforehand, p is corrected over the others; " if known else ""
    how = (
        f"{SUCCESS} Verdicts compare fitness, each optimizer {others} by median only. {beforehand}"
        f"{'the' if known else 'The'} best is chosen by these same trials, p is corrected over all pairs. Every other "
        "number of a row is in summary.csv."
    )
    tables = [table(problem, summary) for problem in here]
    blocks: list[Block] = [Bullets(winners(here, summary)), *([Figures(pictures)] if pictures else []), how, *tables]
    return Section("optimizers", "All optimizers at equal evaluations", blocks)


def at_other_budgets(others: Sequence[tuple[Sequence[Problem], pd.DataFrame]]) -> Section | None:
    """others : the problems at each other budget, with their summary;  None where there is none."""
    tables = [table(problem, summary) for here, summary in others for problem in here]
    how = "Optimizers that the study gives more or fewer evaluations, compared among themselves only."
    return Section("budgets", "At other budgets", [how, *tables]) if tables else None


def at_the_papers_iterations(results: Results, compared: Compared, count: int | None) -> Section | None:
    """count : of iterations after the first swarm; None where the paper does not say."""
    if not count or not compared.here or not results.traces:
        return None
    how = (
        "An iteration costs different algorithms different numbers of evaluations, and some have none. Read from the "
        "same trials, whose schedules were set for the whole budget."
    )
    frame = at_iterations(results, compared.everybody, count)
    tables = [_at(frame, problem, count) for problem in compared.here]
    return Section("iterations", "At the paper’s number of iterations", [how, *tables])


def table(problem: Problem, summary: pd.DataFrame) -> Table:
    """Every optimizer at equal evaluations, best median first; verdicts where there are enough blocks."""
    enough = problem.blocks >= statistics.ENOUGH
    here = summary[summary["problem"] == problem.name]
    columns: dict[str, list[str | Cell]] = {
        "Optimizer": [
            Cell(label, strong=label in (problem.winner, problem.reference), link=f"#{anchor(problem, label)}")
            for label in map(str, here["optimizer"])
        ],
        "Fitness, median": [number(value) for value in here["fitness_median"]],
        "Relative RMS": [_relative_rms(row) for _, row in here.iterrows()],
        "Success (95 %)": [_success(row) for _, row in here.iterrows()],
    }
    if problem.traces:
        columns["ERT"] = [whole(value) for value in here["expected_running_time"]]
    columns["Time"] = [seconds(value) for value in here["seconds_median"]]
    if here["failed"].any():
        columns["Failed"] = [str(value) if value else NONE for value in here["failed"]]
    if enough and problem.reference in problem.labels:
        columns["Against reference"] = [_verdict(row["verdict_reference"]) for _, row in here.iterrows()]
        columns["A12 (95 %)"] = [_a12(row) for _, row in here.iterrows()]
    if enough:
        columns["Against best"] = [_verdict(row["verdict_best"]) for _, row in here.iterrows()]
    same = list(here["optimizer"][here["deterministic"]])
    note = f"Deterministic, counted once an instance: {listed(same, len(same))}. " if same else ""
    rows = list(zip(*columns.values(), strict=True))
    title = f"{problem.name}: fitness over {problem.counted}"
    return Table(title, list(columns), rows, note=f"{note}{at_odds(here)}{_friedman(problem)}")


def at_odds(here: pd.DataFrame) -> str:
    """A sentence on verdicts that nobody can give as the test and A12 disagree, with a space behind it; empty without
    one. here : the rows of one problem"""
    found = {
        other: list(here["optimizer"][here[f"verdict_{other}"] == statistics.AT_ODDS])
        for other in ("reference", "best")
    }
    against = [f"of {listed(names, len(names))} against the {other}" for other, names in found.items() if names]
    why = "the signed-rank test favours one and A12 does not, as where many small wins stand against a few large losses"
    return f"We cannot tell which is better {listed(against)}: {why}. " if against else ""


def _relative_rms(row: pd.Series) -> str:
    """Median and quartiles; the median alone where these are no other."""
    quartiles = [percent(row[f"relative_rms_{name}"]) for name in ("q1", "q3")]
    middle = percent(row["relative_rms_median"])
    return (
        middle if set(quartiles) == {middle} else f"{middle} ({quartiles[0].split()[0]} to {quartiles[1].split()[0]})"
    )


def _success(row: pd.Series) -> str:
    low, high = 100.0 * row["success_low"], 100.0 * row["success_high"]
    return f"{row['successes']} of {row['counted']} ({low:.0f} to {high:.0f}\u202f%)"


def _verdict(words: str) -> Cell:
    tone = "good" if words.startswith("better") else "bad" if words.startswith("worse") else "quiet"
    nothing = words in (statistics.SAME, statistics.AT_ODDS)
    return Cell("cannot tell" if nothing else words.removesuffix(" effect)").replace(" (", ", "), tone)


def _a12(row: pd.Series) -> str:
    """Against the reference."""
    ends = f"({share(row['a12_low_reference'])} to {share(row['a12_high_reference'])})"
    return NONE if pd.isna(row["a12_reference"]) else f"{share(row['a12_reference'])} {ends}"


def _friedman(problem: Problem) -> str:
    found = problem.friedman
    if found.p is None:
        return ""
    verdict = "at least one optimizer differs" if found.p < statistics.LEVEL else "we cannot tell the optimizers apart"
    return f"Friedman test over {problem.counted}: χ² = {number(found.statistic)}, {p_equals(found.p)}; {verdict}."


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
