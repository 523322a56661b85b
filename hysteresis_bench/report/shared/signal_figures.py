"""Figures of signals: drive and response, loops, errors; measured beside simulated. Studies and fits share them.

Rows are those of a response table: record, role, time, input, output and what a model made of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.report.shared.text import Units, listed, named
from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, WIDEST, Picture, legend, picture, stroke

DRIVE = "voltage"
"""A column of what the drive was told, where the input itself is measured."""

MANY, DRAWN = 20, 8
"""More cycles than this cover each other; then so many of them are drawn, spread from the first to the last."""

SWING = 0.05
"""Share of the input's range by which a cycle must turn back."""

LINE = 0.01
"""A line's width as a share of what is drawn: a point of the hundred that an axis is high."""

Parts = Mapping[str, tuple[pd.DataFrame, str]]
"""Who simulated -> the rows of one record, and a colour."""


def drive(folder: Path, name: str, rows: pd.DataFrame, *, units: Units, caption: str) -> Picture:
    """Input and measured output of one record over time; above them the drive, where it is another signal."""
    driven = DRIVE in rows and bool(rows[DRIVE].notna().all())

    def draw(figure: Any) -> None:
        *first, upper, lower = figure.subplots(2 + driven, 1, sharex=True)
        for above in first:
            above.step(rows["time"], rows[DRIVE], where="post", color=MUTED, linewidth=1.0)
            above.set_ylabel(named("Drive", units, DRIVE))
        upper.plot(rows["time"], rows["input"], color=SERIES[4], linewidth=1.2)
        lower.plot(rows["time"], rows["output"], color=INK, linewidth=1.2)
        upper.set_ylabel(named("Input", units, "input"))
        lower.set_ylabel(named("Output", units, "output"))
        lower.set_xlabel(named("Time", units, "time"))
        figure.align_ylabels()

    size = (4.2, 4.2 if driven else 3.2)
    return picture(folder, name, size, alt=f"Input and output over time. {caption}", caption=caption, draw=draw)


def loop(folder: Path, name: str, parts: Parts, *, units: Units, caption: str) -> Picture:
    """Output over input of one record, measured and simulated; of many cycles some."""
    cycles, told = _few_cycles(next(iter(parts.values()))[0]["input"].to_numpy(dtype=float))
    parts = {who: (_only(rows, cycles), colour) for who, (rows, colour) in parts.items()}
    measured, _ = next(iter(parts.values()))
    caption = f"{caption}{told}{within_a_line(_simulated(parts))}"

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(measured["input"], measured["output"], label="measured", **beneath(len(parts)))
        for place, (who, (rows, colour)) in enumerate(parts.items()):
            axes.plot(rows["input"], rows["simulated"], color=colour, label=who, **stroke(place, len(parts), 1.2))
        axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))
        legend(axes)

    return picture(
        folder, name, (3.4, 3.1), alt=f"Hysteresis loop, measured and simulated. {caption}", caption=caption, draw=draw
    )


def measured_loops(
    folder: Path, name: str, rows: pd.DataFrame, *, units: Units, caption: str, most: int = len(SERIES)
) -> Picture | None:
    """The measured loops of all records in one figure, of many cycles some; None where there is only one record, or
    too many."""
    records = list(rows.groupby(["record", "role"], sort=False))
    if not 1 < len(records) <= most:
        return None
    cycles = {record: _few_cycles(part["input"].to_numpy(dtype=float)) for (record, _), part in records}
    caption += "".join(f" {record}:{told}" for record, (_, told) in cycles.items() if told)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for ((record, _), part), colour in zip(records, SERIES, strict=False):
            few = _only(part, cycles[record][0])
            axes.plot(few["input"], few["output"], color=colour, linewidth=1.0, label=record)
        axes.axhline(0, color=MUTED, linewidth=0.5)
        axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))
        legend(axes)

    return picture(
        folder, name, (3.4, 3.6), alt=f"Measured hysteresis loops of all records. {caption}", caption=caption, draw=draw
    )


