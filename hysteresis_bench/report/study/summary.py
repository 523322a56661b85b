"""The numbers of the report: one row an optimizer and problem, and what the tests say of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.arrays import Array
from hysteresis_bench.study.results import FINISHED, Results
from hysteresis_bench.study.study_file import Study

INF = float("inf")
NEAR = 1.01
"""A success is a fitness within this factor of the best known to the study on the problem."""

EQUAL = 1.0001
"""Tests take a fitness within this factor of the best known for the best known itself: with noise-free
arithmetic the twelfth digit would decide otherwise."""

EXACT = 1e-6
"""Relative RMS below which a fit is exact and none is better than another: on data without noise some searches
go on to the last bit, and whether they do says nothing."""


@dataclass(frozen=True, eq=False)
class Problem:
    """The trials of one problem as arrays of trials that every optimizer has, inf where a trial failed.

    labels : optimizers in the order of the study file, those without a trial left out
    trials : the trials that all of them have; tests are paired over these
    """

    name: str
    labels: list[str]
    rows: Mapping[str, pd.DataFrame]
    traces: Mapping[tuple[str, int], tuple[Array, Array]]
    reference: str

    @cached_property
    def trials(self) -> list[int]:
        common = [set(rows["trial"]) for rows in self.rows.values()]
        return sorted(set.intersection(*common)) if common else []

    def values(self, label: str, metric: str, paired: bool = False) -> Array:
        """(trials,) of one metric, a column of trials.csv or evaluations_to_success; paired: of `trials` only."""
        rows = self.rows[label]
        if paired:
            rows = rows[rows["trial"].isin(self.trials)]
        if metric == "evaluations_to_success":
            found = [self.first_below(label, int(trial), self.target) for trial in rows["trial"]]
            return np.array(found, dtype=float)
        numbers = pd.to_numeric(rows[metric], errors="coerce").to_numpy(dtype=float, na_value=INF)
        return np.where(rows["status"].isin(FINISHED), np.where(np.isnan(numbers), INF, numbers), INF)

    def compared(self, label: str, metric: str = "fitness") -> Array:
        """(trials,) as the tests take them: paired, and fitness not told apart below EQUAL."""
        values = self.values(label, metric, paired=True)
        return np.maximum(values, EQUAL * self.best_known) if metric == "fitness" else values

    def best_trial(self, label: str) -> pd.Series | None:
        """The row of the trial with the lowest fitness; None where all failed."""
        finished = self.rows[label][self.rows[label]["status"].isin(FINISHED)]
        return None if finished.empty else finished.sort_values("fitness", kind="stable").iloc[0]

    @cached_property
    def best_known(self) -> float:
        """The lowest fitness any trial of the study found here, or the highest that is EXACT; inf where all failed."""
        exact = [
            float(np.max(self.values(label, "fitness")[close]))
            for label in self.labels
            if np.any(close := self.values(label, "relative_rms") <= EXACT)
        ]
        return (
            max(exact)
            if exact
            else min((float(np.min(self.values(label, "fitness"), initial=INF)) for label in self.labels), default=INF)
        )

    @property
    def target(self) -> float:
        return NEAR * self.best_known

    def first_below(self, label: str, trial: int, target: float) -> float:
        """Evaluations after which a trial's best was at or below the target; inf if never."""
        evaluations, losses = self.traces.get((label, trial), (np.empty(0), np.empty(0)))
        hits = np.nonzero(losses <= target)[0]
        return float(evaluations[hits[0]]) if hits.size and np.isfinite(target) else INF

    def best_at(self, label: str, trial: int, evaluations: Array) -> Array:
        """Best fitness of a trial after so many evaluations; inf before the first, and where it failed."""
        counts, losses = self.traces.get((label, trial), (np.empty(0), np.empty(0)))
        return np.concatenate([[INF], losses])[np.searchsorted(counts, evaluations, side="right")]

    @cached_property
    def ranked(self) -> list[str]:
        """Labels by median fitness as the tests take it, then by mean rank, evaluations to a success, name."""
        mean_ranks = dict(zip(self.labels, self.friedman.mean_ranks, strict=True))
        floor = EQUAL * self.best_known
        return sorted(
            self.labels,
            key=lambda label: (
                max(stats.quantile(self.values(label, "fitness"), 0.5), floor),
                mean_ranks[label],
                stats.quantile(self.values(label, "evaluations_to_success"), 0.5),
                label,
            ),
        )

    @property
    def winner(self) -> str:
        return self.ranked[0]

    def against(self, label: str) -> dict[str, stats.Comparison]:
        """Fitness of every other optimizer against this one, Holm-corrected; empty without it."""
        if label not in self.labels:
            return {}
        others = [other for other in self.labels if other != label]
        samples = [self.compared(other) for other in others]
        return dict(zip(others, stats.compare(samples, self.compared(label)), strict=True))

    @cached_property
    def against_reference(self) -> dict[str, stats.Comparison]:
        return self.against(self.reference)

    @cached_property
    def against_winner(self) -> dict[str, stats.Comparison]:
        return self.against(self.winner)

    @cached_property
    def friedman(self) -> stats.Friedman:
        return stats.friedman([self.compared(label) for label in self.labels])

    @property
    def tied_with_winner(self) -> list[str]:
        """Whom the trials cannot tell apart from the best, best first."""
        same = [label for label, found in self.against_winner.items() if found.words == stats.SAME]
        return [label for label in self.ranked if label in same]


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
    reached = problem.values(label, "evaluations_to_success")
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
        "expected_running_time": stats.expected_running_time(reached, spent),
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
            told = results.provenance.get("optimizers", {}).get(label, {})
            cost = told.get("evaluations_per_iteration")
            budget = told.get("budget", results.study.budget)
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
