"""Single numbers out of stages.csv."""

from __future__ import annotations

import numpy as np
import pandas as pd

from hysteresis_bench.study.study_file import StageSpec


def error_of(rows: pd.DataFrame, label: str, way: str, *, quantity: str, name: str) -> float | None:
    """One quantity of one record; None where it is absent. rows : of one stage, with the columns of stages.csv"""
    found = rows[(rows["optimizer"] == label) & (rows["way"] == way) & (rows["quantity"] == quantity)]
    values = found[found["name"] == name]["value"]
    return None if values.empty or pd.isna(values.iloc[0]) else float(values.iloc[0])


def mean_error(spec: StageSpec, rows: pd.DataFrame, label: str, *, way: str, quantity: str) -> float | None:
    """Over the records of the check; None where one of them is absent."""
    errors = [error_of(rows, label, way, quantity=quantity, name=record) for record in spec.check]
    return None if None in errors else float(np.mean(np.array(errors, dtype=float)))


def labels_of(rows: pd.DataFrame, way: str) -> list[str]:
    """Optimizers, in the file's order."""
    return list(rows[rows["way"] == way]["optimizer"].drop_duplicates())
