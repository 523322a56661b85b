"""The numbers of the report: one row an optimizer and problem, and what the tests say of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.report.trials.anytime import anytime
from hysteresis_bench.report.trials.best_known import NEAR, best_known
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
    known = anytime(results)
    found = []
    for spec in results.study.problem:
        here = _with_stages(results, spec.name)
        labels = [label for label in _labels(results, here) if any_budget or label not in other]
        rows = {label: here[here["optimizer"] == label].sort_values(["instance", "trial"]) for label in labels}
        traces = {
            (optimizer, instance, trial): (trace.evaluations, trace.losses)
            for (problem, optimizer, instance, trial), trace in results.traces.items()
            if problem == spec.name
        }
        if rows:
            reference = _reference(results.study, labels)
            found.append(Problem(spec.name, list(rows), rows, traces, reference, best_known(here), known))
    return found


def _with_stages(results: Results, problem: str) -> pd.DataFrame:
    """The trials of a problem, with what followed each of them as further columns."""
    rows, staged = results.trials[results.trials["problem"] == problem], results.staged
    following = [stage.name for stage in results.study.stage if stage.after == problem]
    if staged.empty or not following:
        return rows
    key = ["optimizer", "instance", "trial"]
    behind = staged[staged["stage"].isin(following)].drop_duplicates(key).dropna(axis="columns", how="all")
    return rows.merge(behind.drop(columns=["stage", "made_of", "fault"], errors="ignore"), how="left", on=key)


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

    Medians and quartiles are over instances, of the medians of their trials; over the trials of a single one. Failed
    trials count as infinitely bad in all of them; p-values are empty below 14 instances, or trials of a single one.
    budget : of the optimizers that are compared, the study's own without one
    """
    return summary_of(problems(results, budget), budget or results.study.budget)


def summary_of(here: Sequence[Problem], budget: int) -> pd.DataFrame:
    """As `summarise`, of problems at a budget."""
    return pd.DataFrame([_row(problem, label, budget) for problem in here for label in problem.ranked])


def _row(problem: Problem, label: str, budget: int) -> dict[str, object]:
    rows = problem.rows[label]
    row: dict[str, object] = {
        "problem": problem.name,
        "optimizer": label,
        "budget": budget,
        "instances": rows["instance"].nunique(),
        "trials": len(rows),
        "failed": int((~rows["status"].isin(FINISHED)).sum()),
        "deterministic": problem.repeats_itself(label),
        **_spread(problem, label, "fitness"),
        **_spread(problem, label, "relative_rms"),
        "max_error_median": problem.middle(label, "max_error"),
        "held_out_rmse_median": problem.middle(label, "held_out_rmse"),
        **_successes(problem, label),
        "seconds_median": problem.middle(label, "seconds"),
        "mean_rank": problem.friedman.mean_ranks[problem.labels.index(label)],
    }
    against = (
        ("reference", problem.reference, problem.against_reference),
        ("best", problem.winner, problem.against_winner),
    )
    for name, other, family in against:
        found = family.get(label)
        row[f"verdict_{name}"] = found.words if found else f"is the {name}" if label == other else f"no {name}"
        row[f"p_{name}"] = found.p if found else None
        for key in ("a12", "low", "high"):
            row["_".join(dict.fromkeys(("a12", key, name)))] = getattr(found, key) if found else None
        for key in ("better", "equivalent", "worse"):
            row[f"{key}_{name}"] = getattr(found.practical, key) if found and found.practical else None
    return row


def _spread(problem: Problem, label: str, metric: str) -> dict[str, float]:
    values = problem.values(label, metric)
    blocks = problem.per_block(label, values)
    low, high = statistics.median_interval(blocks)
    shares = {"median": 0.5, "q1": 0.25, "q3": 0.75}
    found = {f"{metric}_{name}": statistics.quantile(blocks, share) for name, share in shares.items()}
    best = {f"{metric}_best": float(np.min(values, initial=np.inf))}
    return best | found | {f"{metric}_median_low": low, f"{metric}_median_high": high}


def _successes(problem: Problem, label: str) -> dict[str, object]:
    """Of a deterministic optimizer one trial an instance is counted: the others are the same trial again. The interval
    of the rate takes instances for its trials, where there are several."""
    rows = problem.rows[label]
    counted = np.full(len(rows), True)
    if problem.repeats_itself(label):
        counted = ~rows["instance"].duplicated().to_numpy(dtype=bool)
    reached = problem.values(label, TO_SUCCESS)[counted]
    hits = problem.values(label, "fitness")[counted] <= NEAR * problem.known(label)[counted]
    hits &= np.isfinite(problem.values(label, "fitness")[counted])
    spent = np.nan_to_num(pd.to_numeric(rows["evaluations"]).to_numpy(dtype=float, na_value=np.nan))[counted]
    successes, total = int(np.count_nonzero(hits)), len(hits)
    instances = rows["instance"].to_numpy(dtype=int)[counted]
    blocks = instances if np.unique(instances).size > 1 else np.arange(total)
    independent = len(np.unique(blocks))
    low, high = statistics.wilson(successes / total * independent, independent)
    charged = np.where(np.isfinite(reached), reached, spent)
    sums = [np.bincount(blocks, each)[np.unique(blocks)] for each in (charged, np.isfinite(reached).astype(float))]
    ert = statistics.expected_running_time(reached, spent), *statistics.running_time_interval(*sums)
    if not problem.traces:
        ert = (float("nan"),) * 3
    return {
        "counted": total,
        "successes": successes,
        "success_rate": successes / total,
        "success_low": low,
        "success_high": high,
        "evaluations_to_success_median": statistics.quantile(
            problem.per_block(label, problem.values(label, TO_SUCCESS)), 0.5
        ),
        "expected_running_time": ert[0],
        "expected_running_time_low": ert[1],
        "expected_running_time_high": ert[2],
        "evaluations_median": float(np.median(spent)),
    }


def at_iterations(results: Results, everybody: Sequence[Problem], iterations: int) -> pd.DataFrame:
    """Fitness after the first swarm and so many iterations, for each that has iterations, whatever its budget.

    Columns: problem, optimizer, evaluations_per_iteration, evaluations, fitness_best, fitness_median,
    fitness_q1, fitness_q3, note ("" or why there is no number).
    """
    rows = []
    for problem in everybody:
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
                at = problem.best_after(label, np.array([spent]))[:, 0]
                row["evaluations"] = spent
                row |= {
                    f"fitness_{name}": statistics.quantile(at, q)
                    for name, q in (("best", 0.0), ("median", 0.5), ("q1", 0.25), ("q3", 0.75))
                }
            rows.append(row)
    columns = ["problem", "optimizer", "evaluations_per_iteration", "evaluations"]
    columns += ["fitness_best", "fitness_median", "fitness_q1", "fitness_q3", "note"]
    return pd.DataFrame(rows, columns=columns)
