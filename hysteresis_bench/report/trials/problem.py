"""The trials of one problem: medians, ranks, and who can be told from whom.

An instance is a block of every test and interval, its trials are repeats. Where there is one instance, its trials are
the blocks, and what is found holds in this instance alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.trials.best_known import EQUAL, EXACT, INF, NEAR, metric_values
from hysteresis_bench.report.trials.metrics import TO_SUCCESS

Key = tuple[int, int]
"""instance, trial"""

PRACTICAL = {"fitness": "relative_rms"}
"""On what equivalence is judged, where not on the metric itself: a fitness may be a square."""


NONE, NEVER = np.empty(0), np.array([INF])


@dataclass(frozen=True, eq=False)
class Problem:
    """The trials of one problem as arrays of trials that every optimizer has, inf where a trial failed.

    labels : optimizers in the order of the study file, those without a trial left out
    rows : of each the trials, ordered by instance and trial
    best : the lowest fitness that any trial of the study found, whatever its budget, by instance
    anytime : by optimizer, whether it searches alike whatever the budget; None where nobody knows
    """

    name: str
    labels: list[str]
    rows: Mapping[str, pd.DataFrame]
    traces: Mapping[tuple[str, int, int], tuple[Array, Array]]
    reference: str
    best: Mapping[int, float]
    anytime: Mapping[str, bool | None] = field(default_factory=dict)

    @cached_property
    def trials(self) -> list[Key]:
        """Those that all optimizers have; tests are paired over these."""
        common = [set(self.keys(label)) for label in self.labels]
        return sorted(set.intersection(*common)) if common else []

    @cached_property
    def instances(self) -> list[int]:
        return sorted({instance for label in self.labels for instance, _ in self.keys(label)})

    @property
    def several(self) -> bool:
        """Whether what is found holds beyond one instance: all optimizers have several."""
        return len({instance for instance, _ in self.trials}) > 1

    @property
    def blocks(self) -> int:
        """Of the tests: instances, or the trials of a single one."""
        return len({instance for instance, _ in self.trials}) if self.several else len(self.trials)

    @property
    def counted(self) -> str:
        """How many blocks, in words."""
        word = "instance" if self.several else "trial"
        return f"{self.blocks} {word}{'s' * (self.blocks != 1)}"

    def keys(self, label: str) -> list[Key]:
        return self._keys[label]

    @cached_property
    def _keys(self) -> dict[str, list[Key]]:
        return {
            label: list(zip(map(int, rows["instance"]), map(int, rows["trial"]), strict=True))
            for label, rows in self.rows.items()
        }

    def has(self, metric: str) -> bool:
        """Whether it is known of any trial."""
        return metric == TO_SUCCESS or any(metric in rows.columns for rows in self.rows.values())

    def values(self, label: str, metric: str) -> Array:
        """(trials,) of one metric, a column of trials.csv or evaluations_to_success."""
        if metric == TO_SUCCESS:
            return self._to_success[label]
        return metric_values(self.rows[label], metric)

    @cached_property
    def _to_success(self) -> dict[str, Array]:
        return {label: self.reached(label, NEAR * self.known(label)[:, None])[:, 0] for label in self.rows}

    def known(self, label: str) -> Array:
        """(trials,): the best known fitness of every trial's instance."""
        return np.array([self.best[instance] for instance, _ in self.keys(label)])

    def ratios(self, label: str) -> Array:
        """(trials,): fitness over the best known of the instance; not below 1, and the fitness itself where the best
        known is 0 or no trial has a result."""
        known = self.known(label)
        floor = np.maximum(self.values(label, "fitness"), known)
        usable = (known > 0.0) & (known < INF)
        return np.divide(floor, known, out=floor.copy(), where=usable)

    def per_block(self, label: str, values: Array) -> Array:
        """(blocks,): the medians of the instances that it has, or the trials of a single one; values : (trials,)"""
        instances = self.rows[label]["instance"].to_numpy(dtype=int)
        if (numbers := np.unique(instances)).size == 1:
            return values
        medians: Array = np.array([np.median(values[instances == number]) for number in numbers])
        return medians

    def middle(self, label: str, metric: str) -> float:
        """The median over instances of the medians of their trials."""
        return statistics.quantile(self.per_block(label, self.values(label, metric)), 0.5)

    def sample(self, label: str, metric: str = "fitness") -> statistics.Sample:
        """As the tests take it: paired, on a logarithmic scale, what is exact or EQUAL to the best known not told
        apart."""
        if (asked := (label, metric)) not in self._samples:
            paired = [self._paired(label, each) for each in (metric, PRACTICAL.get(metric, metric))]
            self._samples[asked] = statistics.Sample(*paired)
        return self._samples[asked]

    @cached_property
    def _samples(self) -> dict[tuple[str, str], statistics.Sample]:
        """By optimizer and metric, what was asked for so far."""
        return {}

    def _paired(self, label: str, metric: str) -> tuple[Array, ...]:
        values = self.values(label, metric)
        if metric == "fitness":
            values = np.maximum(values, EQUAL * self.known(label))
        if metric == "relative_rms":
            values = np.maximum(values, EXACT)
        with np.errstate(divide="ignore"):
            of = dict(zip(self.keys(label), np.log(values), strict=True))
        together = sorted({instance for instance, _ in self.trials})
        return tuple(np.array([of[key] for key in self.trials if key[0] == instance]) for instance in together)

    def best_trial(self, label: str) -> pd.Series | None:
        """The row of the trial with the lowest fitness on the first instance; None where all failed."""
        rows = self.rows[label][np.isfinite(self.values(label, "fitness"))]
        rows = rows[rows["instance"] == self.instances[0]]
        return None if rows.empty else rows.sort_values("fitness", kind="stable").iloc[0]

    @property
    def failed(self) -> bool:
        """Whether no trial has a result."""
        return not any(np.isfinite(known) for known in self.best.values())

    def reached(self, label: str, targets: Array) -> Array:
        """(trials, targets): evaluations after which a trial's best was at or below each of its targets; inf if never,
        NaN where the course of the searches was not kept. targets : (trials, targets)"""
        found = np.full(targets.shape, INF if self.traces else np.nan)
        for row, asked, (counts, losses) in zip(found, targets, self._courses(label), strict=True):
            if losses.size:
                places = np.searchsorted(-np.fmin.accumulate(losses), -asked)
                np.take(np.concatenate((counts, NEVER)), places, out=row)
        if self.traces:
            found[~np.isfinite(targets)] = INF
        return found

    def best_after(self, label: str, evaluations: Array) -> Array:
        """(trials, evaluations): best fitness of every trial after so many evaluations; inf before the first, and where
        it failed. evaluations : (evaluations,)"""
        found = np.full((len(self.rows[label]), evaluations.size), INF)
        for row, (counts, losses) in zip(found, self._courses(label), strict=True):
            if losses.size:
                np.take(np.concatenate((NEVER, losses)), np.searchsorted(counts, evaluations, side="right"), out=row)
        return found

    def _courses(self, label: str) -> Iterator[tuple[Array, Array]]:
        """Of every trial the counts and losses of its trace, empty where it has none."""
        return (self.traces.get((label, *key), (NONE, NONE)) for key in self.keys(label))

    def repeats_itself(self, label: str) -> bool:
        """Whether an optimizer is deterministic: wherever an instance has several trials, all came to the same."""
        rows = self.rows[label].groupby("instance")[["status", "evaluations", "fitness"]]
        return bool((rows.size() > 1).any() and (rows.nunique(dropna=False) == 1).all(axis=None))

    @cached_property
    def ranked(self) -> list[str]:
        """Labels by median fitness over the best known as the tests take it, then by mean rank, evaluations to a
        success, name."""
        mean_ranks = dict(zip(self.labels, self.friedman.mean_ranks, strict=True))
        return sorted(
            self.labels,
            key=lambda label: (
                max(statistics.quantile(self.per_block(label, self.ratios(label)), 0.5), self._floor),
                mean_ranks[label],
                self.middle(label, TO_SUCCESS) if self.traces else 0.0,
                label,
            ),
        )

    @property
    def _floor(self) -> float:
        """Of ratios that are not told apart."""
        known = statistics.quantile(list(self.best.values()), 0.5)
        return EQUAL if 0.0 < known < INF else 0.0

    @property
    def winner(self) -> str:
        return self.ranked[0]

    @cached_property
    def against_reference(self) -> dict[str, statistics.Comparison]:
        """Fitness of every other optimizer against the reference, which the study names beforehand: Holm-corrected over
        the others. Empty without it."""
        if self.reference not in self.labels:
            return {}
        others = [other for other in self.labels if other != self.reference]
        samples = [self.sample(other) for other in others]
        return dict(zip(others, statistics.compare(samples, self.sample(self.reference)), strict=True))

    @cached_property
    def against_winner(self) -> dict[str, statistics.Comparison]:
        """Fitness of every other optimizer against the winner, which these same trials chose: Holm-corrected over all
        pairs, as any of them might have been asked."""
        others = [other for other in self.labels if other != self.winner]
        pairs = [(self.sample(other), self.sample(self.winner)) for other in others]
        tested = [self.tested[other, self.winner] for other in others]
        return dict(zip(others, statistics.compare_pairs(pairs, tested=tested), strict=True))

    @cached_property
    def tested(self) -> dict[tuple[str, str], statistics.SignedRank]:
        """Everybody against everybody, Holm-corrected over all pairs."""
        return statistics.every_pair({label: self.sample(label) for label in self.labels})

    @cached_property
    def friedman(self) -> statistics.Friedman:
        return statistics.friedman([self.sample(label).blocks for label in self.labels])

    @property
    def tied_with_winner(self) -> list[str]:
        """Whom the trials cannot tell apart from the best, or find equivalent, best first."""
        return [
            label
            for label in self.ranked
            if (found := self.against_winner.get(label)) and found.p is not None and found.verdict not in APART
        ]


APART = ("better", "worse")
"""Verdicts that tell two apart."""
