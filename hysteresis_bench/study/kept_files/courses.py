"""The course of every search as a small file, from which a page can be written again where trials.sqlite is not kept.

One row a trial: at which counts of evaluations the best so far fell, as differences, and to what, with DIGITS digits;
where its parameters are kept, too, those that are searched by name.
"""

from __future__ import annotations

import json
import lzma
from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import read_table, write_table
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.kept_files.trial_rows import FIRST, KEY
from hysteresis_bench.study.origin import Trial

COURSES = "courses.csv.xz"
COLUMNS = (*KEY, "evaluations", "losses", "points")
DIGITS, POINT_DIGITS = 7, 4
WITH_POINTS = 8
"""Trials of an optimizer, on the first instance, whose parameters are kept."""


def write_courses(folder: Path, traces: Mapping[Trial, Trace], moving: Collection[str] = ()) -> Path:
    """Write the file; returns it. moving : optimizers whose parameters are kept along the search, of a few trials"""
    rows = []
    for key, trace in sorted(traces.items()):
        _, optimizer, instance, number = key
        moves = optimizer in moving and instance == FIRST and number < WITH_POINTS
        points = [_text(column, POINT_DIGITS) for column in trace.points.T] if moves else []
        steps = " ".join(str(int(step)) for step in np.diff(trace.evaluations, prepend=0))
        rows.append((*key, steps, _text(trace.losses, DIGITS), json.dumps(points)))
    write_table(folder / COURSES, pd.DataFrame(rows, columns=list(COLUMNS)))
    return folder / COURSES


def read_courses(path: Path) -> dict[Trial, Trace]:
    """Raises ValueError, or another of store.DAMAGED, for what no study has left."""
    try:
        table = read_table(path)[list(COLUMNS)].astype({"evaluations": str, "losses": str})
    except lzma.LZMAError as error:
        raise ValueError(str(error)) from None
    found: dict[Trial, Trace] = {}
    for row in table.itertuples(index=False):
        evaluations, losses = np.cumsum(_numbers(row.evaluations)), _numbers(row.losses)
        points = [_numbers(column) for column in json.loads(row.points)]
        moved = np.array(points).T if points else np.empty((losses.size, 0))
        if not evaluations.size == losses.size == len(moved):
            raise ValueError("a course has more counts than losses, or fewer")
        found[row.problem, row.optimizer, int(row.instance), int(row.trial)] = Trace(evaluations, losses, moved)
    return found


def _text(values: Array, digits: int) -> str:
    return " ".join(f"{value:.{digits}g}" for value in values)


def _numbers(text: str) -> Array:
    return np.array(text.split(), dtype=float)
