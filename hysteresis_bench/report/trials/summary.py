"""The numbers of the report: one row an optimizer and problem, and what the tests say of them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.report.trials.metrics import TO_SUCCESS
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import FINISHED, Results
from hysteresis_bench.study.study_file import Study


def problems(results: Results, budget: int | None = None, any_budget: bool = False) -> list[Problem]:
    """Every problem of the study that has trials of optimizers with this budget, the study's own without one.

    any_budget : whatever their budget, which is no match at equal evaluations
    """
    mine = budget or results.study.budget
    other = {spec.name for spec in results.study.optimizer if results.study.budget_of(spec) != mine}
    found = []
    for spec in results.study.problem:
        here = results.trials[results.trials["problem"] == spec.name]
        labels = [label for label in _labels(results, here) if any_budget or label not in other]
        rows = {label: here[here["optimizer"] == label] for label in labels}
        traces = {
            (optimizer, trial): (trace.evaluations, trace.losses)
            for (problem, optimizer, trial), trace in results.traces.items()
            if problem == spec.name
        }
        if rows:
            found.append(Problem(spec.name, list(rows), rows, traces, _reference(results.study, labels)))
    return found


def _reference(study: Study, labels: list[str]) -> str:
    """The study's reference, or where it has another budget the same algorithm with the same settings."""
    if study.reference in labels:
        return study.reference
    same = {spec.name: (spec.plugin, spec.settings) for spec in study.optimizer}
    twins = [label for label in labels if label in same and same[label] == same.get(study.reference)]
    return twins[0] if twins else study.reference


def other_budgets(results: Results) -> list[int]:
    """Budgets that optimizers have beside the study's, smallest first."""
    found = {results.study.budget_of(spec) for spec in results.study.optimizer}
    return sorted(found - {results.study.budget})


def _labels(results: Results, rows: pd.DataFrame) -> list[str]:
    """Those of the study file in its order, then those only the folder knows."""
    present = list(dict.fromkeys(rows["optimizer"]))
    return [label for label in results.study.labels if label in present] + [
        label for label in present if label not in results.study.labels
    ]


def summarise(results: Results, budget: int | None = None) -> pd.DataFrame:
    """One row a problem and optimizer, best median first; the columns of summary.csv.

    Failed trials count as infinitely bad in medians, quartiles, ranks and tests; p-values are empty below
    14 common trials. budget : of the optimizers that are compared, the study's own without one
    """
    here = problems(results, budget)
    return pd.DataFrame([_row(problem, label) for problem in here for label in problem.ranked])


def _row(problem: Problem, label: str) -> dict[str, object]:
    rows = problem.rows[label]
    failed = int((~rows["status"].isin(FINISHED)).sum())
    reached = problem.values(label, TO_SUCCESS)
    successes = int(np.count_nonzero(np.isfinite(reached)))
    spent = np.nan_to_num(pd.to_numeric(rows["evaluations"]).to_numpy(dtype=float, na_value=np.nan))
    low, high = stats.wilson(successes, len(rows))
    row: dict[str, object] = {
        "problem": problem.name,
        "optimizer": label,
        "trials": len(rows),
        "failed": failed,
        **_spread(problem, label, "fitness"),
        **_spread(problem, label, "relative_rms"),
        "max_error_median": stats.quantile(problem.values(label, "max_error"), 0.5),
        "held_out_rmse_median": stats.quantile(problem.values(label, "held_out_rmse"), 0.5),
        "successes": successes,
        "success_rate": successes / len(rows),
        "success_low": low,
        "success_high": high,
        "evaluations_to_success_median": stats.quantile(reached, 0.5),
        "expected_running_time": stats.expected_running_time(reached, spent) if problem.traces else float("nan"),
        "evaluations_median": float(np.median(spent)),
        "seconds_median": stats.quantile(problem.values(label, "seconds"), 0.5),
        "mean_rank": problem.friedman.mean_ranks[problem.labels.index(label)],
    }
    for name, family in (("reference", problem.against_reference), ("best", problem.against_winner)):
        found = family.get(label)
        row[f"p_{name}"] = found.p if found else None
        row[f"a12_{name}"] = found.a12 if found else None
    row["verdict_reference"] = _verdict(problem.against_reference.get(label), "the reference")
    row["verdict_best"] = _verdict(problem.against_winner.get(label), "the best")
    return row


def _spread(problem: Problem, label: str, metric: str) -> dict[str, float]:
    values = problem.values(label, metric)
    shares = {"best": 0.0, "median": 0.5, "q1": 0.25, "q3": 0.75}
    return {f"{metric}_{name}": stats.quantile(values, share) for name, share in shares.items()}


def _verdict(found: stats.Comparison | None, with_whom: str) -> str:
    return found.words if found else f"is {with_whom}"


def at_iterations(results: Results, iterations: int) -> pd.DataFrame:
    """Fitness after the first swarm and so many iterations, for each optimizer that has iterations.

    Columns: problem, optimizer, evaluations_per_iteration, evaluations, fitness_best, fitness_median,
    fitness_q1, fitness_q3, note ("" or why there is no number).
    """
    rows = []
    for problem in problems(results, any_budget=True):
        for label in problem.ranked:
            made = results.provenance.get("optimizers", {}).get(label, {})
            cost = made.get("evaluations_per_iteration")
            budget = made.get("budget", results.study.budget)
            row = {"problem": problem.name, "optimizer": label, "evaluations_per_iteration": cost, "note": ""}
            if not cost:
                row["note"] = "has no iterations"
            elif cost * iterations >= budget:
                row |= {"evaluations": cost * (iterations + 1), "note": "beyond the budget"}
            else:
                spent = min(cost * (iterations + 1), budget)  # a first swarm may cost less than an iteration
                at = [problem.best_at(label, int(t), np.array([spent]))[0] for t in problem.rows[label]["trial"]]
                row["evaluations"] = spent
                row |= {
                    f"fitness_{name}": stats.quantile(at, q)
                    for name, q in (("best", 0.0), ("median", 0.5), ("q1", 0.25), ("q3", 0.75))
                }
            rows.append(row)
    columns = ["problem", "optimizer", "evaluations_per_iteration", "evaluations"]
    columns += ["fitness_best", "fitness_median", "fitness_q1", "fitness_q3", "note"]
    return pd.DataFrame(rows, columns=columns)
