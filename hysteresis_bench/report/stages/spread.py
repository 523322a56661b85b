"""The tables of a stage over every trial and instance: what the paper prints beside a median and its spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import AS_PRINTED, NONE, named, number
from hysteresis_bench.study.afterwards.staged_trials import TUNED
from hysteresis_bench.study.study_file import StageSpec

CHECKS = {"error": ("check_error", "F_error, eq. (12)"), "rmse": ("check_rmse", "F_rmse, eq. (13)")}
MEAN, COMPUTED = "mean", 4
"""What a mean is called, and the digits of one that is computed here from printed entries."""
LOOPS = {"error": ("tracking_error", "T_error"), "rmse": ("tracking_rmse", "T_rmse")}


def spread_tables(spec: StageSpec, staged: pd.DataFrame, published: Published, unit: str) -> list[Table]:
    """The section, the check and the closed loops of one stage; none where one trial is all there is.

    staged : the rows of this stage, see staged_trials
    """
    if len(staged) <= len(spec.optimizers):
        return []
    units = {"output": unit}
    printed = [table.columns for table in published.tables.values()]
    sections = next((columns for columns in printed if {"optimizer", *spec.fit} <= set(columns)), {})
    tables = [_table(f"{spec.name}: the linear section", staged, spec.optimizers, spec.fit, _by_optimizer(sections))]
    checks = next((columns for columns in printed if "record" in columns), {})
    for key, (metric, words) in CHECKS.items():
        rows = [*(f"{metric}.{record}" for record in spec.check), *([metric] if spec.check else [])]
        theirs = _by_column(checks, "record", key, metric)
        tables.append(_table(f"{spec.name}: {named(words, units, 'output')}", staged, spec.optimizers, rows, theirs))
    loops = next((table for table in published.tables.values() if "reference" in table.columns), None)
    for controller in spec.controllers:
        its = loops.columns if loops and loops.controller == controller else {}
        for key, (metric, words) in LOOPS.items():
            name = f"{metric}.{controller}"
            rows = [column for column in staged.columns if column.startswith(f"{name}.")] + [name]
            title = f"{spec.name}: {controller}, {named(words, units, 'output')}"
            tables.append(_table(title, staged, spec.control, rows, _by_column(its, "reference", key, name)))
    return [table for table in tables if table.rows]


def tuned_table(spec: StageSpec, staged: pd.DataFrame, published: Published) -> Table | None:
    """The constants of the sliding mode beside the printed ones; None where no trial has any. staged : as above"""
    if not spec.control or not set(TUNED.values()) & set(staged.columns):
        return None
    printed = _constants([table.columns for table in published.tables.values()])
    theirs = {label: printed for label in spec.control[:1] if printed}
    title = f"{spec.name}: constants of the sliding mode (15), tuned on the model that each trial found"
    return _table(title, staged, spec.control, list(TUNED.values()), theirs)


Printed = Mapping[str, Mapping[str, float]]
"""By optimizer and row."""


def _table(title: str, staged: pd.DataFrame, labels: Sequence[str], names: Sequence[str], printed: Printed) -> Table:
    """A row a quantity: what is printed, and our median with quartiles over instances."""
    header, rows = ["Quantity"], []
    for label in labels:
        header += [f"{label}, published"] if label in printed else []
        header.append(f"{label}, ours" if label in printed else label)
    for name in (name for name in names if name in staged.columns):
        row: list[str | Cell] = [Cell(_last(name), "line")]
        for label in labels:
            digits = COMPUTED if _last(name) == MEAN else AS_PRINTED
            row += [number(printed[label].get(name), digits)] if label in printed else []
            row.append(_spread(_blocks(staged[staged["optimizer"] == label], name)))
        rows.append(row)
    instances, trials = staged["instance"].nunique(), len(staged[staged["optimizer"] == labels[0]])
    over = f"{instances} instances, {trials} trials" if instances > 1 else f"{trials} trial{'s' * (trials != 1)}"
    note = "Median (lower to upper quartile), instances by their medians." if trials > 1 else ""
    return Table(f"{title}, over {over}", header, rows, note)


def _last(name: str) -> str:
    """Of `check_rmse.sine-10-hz` the signal; a mean is called so."""
    metric, _, rest = name.partition(".")
    known = {"tuned", *(metric for metric, _ in (*CHECKS.values(), *LOOPS.values()))}
    if metric not in known:
        return name
    signal = rest.partition(".")[2] if metric.startswith("tracking") else rest
    return signal or MEAN


def _blocks(rows: pd.DataFrame, name: str) -> Array:
    """Medians of the instances, or the trials of a single one; inf where a section could not be used."""
    values = rows[name].astype(float).fillna(np.inf)
    by_instance = values.groupby(rows["instance"]).median()
    blocks: Array = (by_instance if len(by_instance) > 1 else values).to_numpy(dtype=float)
    return blocks


def _spread(blocks: Array) -> str:
    if blocks.size == 0:
        return NONE
    if blocks.size == 1:
        return number(blocks[0])
    low, middle, high = (number(statistics.quantile(blocks, share)) for share in (0.25, 0.5, 0.75))
    return f"{middle} ({low} to {high})"


def _constants(printed: Sequence[Mapping[str, Sequence[float | str]]]) -> dict[str, float]:
    """Of (15), from a printed table of parameters and values; empty without one."""
    for columns in printed:
        if {"parameter", "value"} <= set(columns) and "rho" in columns["parameter"]:
            pairs = zip(columns["parameter"], columns["value"], strict=True)
            return {f"tuned.{name}": float(value) for name, value in pairs}
    return {}


def _by_optimizer(columns: Mapping[str, Sequence[float | str]]) -> Printed:
    names = [str(name) for name in columns.get("optimizer", ())]
    numbers = {key: values for key, values in columns.items() if key != "optimizer"}
    return {name: {key: float(values[place]) for key, values in numbers.items()} for place, name in enumerate(names)}


def _by_column(columns: Mapping[str, Sequence[float | str]], row: str, key: str, metric: str) -> Printed:
    """Of columns LABEL_KEY with a name a row; the mean is computed here from the printed entries."""
    names = [str(name) for name in columns.get(row, ())]
    found = {}
    for column, values in columns.items():
        if column.endswith(f"_{key}"):
            numbers = [float(value) for value in values]
            of_rows = {f"{metric}.{name}": value for name, value in zip(names, numbers, strict=True)}
            found[column.removesuffix(f"_{key}")] = of_rows | {metric: float(np.mean(numbers))}
    return found
