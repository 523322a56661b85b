"""The tables of a study's report, each from the summary, the trials or the published file."""

from __future__ import annotations

import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.report.paper.audit import Finding
from hysteresis_bench.report.paper.claims import FAILS, HOLDS, Judged
from hysteresis_bench.report.shared.page import (
    NONE,
    Cell,
    Table,
    listed,
    number,
    percent,
    probability,
    seconds,
    share,
    whole,
)
from hysteresis_bench.report.study.summary import Problem
from hysteresis_bench.study.results import Results


def optimizers(problem: Problem, summary: pd.DataFrame) -> Table:
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
    told = "at least one optimizer differs" if found.p < stats.LEVEL else "we cannot tell the optimizers apart"
    p = probability(found.p)
    return (
        f"Friedman test over {len(problem.trials)} trials: χ² = {number(found.statistic)}, "
        f"p {p if p.startswith('<') else '= ' + p}; {told}."
    )


def iterations(frame: pd.DataFrame, problem: Problem, count: int) -> Table:
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


def held_out(problem: Problem, summary: pd.DataFrame) -> Table:
    """Fitted and held-out error of every optimizer: of its best trial, and the medians."""
    rows: list[list[str | Cell]] = []
    for label in problem.ranked:
        trials = problem.rows[label]
        median = summary[(summary["problem"] == problem.name) & (summary["optimizer"] == label)].iloc[0]
        best = problem.best_trial(label)
        numbers = [NONE] * 3 if best is None else [number(best["rmse"]), number(best["held_out_rmse"]),
                                                   percent(best["max_error"])]  # fmt: skip
        fitted = stats.quantile(problem.values(label, "rmse"), 0.5)
        held = NONE if trials["held_out_rmse"].isna().all() else number(median["held_out_rmse_median"])
        rows.append([label, *numbers, number(fitted), held, percent(median["max_error_median"])])
    header = ["Optimizer", "Fitted RMSE, best trial", "Held-out RMSE, best trial", "Largest error, best trial"]
    header += ["Fitted RMSE, median", "Held-out RMSE, median", "Largest error, median"]
    return Table(f"{problem.name}: error on fitted and on held-out records", header, rows)


def claims(judged: list[Judged]) -> Table:
    rows: list[list[str | Cell]] = []
    for found in judged:
        tone = {HOLDS: "good", FAILS: "bad"}.get(found.verdict, "quiet")
        medians = [NONE, NONE] if found.medians is None else [_metric(found.claim.metric, m) for m in found.medians]
        rows.append(
            [
                found.claim.says,
                found.claim.where,
                found.problem,
                Cell(found.verdict, tone, strong=True),
                Cell(found.why, "quiet"),
                *medians,
                probability(found.p),
                share(found.a12),
            ]
        )
    header = ["The paper says", "Where", "Problem", "Here", "Why", "Median of the better", "Median of the other"]
    return Table("The paper's claims in our trials", [*header, "p", "A12"], rows)


def _metric(metric: str, value: float) -> str:
    if metric in ("relative_rms", "max_error"):
        return percent(value, 4)
    return whole(value) if metric == "evaluations_to_success" else number(value)


def metric_text(metric: str, value: float) -> str:
    """A number of one column of trials.csv as text: errors relative to the output in per cent."""
    return _metric(metric, value)


def failures(results: Results) -> Table | None:
    """Trials that failed or ended early, counted by reason; None without any."""
    other = results.trials[results.trials["status"] != "done"]
    if other.empty:
        return None
    keys = ["problem", "optimizer", "status", "reason"]
    counted = other.assign(reason=other["reason"].fillna("")).value_counts(keys, sort=False).reset_index()
    rows = [[str(value) for value in row] for row in counted.to_numpy()]
    return Table("Trials that failed or ended early", [*(key.capitalize() for key in keys), "Trials"], rows)


def audit(findings: list[Finding]) -> Table:
    rows: list[list[str | Cell]] = []
    for found in findings:
        entry = found.entry
        drawn = f" (box sampled on a {entry.scaling} scale)" if entry.sample else ""
        arithmetic = f"{entry.arithmetic}{drawn} = {_gives(found)}" if entry.arithmetic else NONE
        rows.append(
            [
                entry.where,
                entry.printed,
                Cell(entry.says, "prose"),
                Cell(entry.kind, strong=True),
                Cell(arithmetic, "code") if entry.arithmetic else NONE,
                _checked(found),
            ]
        )
    header = ["Where", "Printed", "What follows", "Kind", "Arithmetic", "Checked"]
    return Table("Statements about the paper, each checked by its arithmetic", header, rows)


def _gives(found: Finding) -> str:
    if found.fault:
        return found.fault
    if isinstance(found.value, bool):
        return "true" if found.value else "false"
    return number(found.value)


def _checked(found: Finding) -> Cell:
    if found.borne_out is None:
        return Cell("computed" if found.entry.arithmetic else "by reading", "quiet")
    return Cell("borne out", "good") if found.borne_out else Cell("not borne out", "bad")
