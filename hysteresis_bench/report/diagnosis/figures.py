"""Figures of a diagnosis: the error from bare model to noise, loops and residuals before and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.report.shared.papers import COLUMN
from hysteresis_bench.report.shared.text import Units, named, number
from hysteresis_bench.report.shared.theme import GRID, INK, MUTED, SERIES, Picture, legend, numbers_beside, picture

BEFORE, AFTER, NOISE, HELD_OUT = SERIES[1], SERIES[0], SERIES[2], SERIES[3]

Steps = Sequence[tuple[str, float]]
"""Label and RMSE on the fitted records: the bare model, each adopted effect, the noise last."""


def waterfall(
    folder: Path,
    steps: Steps,
    held_out: tuple[float | None, float | None],
    *,
    units: Units,
    name: str = "waterfall",
) -> Picture:
    """From the bare model via each adopted effect to the noise.

    held_out : RMSE before and after, on what was not fitted
    """

    def draw(figure: Any) -> None:
        draw_waterfall(figure.add_subplot(), steps, held_out, units)

    steps_in_words = ", ".join(f"{label} {value:.3g}" for label, value in _named(steps))
    caption = (
        "Error on the fitted records, bare model first, each bar with the effects above it; grey is what the effect "
        "takes away. Diamonds: error on what was not fitted, bare and final."
    )
    height = 1.25 + 0.36 * len(steps)
    return picture(folder, name, (5.4, height), alt=f"RMSE step by step: {steps_in_words}.", caption=caption, draw=draw)


def draw_waterfall(axes: Any, steps: Steps, held_out: tuple[float | None, float | None], units: Units) -> None:
    """The bars of `waterfall`."""
    labels, values = zip(*_named(steps), strict=True)
    last = len(steps) - 2
    for row, value in enumerate(values):
        colour = NOISE if row > last else BEFORE if row == 0 else AFTER
        axes.barh(row, value, height=0.55, color=colour, zorder=3)
        if 0 < row <= last:
            gain = values[row - 1] - value
            axes.barh(row, gain, left=value, height=0.55, color=GRID, edgecolor=MUTED, linewidth=0.6, zorder=2)
    axes.axvline(values[-1], color=NOISE, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    for row, error in ((0, held_out[0]), (last, held_out[1])):
        if error is not None:
            axes.plot(error, row, "D", color=HELD_OUT, markersize=6, zorder=4, clip_on=False)
    columns = [("fitted", INK, {row: number(value, 3) for row, value in enumerate(values)})]
    if any(value is not None for value in held_out):
        unseen = {0: number(held_out[0], 3), last: number(held_out[1], 3)}
        columns.append(("not fitted", HELD_OUT, unseen))
    numbers_beside(axes, columns)
    axes.set_yticks(range(len(labels)), labels)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlim(0, 1.03 * max([*values, *(value for value in held_out if value is not None)]))
    axes.ticklabel_format(axis="x", scilimits=(-3, 5), useMathText=True)
    axes.set_xlabel(named("RMSE", units, "output"))


def _named(steps: Steps) -> list[tuple[str, float]]:
    """The steps with the labels of their bars."""
    (bare, error), *added, (_, noise) = steps
    return [(bare, error), *((f"+ {label}", value) for label, value in added), ("noise in the data", noise)]


def loops(folder: Path, name: str, rows: pd.DataFrame, *, units: Units, caption: str) -> list[Picture]:
    """Output over input of one record, measured and simulated, before and after; one where they are the same."""
    shown = stages(rows)
    outputs = rows[["output", *(column for column, _, _ in shown)]]
    low, high = outputs.min(axis=None), outputs.max(axis=None)
    room = 0.05 * (high - low)

    def drawn(which: str, label: str, colour: str) -> Picture:
        def draw(figure: Any) -> None:
            axes = figure.add_subplot()
            draw_loop(axes, rows, [(which, label, colour)], units)
            axes.set_ylim(low - room, high + room)
            legend(axes)

        told = f"{caption} Measured and {label}."
        return picture(folder, f"{name}-{which}", (COLUMN, 3.0), alt=f"Loop. {told}", caption=told, draw=draw)

    return [drawn(*stage) for stage in shown]


def draw_loop(axes: Any, rows: pd.DataFrame, shown: Sequence[tuple[str, str, str]], units: Units) -> None:
    """Output over input, measured and as the stages have it; shown : of `stages`"""
    axes.plot(rows["input"], rows["output"], color=MUTED, linewidth=2.6, alpha=0.5, label="measured")
    for which, label, colour in shown:
        axes.plot(rows["input"], rows[which], color=colour, linewidth=1.1, label=label)
    axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))


def residuals(
    folder: Path, name: str, rows: pd.DataFrame, *, noise: float, units: Units, caption: str
) -> list[Picture]:
    """Measured minus simulated of one record, over time and over input, before and after; noise : RMS, shaded."""

    def drawn(along: str) -> Picture:
        def draw(figure: Any) -> None:
            axes = figure.add_subplot()
            draw_residual(axes, rows, along, noise, units)
            legend(axes)

        told = f"{caption} Residual over {along}; shaded: twice the noise to either side."
        return picture(folder, f"{name}-{along}", (COLUMN, 2.6), alt=told, caption=told, draw=draw)

    return [drawn("time"), drawn("input")]


def draw_residual(axes: Any, rows: pd.DataFrame, along: str, noise: float, units: Units) -> None:
    """Measured minus simulated over a column, before and after; noise : RMS, twice of which is shaded"""
    axes.axhspan(-2 * noise, 2 * noise, color=GRID, alpha=0.7, linewidth=0)
    axes.axhline(0, color=INK, linewidth=0.6)
    for which, label, colour in stages(rows):
        axes.plot(rows[along], rows["output"] - rows[which], color=colour, linewidth=0.8, label=label)
    axes.set(xlabel=named(along.capitalize(), units, along), ylabel=named("Residual", units, "output"))
    axes.locator_params(axis="x", nbins=5)


def stages(rows: pd.DataFrame) -> list[tuple[str, str, str]]:
    """Column, label and colour of what is drawn; one where nothing was added."""
    if rows["before"].equals(rows["after"]):
        return [("after", "simulated", AFTER)]
    return [("before", "before", BEFORE), ("after", "after", AFTER)]


def family_curve(folder: Path, found: Mapping[str, Any]) -> Picture:
    """The curve of a free form; found : one of the families in diagnosis.json"""
    curve = found["curve"]
    labels = [
        what[:1].upper() + what[1:] + ("" if unit in ("1", "") else f" ({unit})")
        for what, unit in ((curve["along"], curve["x_unit"]), (curve["of"], curve["y_unit"]))
    ]

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(curve["x"], curve["y"], color=AFTER, linewidth=1.6)
        if curve["logarithmic"]:
            axes.set_xscale("log")
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])

    caption = f"{found['effect']}, of the family {found['family']}: what the model has in the place of a formula."
    ends = ", ".join(f"{number(curve['y'][k], 3)} at {number(curve['x'][k], 3)}" for k in (0, len(curve["x"]) // 2, -1))
    alt = f"{labels[1]} over {curve['along']}: {ends}."
    return picture(folder, f"family-{found['effect']}", (4.6, 3.0), alt=alt, caption=caption, draw=draw)
