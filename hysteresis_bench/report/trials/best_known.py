"""The best that any trial of a study found, instance by instance: against it every success is counted."""

from __future__ import annotations

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.study.results import FINISHED

INF = float("inf")
NEAR = 1.01
"""A success is a fitness within this factor of the best known to the study on the instance."""

EQUAL = 1.0001
"""Tests take a fitness within this factor of the best known for the best known itself: with noise-free
arithmetic the twelfth digit would decide otherwise."""

EXACT = 1e-6
"""Relative RMS below which a fit is exact and none is better than another: on data without noise some searches
go on to the last bit, and whether they do says nothing."""


def metric_values(rows: pd.DataFrame, metric: str) -> Array:
    """(rows,) of a column of trials.csv; inf where a trial failed."""
    numbers = pd.to_numeric(rows[metric], errors="coerce").to_numpy(dtype=float, na_value=INF)
    return np.where(rows["status"].isin(FINISHED), np.where(np.isnan(numbers), INF, numbers), INF)


def best_known(rows: pd.DataFrame) -> dict[int, float]:
    """By instance the lowest fitness of any trial, or the highest that is EXACT; inf where all failed.

    rows : of one problem, all optimizers whatever their budget
    """
    fitness, error = metric_values(rows, "fitness"), metric_values(rows, "relative_rms")
    found = {}
    for instance in np.unique(rows["instance"].to_numpy(dtype=int)):
        here = (rows["instance"] == instance).to_numpy(dtype=bool)
        exact = fitness[here & (error <= EXACT)]
        found[int(instance)] = float(exact.max() if exact.size else fitness[here].min())
    return found
