"""Figures of a stage: the whole model beside the measurement, over time and as a loop."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.control.bench import FEED_FORWARD
from hysteresis_bench.report.shared.signal_figures import Parts, beneath, loop, within_a_line
from hysteresis_bench.report.shared.text import Units, named, number
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, legend, picture, stroke
from hysteresis_bench.study.afterwards.stages import CONTROL

CYCLES = 3
"""Cycles of a periodic record that a figure shows: all of them would be a smear."""


def loop_figures(folder: Path, number: int, responses: pd.DataFrame, *, units: Units) -> list[Picture]:
    """Closed loops of the stage's first controller, one a reference. number : in the names of figures"""
    if responses.empty:
        return []
    loops = responses[responses["role"].str.startswith(CONTROL)]
    closed = [role for role in loops["role"].unique() if role != f"{CONTROL}{FEED_FORWARD}"]
    loops = loops[loops["role"].isin(closed[:1])]
    found = []
    for j, ((role, record), rows) in enumerate(loops.groupby(["role", "record"], sort=False), 1):
        parts = {
            str(label): (_beginning(part), colour)
            for (label, part), colour in zip(rows.groupby("optimizer", sort=False), SERIES, strict=False)
        }
        caption = f"{str(role).removeprefix(CONTROL)}, {record}: reference and displacement above, displacement minus "
        caption += "reference below."
        found.append(_fit(folder, f"stage-{number}-control-{j}", parts, units, caption, truth="reference"))
    return found


def feed_forward_figure(folder: Path, place: int, responses: pd.DataFrame, *, units: Units) -> Picture | None:
    """The inverse alone along a slow sine: what it asks for, how the actuator answers that, and both in series; None
    without. place : of the stage, in the name of the figure;  responses : of the stage"""
    alone = responses if responses.empty else responses[responses["role"] == f"{CONTROL}{FEED_FORWARD}"]
    if alone.empty:
        return None
    voltage, wanted = named("Input", units, "input"), named("Reference", units, "output")
    reached = named("Output", units, "output")
    courses = list(alone.groupby("optimizer", sort=False))
    panels = [("output", "input", wanted, voltage), ("input", "simulated", voltage, reached)]
    panels.append(("output", "simulated", wanted, reached))

    def draw(figure: Any) -> None:
        for axes, (x, y, below, beside) in zip(figure.subplots(1, 3), panels, strict=True):
            for place, ((label, rows), colour) in enumerate(zip(courses, SERIES, strict=False)):
                axes.plot(rows[x], rows[y], color=colour, label=label, **stroke(place, len(courses), 1.1))
            axes.set(xlabel=below, ylabel=beside)
        legend(figure.axes[0], 3)

    errors = (alone["simulated"] - alone["output"]).abs().groupby(alone["optimizer"], sort=False).max()
    told = ", ".join(f"{label} {number(error, 3)}" for label, error in errors.items())
    caption = (
        "As the paper’s Figure 14: the inverse of the Bouc-Wen section alone, along 0.5 Hz. Left: the voltage that "
    )
    caption += (
        "it asks for; middle: the actuator’s loop under this voltage; right: both in series, near a straight line"
    )
    caption += f". Largest {named('error', units, 'output')}: {told}."
    ranges = {key: float(np.ptp(alone[key])) or 1.0 for key in ("input", "simulated")}
    both = {label: np.concatenate([rows[key] / ranges[key] for key in ranges]) for label, rows in courses}
    caption += within_a_line(both)
    name = f"stage-{place}-feed-forward"
    return picture(folder, name, (7.4, 2.7), alt=f"Feed-forward alone. {caption}", caption=caption, draw=draw)


def stage_figures(
    folder: Path, number: int, responses: pd.DataFrame, *, units: Units
) -> tuple[list[Picture], list[Picture]]:
    """Fits over time and loops, one of each a record. responses : of the stage;  number : in the names of figures"""
    responses = responses if responses.empty else responses[~responses["role"].str.startswith(CONTROL)]
    fits: list[Picture] = []
    loops: list[Picture] = []
    if responses.empty:
        return fits, loops
    for j, (record, rows) in enumerate(responses.groupby("record", sort=False), 1):
        parts = {
            str(label): (_window(part), colour)
            for (label, part), colour in zip(rows.groupby("optimizer", sort=False), SERIES, strict=False)
        }
        shown = _shown(rows, parts)
        caption = f"{record}: fit above, simulated minus measured below{shown}."
        fits.append(_fit(folder, f"stage-{number}-fit-{j}", parts, units, caption))
        caption = f"{record}: hysteresis loops, measured and simulated{shown}."
        loops.append(loop(folder, f"stage-{number}-loop-{j}", parts, units=units, caption=caption))
    return fits, loops


def _fit(folder: Path, name: str, parts: Parts, units: Units, caption: str, *, truth: str = "measured") -> Picture:
    """What is to be met and what meets it above, the errors below."""
    measured, _ = next(iter(parts.values()))
    curves = {who: rows["simulated"].to_numpy(dtype=float) for who, (rows, _) in parts.items()}
    caption += within_a_line(curves, "Above, within")

    def draw(figure: Any) -> None:
        upper, lower = figure.subplots(2, 1, sharex=True)
        upper.plot(measured["time"], measured["output"], label=truth, **beneath(len(parts)))
        lower.axhline(0, color=MUTED, linewidth=0.8)
        for place, (who, (rows, colour)) in enumerate(parts.items()):
            upper.plot(rows["time"], rows["simulated"], color=colour, label=who, **stroke(place, len(parts)))
            error = rows["simulated"] - rows["output"]
            lower.plot(rows["time"], error, color=colour, **stroke(place, len(parts), 0.9))
        upper.set_ylabel(named("Output", units, "output"))
        lower.set_ylabel(named("Error", units, "output"))
        lower.set_xlabel(named("Time", units, "time"))
        legend(upper, 3)
        figure.align_ylabels()

    return picture(folder, name, (4.6, 3.6), alt=f"Output over time. {caption}", caption=caption, draw=draw)


def _beginning(rows: pd.DataFrame) -> pd.DataFrame:
    """Of a fast reference the first part: all of it would be a smear."""
    begin, end = float(rows["time"].iloc[0]), float(rows["time"].iloc[-1])
    return rows if end - begin > 1.0 else rows[rows["time"] <= begin + 0.2]


def _window(rows: pd.DataFrame) -> pd.DataFrame:
    """The last CYCLES of a record that has many; all of one that has few."""
    drive = rows["input"].to_numpy(dtype=float)
    starts = np.nonzero((drive[:-1] < 0.0) & (drive[1:] >= 0.0))[0]
    return rows.iloc[starts[-CYCLES - 1] :] if starts.size > 3 * CYCLES else rows


def _shown(rows: pd.DataFrame, parts: Parts) -> str:
    window, _ = next(iter(parts.values()))
    whole = rows[rows["optimizer"] == rows["optimizer"].iloc[0]]
    return f", last {CYCLES} cycles" if len(window) < len(whole) else ""
