"""The summary of a study as a table on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hysteresis_bench import statistics
from hysteresis_bench.report.shared.text import NONE, number, percent, probability, seconds, whole
from hysteresis_bench.report.study import run
from hysteresis_bench.report.study.optimizers import at_odds
from hysteresis_bench.report.trials.summary import problems, summary_of
from hysteresis_bench.study.results import Results

if TYPE_CHECKING:
    from rich.console import Console


def print_summary(results: Results, console: Console) -> None:
    """One table a problem, best median first, and a line that says what the trials can tell."""
    from rich.table import Table

    here = problems(results)
    summary = summary_of(here, results.study.budget)
    for problem in here:
        table = Table(title=problem.name, title_justify="left", title_style="bold", box=None, pad_edge=False)
        table.add_column("optimizer", no_wrap=True)
        for heading in ("median fitness", "relative RMS", "success", "evals to success", "time", "failed"):
            table.add_column(heading, justify="right")
        if not (enough := problem.blocks >= statistics.ENOUGH):
            table.caption = f"against each other: {statistics.TOO_FEW} ({statistics.ENOUGH} are needed)"
        table.add_column("against best" if enough else "", no_wrap=True)
        rows = summary[summary["problem"] == problem.name]
        if odd := at_odds(rows).strip():
            table.caption = odd
        for _, row in rows.iterrows():
            p = probability(row["p_best"])
            verdict = row["verdict_best"]
            table.add_row(
                row["optimizer"],
                number(row["fitness_median"]),
                percent(row["relative_rms_median"]),
                f"{row['successes']} of {row['counted']}",
                whole(row["evaluations_to_success_median"]),
                seconds(row["seconds_median"]),
                str(row["failed"]) if row["failed"] else NONE,
                _short(verdict, p) if enough else "",
                style="bold" if row["optimizer"] == problem.winner else None,
            )
        console.print(table)
        console.print()
    console.print(run.in_words(results.trials, here))


def _short(verdict: str, p: str) -> str:
    """A verdict that fits its column; the report says how large the effect is."""
    if verdict in (statistics.SAME, statistics.AT_ODDS):
        return "cannot tell apart"
    return verdict if p == NONE else f"{verdict.partition(' (')[0]}, p {p}"
