"""The trials of one problem: medians, ranks, and who can be told from whom."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.trials.metrics import TO_SUCCESS
from hysteresis_bench.study.results import FINISHED

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
        if metric == TO_SUCCESS:
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
        """Evaluations after which a trial's best was at or below the target; inf if never, NaN where the course of the
        searches was not kept."""
        if not self.traces:
            return float("nan")
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
                stats.quantile(self.values(label, TO_SUCCESS), 0.5) if self.traces else 0.0,
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
