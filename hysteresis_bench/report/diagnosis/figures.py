"""Figures of a diagnosis: the error from bare model to noise, loops and residuals before and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from hysteresis_bench.report.shared.papers import COLUMN
from hysteresis_bench.report.shared.text import Units, named, number
from hysteresis_bench.report.shared.theme import GRID, INK, MUTED, SERIES, Picture, legend, numbers_beside, picture

WITHOUT, BEFORE, AFTER, NOISE, HELD_OUT = MUTED, SERIES[1], SERIES[0], SERIES[2], SERIES[3]

CUT = 3.0
"""Times the largest of the other errors from where the polynomial's bar is cut: the effects must stay visible."""


VISIBLE = 0.01
"""Share of what is drawn below which a band is no wider than a line."""


class Bar(NamedTuple):
    """fitted : RMSE on the fitted records;  unseen : on what was not fitted, where it is told"""

    label: str
    fitted: float
    colour: str
    unseen: float | None = None


def bars_of(steps: Sequence[tuple[str, float]], held_out: tuple[float | None, float | None]) -> list[Bar]:
    """Of labels with their RMSE: the bare model, each adopted effect, the noise last; held_out : before and after"""
    (bare, error), *added, (_, noise) = steps
    bars = [Bar(bare, error, BEFORE, held_out[0]), *(Bar(f"+ {label}", rmse, AFTER) for label, rmse in added)]
    return [*bars[:-1], bars[-1]._replace(unseen=held_out[1]), Bar("noise in the data", noise, NOISE)]


def waterfall(folder: Path, bars: Sequence[Bar], *, units: Units, name: str = "waterfall") -> Picture:
    """From the first bar via the law and each adopted effect to the noise, which is the last."""

    def draw(figure: Any) -> None:
        draw_waterfall(figure.add_subplot(), bars, units)

    steps_in_words = ", ".join(f"{bar.label} {bar.fitted:.3g}" for bar in bars)
    without = bars[0].colour == WITHOUT
    begins = "without memory, then of the law alone" if without else "bare model first"
    takes = "the law or the effect" if without else "the effect"
    caption = (
        f"Error on the fitted records{':' if without else ','} {begins}, each bar with the effects above it; grey is "
        f"what {takes} takes away. Diamonds: error on what was not fitted. Dashed: the noise in the data."
        f"{' The bar with an arrow goes on.' if _end(bars) < bars[0].fitted else ''}"
    )
    height = 1.25 + 0.36 * len(bars)
    return picture(folder, name, (5.4, height), alt=f"RMSE step by step: {steps_in_words}.", caption=caption, draw=draw)


def draw_waterfall(axes: Any, bars: Sequence[Bar], units: Units) -> None:
    """The bars of `waterfall`."""
    end, last = _end(bars), len(bars) - 2
    for row, bar in enumerate(bars):
        axes.barh(row, min(bar.fitted, end), height=0.55, color=bar.colour, zorder=3)
        if 0 < row <= last and (above := min(bars[row - 1].fitted, end)) > bar.fitted:
            gain = above - bar.fitted
            axes.barh(row, gain, left=bar.fitted, height=0.55, color=GRID, edgecolor=MUTED, linewidth=0.6, zorder=2)
        if bar.fitted > end:
            axes.plot(end, row, ">", color=bar.colour, markersize=11, zorder=3, clip_on=False)
        if bar.unseen is not None and bar.unseen <= end:
            edge = {
                "markersize": 7.5,
                "markeredgecolor": "white",
                "markeredgewidth": 1.2,
            }  # seen on a bar of any colour
            axes.plot(bar.unseen, row, "D", color=HELD_OUT, zorder=4, clip_on=False, **edge)
    axes.axvline(bars[-1].fitted, color=NOISE, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    columns = [("fitted", INK, {row: number(bar.fitted, 3) for row, bar in enumerate(bars)})]
    if unseen := {row: number(bar.unseen, 3) for row, bar in enumerate(bars) if bar.unseen is not None}:
        columns.append(("not fitted", HELD_OUT, unseen))
    numbers_beside(axes, columns)
    axes.set_yticks(range(len(bars)), [bar.label for bar in bars])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlim(0, 1.03 * end)
    axes.ticklabel_format(axis="x", scilimits=(-3, 5), useMathText=True)
    axes.set_xlabel(named("RMSE", units, "output"))


def _end(bars: Sequence[Bar]) -> float:
    """The largest error, but for a polynomial's that would hide the others."""
    errors = [(bar.colour == WITHOUT, max(bar.fitted, bar.unseen or 0.0)) for bar in bars]
    law = max(error for without, error in errors if not without)
    return max(law, min(max(error for _, error in errors), CUT * law))


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
    """Simulated minus measured of one record, over time and over input, before and after; noise : RMS, shaded."""
    seen = _left(rows)
    thin = 4.0 * noise < VISIBLE * (max(map(max, seen)) - min(map(min, seen)))
    side = "twice the noise to either side"
    band = f"a band of {side} would be thinner than a line" if thin else f"shaded: {side}"

    def drawn(along: str) -> Picture:
        def draw(figure: Any) -> None:
            axes = figure.add_subplot()
            draw_residual(axes, rows, along, noise, units)
            legend(axes)

        told = f"{caption} Simulated minus measured over {along}; {band}."
        return picture(folder, f"{name}-{along}", (COLUMN, 2.6), alt=told, caption=told, draw=draw)

    return [drawn("time"), drawn("input")]


def draw_residual(axes: Any, rows: pd.DataFrame, along: str, noise: float, units: Units) -> None:
    """Simulated minus measured over a column, before and after; noise : RMS, twice of which is shaded"""
    axes.axhspan(-2 * noise, 2 * noise, color=NOISE, alpha=0.22, linewidth=0)
    axes.axhline(0, color=INK, linewidth=0.6)
    for (_, label, colour), left in zip(stages(rows), _left(rows), strict=True):
        axes.plot(rows[along], left, color=colour, linewidth=0.8, label=label)
    axes.set(xlabel=named(along.capitalize(), units, along), ylabel=named("Error", units, "output"))
    axes.locator_params(axis="x", nbins=5)


def _left(rows: pd.DataFrame) -> list[pd.Series]:
    """Simulated minus measured, as everywhere in the reports, of each of the `stages`."""
    return [rows[which] - rows["output"] for which, _, _ in stages(rows)]


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