def errors(folder: Path, name: str, parts: Parts, *, units: Units, caption: str) -> Picture:
    """Simulated minus measured over time, per cent of the largest measured |output|."""
    drawn = {who: relative_error(rows) for who, (rows, _) in parts.items()}
    caption = f"{caption}{within_a_line(drawn)}"

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(0, color=MUTED, linewidth=0.8)
        for place, (who, (rows, colour)) in enumerate(parts.items()):
            axes.plot(rows["time"], drawn[who], color=colour, label=who, **stroke(place, len(parts)))
        axes.set(xlabel=named("Time", units, "time"), ylabel="Error (% of largest output)")
        legend(axes, 3)

    return picture(folder, name, (4.6, 2.7), alt=f"Error over time. {caption}", caption=caption, draw=draw)


def relative_error(rows: pd.DataFrame) -> Array:
    """Simulated minus measured, per cent of the largest measured |output|."""
    measured = rows["output"].to_numpy(dtype=float)
    scale = float(np.max(np.abs(measured), initial=0.0)) or 1.0
    return np.asarray(100.0 * (rows["simulated"].to_numpy(dtype=float) - measured) / scale)


def beneath(count: int) -> dict[str, Any]:
    """How what was measured is drawn below `count` simulations: wider than they are."""
    return {"color": MUTED, "linewidth": 2.6 if count < 2 else 2.6 + WIDEST, "alpha": 0.55}


def _simulated(parts: Parts) -> dict[str, Array]:
    return {who: rows["simulated"].to_numpy(dtype=float) for who, (rows, _) in parts.items()}


def within_a_line(curves: Mapping[str, Array], begins: str = "Within") -> str:
    """A sentence, with a space before it, on the curves that cover each other everywhere; empty without any.

    curves : (samples,) by name, drawn on one axis; what is not a number is not drawn
    begins : the sentence's first words, where one of two axes is meant
    """
    shown = [values[np.isfinite(values)] for values in curves.values()]
    ends = [(values.min(), values.max()) for values in shown if values.size]
    width = LINE * (max(high for _, high in ends) - min(low for low, _ in ends)) if ends else 0.0
    groups: list[list[str]] = []
    for name, values in curves.items():
        mine = [group for group in groups if _closer(values, curves[group[0]], width)]
        if mine:
            mine[0].append(name)
        else:
            groups.append([name])
    told = [listed([f"“{name}”" for name in group], len(group)) for group in groups if len(group) > 1]
    return f" {begins} a line’s width of each other: {'; '.join(told)}." if told else ""


def _closer(one: Array, other: Array, width: float) -> bool:
    return one.shape == other.shape and bool(np.nanmax(np.abs(one - other), initial=0.0) <= width)


def _few_cycles(u: Array) -> tuple[list[slice], str]:
    """Where to draw a record's loops, and a sentence where that is not everywhere; u : (samples,), the input."""
    from hysteresis_bench.kernels.turning_points import turning_points

    turns = turning_points(np.ascontiguousarray(u), SWING * float(np.ptp(u)))
    cycles = turns.size // 2
    if cycles <= MANY:
        return [slice(None)], ""
    ends = np.concatenate([[0], turns[2:-1:2], [u.size - 1]])
    chosen = np.linspace(0, ends.size - 2, DRAWN).round().astype(int)
    return [slice(ends[i], ends[i + 1] + 1) for i in chosen], f" {DRAWN} of {cycles} cycles are drawn."


def _only(rows: pd.DataFrame, cycles: Sequence[slice]) -> pd.DataFrame:
    """These parts of a record, with a row without numbers between them, at which a line breaks."""
    if len(cycles) == 1:
        return rows
    numbers = rows.select_dtypes("number")
    gap = pd.DataFrame([[np.nan] * numbers.shape[1]], columns=numbers.columns)
    return pd.concat([part for cycle in cycles for part in (numbers.iloc[cycle], gap)], ignore_index=True)
