"""What a row of trials.csv may hold: whether a table of trials is one, or was changed by something else."""

from __future__ import annotations

import numpy as np
import pandas as pd

STATUSES = (
    "done",
    "finished-early",
    "no-finite-loss",
    "raised",
    "timed-out",
    "crashed",
    "out-of-memory",
    "killed",
    "not-started",
)
FINISHED = ("done", "finished-early")
"""Statuses of a trial that has a result."""

KEY = ("problem", "optimizer", "instance", "trial")
MEASURED = ("evaluations", "fitness", "rmse", "relative_rms", "max_error", "held_out_rmse", "seconds")
NUMBERS = ("instance", "trial", *MEASURED)

FIRST = 1
"""The instance that is the rig as it stands, or the data; the only one where a study asks for no more."""


def with_instances(trials: pd.DataFrame) -> pd.DataFrame:
    """A table as it is kept, with the column that it lacks where all of it is of the first instance."""
    if "instance" in trials.columns:
        return trials
    whole = trials.copy()
    whole.insert(list(whole.columns).index("optimizer") + 1, "instance", FIRST)
    return whole


def as_kept(trials: pd.DataFrame) -> pd.DataFrame:
    """Without the column `instance` where all of it is of the first one."""
    return trials.drop(columns="instance") if (trials["instance"] == FIRST).all() else trials


def check_rows(trials: pd.DataFrame) -> None:
    """Raises ValueError telling where a table of trials holds what no trial has; an absent number is NaN or NA."""
    for name in ("problem", "optimizer", "status"):
        if not (texts := trials[name].map(lambda value: isinstance(value, str))).all():
            raise ValueError(f"{name} is no text in row {int(np.argmin(texts)) + 1}")
    if not trials["status"].isin(STATUSES).all():
        raise ValueError("there is no such status in one of its rows")
    for name in (*NUMBERS, *(name for name in trials.columns if name.startswith("parameter."))):
        numbers = np.array([_number(value) for value in trials[name]])
        if np.isinf(numbers).any():
            raise ValueError(f"{name} is no number in row {int(np.argmax(np.isinf(numbers))) + 1}")
    if (trials["status"].isin(FINISHED) & trials["fitness"].isna()).any():
        raise ValueError("a finished trial has no fitness")
    if trials.duplicated(list(KEY)).any() or trials[["instance", "trial"]].isna().any(axis=None):
        raise ValueError("a trial stands there twice, or has no number")


def _number(value: object) -> float:
    """NaN where it is absent, infinite where it is none."""
    if value is None or value is pd.NA:
        return np.nan
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        return np.inf
    return float(value)
