"""What the law of a fitted model remembers, as a picture: its density where it is a sum of plays, else its Everett
function, each with its numbers in a file beside the page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.inspection.memory import Density, Everett, density, everett, fitted_range, ways
from hysteresis_bench.kernels.turning_points import turning_points
from hysteresis_bench.report.laws.maps import SLIGHT, coloured, scale, shades, triangle
from hysteresis_bench.report.shared.blocks import Figures
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import Units, listed, named, number
from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, Picture, picture

PLACES = 60
"""Of the input, at which a density is drawn."""
STILL = 0.01
"""Share of the input's range up to which movements are no way of their own."""
SIZE = (4.3, 3.7)
"""Of a map, inches."""
DENSITY, EVERETT = "density.csv", "everett.csv"
HEADING = "What the law remembers"
NEEDS = {"return-point": "return-point memory", "congruent": "congruent loops"}
"""Properties by which first-order reversal curves tell all."""


def memory_section(folder: Path, fitted: FittedModel, inputs: Sequence[Array]) -> Section | None:
    """None where the law depends on time, or the model does not say over which input it was fitted.

    inputs : (samples,) of the fitted records each, as they are measured
    """
    for name in (DENSITY, EVERETT):  # of another law, fitted before
        (folder / name).unlink(missing_ok=True)
    ends = fitted_range(fitted)
    if ends is None:
        return None
    edges = np.linspace(*ends, PLACES + 1)
    if (found := density(fitted, 0.5 * (edges[1:] + edges[:-1]))) is not None:
        return Section("memory", HEADING, [Figures([_density(folder, fitted, found, edges)])])
    if (surface := everett(fitted, ends)) is None:
        return None
    return Section("memory", HEADING, [Figures(_surfaces(folder, fitted, surface, inputs))])


def _density(folder: Path, fitted: FittedModel, found: Density, edges: Array) -> Picture:
    """Bars over the thresholds, or a map over the thresholds and the input."""
    many, units = found.weights.shape[1] > 1, fitted.units
    middles = 0.5 * (edges[1:] + edges[:-1])
    low, high = edges[0], edges[-1]
    reached = np.ones_like(found.weights, dtype=bool)
    if many:  # a play stays its half-width away from the ends of the input
        inside = 0.5 * (high - low) - np.abs(middles - 0.5 * (low + high))
        reached = found.thresholds[:, None] <= inside
    weights = np.where(reached, found.weights, np.nan)
    table = pd.DataFrame(
        {
            "threshold": np.repeat(found.thresholds, weights.shape[1]),
            **({"input": np.tile(middles, len(weights))} if many else {}),
            "weight": weights.ravel(),
        }
    )
    write_table(folder / DENSITY, table.dropna(), digits=6)
    unit = _unit(units, 1)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        if many:
            _rows(axes, found.thresholds, weights, edges, unit)
            axes.set(xlabel=named("Output of the play", units, "input"), ylabel=named("Threshold", units, "input"))
            axes.set_xlim(low, high)
        else:
            _bars(axes, found.thresholds, weights[:, 0])
            axes.set(xlabel=named("Threshold", units, "input"), ylabel=f"Weight ({unit})")
        axes.set_ylim(*_with_zero(axes.get_ylim()))

    caption = (
        f"Memory of {fitted.model}, without the effects around it: {found.meaning} ({unit}), over its half-width"
        f"{' and over where it is' if many else ''}. The part without memory is not in it."
        f"{' Blank: what no input of the fitted range reaches.' if many else ''}"
    )
    heaviest = int(np.nanargmax(np.nanmax(np.abs(weights), axis=1)))
    alt = f"{len(weights)} thresholds up to {number(found.thresholds[-1], 3)}; the largest weight is "
    alt += f"{number(np.nanmax(np.abs(weights)), 3)}, at {number(found.thresholds[heaviest], 3)}."
    drawn = picture(folder, "memory-density", (4.6, 3.2 if many else 2.8), alt=alt, caption=caption, draw=draw)
    return _with_data(drawn, DENSITY)


def _bars(axes: Any, thresholds: Array, weights: Array) -> None:
    width = 0.8 * np.min(np.diff(thresholds, prepend=0.0))
    colours = [SERIES[0] if weight >= 0.0 else SERIES[1] for weight in weights]
    axes.bar(thresholds, weights, width=width, color=colours, zorder=3)
    axes.axhline(0.0, color=MUTED, linewidth=0.7)
    axes.grid(axis="x", visible=False)


def _rows(axes: Any, thresholds: Array, weights: Array, edges: Array, unit: str) -> None:
    """A row of colours a threshold; neighbours of one shade are one rectangle."""
    levels = scale(weights[np.isfinite(weights)])
    colours = shades(levels)
    borders = np.interp(np.arange(-0.5, len(thresholds)), np.arange(len(thresholds)), thresholds)
    borders[0] = max(2.0 * thresholds[0] - borders[1], 0.0)
    borders[-1] = 2.0 * thresholds[-1] - borders[-2]
    for row, (low, high) in enumerate(pairwise(borders)):
        known = np.isfinite(weights[row])
        shade = np.where(known, np.clip(np.searchsorted(levels, weights[row]) - 1, 0, len(colours) - 1), -1)
        starts = np.flatnonzero(np.diff(shade, prepend=-2))
        for begin, end in zip(starts, [*starts[1:], shade.size], strict=True):
            if shade[begin] >= 0:
                span, left = edges[end] - edges[begin], edges[begin]
                axes.barh(low, span, high - low, left, align="edge", color=colours[shade[begin]], linewidth=0)
    coloured(axes, levels, colours, f"Weight ({unit})")


def _surfaces(folder: Path, fitted: FittedModel, found: Everett, inputs: Sequence[Array]) -> list[Picture]:
    """The Everett function, and the density that it has."""
    units, levels = fitted.units, found.levels
    middles, mixed = found.density
    _write(folder / EVERETT, found)
    law = f"{fitted.model}, without the effects around it"
    told = (
        f"Everett function of {law}: half of what the output falls where the input has risen from the lower end of "
        "its fitted range to the upper reversal, and goes back to the lower one. Lines: where the fitted records went; "
        "between them the law infers."
    )
    lacks = [word for key, word in NEEDS.items() if key not in fitted.system.model.properties]
    whole = f"A law without {listed(lacks)} does more than they tell." if lacks else "They tell all that it remembers."
    of_density = (
        "The density that follows, minus the mixed derivative: small loops lie near the diagonal, on which lies what "
        f"has no memory, wide ones at the upper left. {whole}"
        f"{' Below zero: loops that run clockwise.' if np.nanmin(mixed) < -SLIGHT * np.nanmax(np.abs(mixed)) else ''}"
    )
    drawn = [
        _surface(folder, "everett", (levels, found.values, _unit(units, 0)), units, told, inputs),
        _surface(folder, "everett-density", (middles, mixed, _unit(units, 2)), units, of_density, ()),
    ]
    return [_with_data(one, EVERETT) for one in drawn]


def _surface(
    folder: Path, name: str, shown: tuple[Array, Array, str], units: Units, caption: str, inputs: Sequence[Array]
) -> Picture:
    at, values, unit = shown

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        triangle(axes, at, values, unit)
        axes.plot(*_lines(inputs), color=INK, linewidth=0.6, alpha=0.55)
        axes.set(xlabel=named("Lower reversal", units, "input"), ylabel=named("Upper reversal", units, "input"))

    known = values[np.isfinite(values)]
    alt = f"{caption} From {number(known.min(), 3)} to {number(known.max(), 3)} {unit}."
    return picture(folder, name, SIZE, alt=alt, caption=caption, draw=draw)


def _lines(inputs: Sequence[Array]) -> tuple[list[float], list[float]]:
    """The ways of the inputs in the half plane: lower and upper reversals, with gaps between the ways."""
    span = max((float(np.ptp(u)) for u in inputs), default=0.0)
    gone: dict[tuple[float, bool], tuple[float, float]] = {}
    for u in inputs:
        turns = turning_points(np.ascontiguousarray(u, dtype=float), STILL * span)
        for begun, *way in ways([u[0], *u[turns], u[-1]]):
            key = round(begun / (STILL * span)) * STILL * span, way[1] > way[0]
            low, high = gone.get(key, (np.inf, -np.inf))
            gone[key] = min(low, *way), max(high, *way)
    lower: list[float] = []
    upper: list[float] = []
    for (begun, rising), (low, high) in gone.items():
        lower += [begun, begun, np.nan] if rising else [low, high, np.nan]
        upper += [low, high, np.nan] if rising else [begun, begun, np.nan]
    return lower, upper


def _write(path: Path, found: Everett) -> None:
    """A row a point of the half plane, and a row a square in it that has a density."""
    parts = [("everett", found.levels, found.values), ("density", *found.density)]
    tables = []
    for quantity, at, values in parts:
        upper, lower = (grid.ravel() for grid in np.meshgrid(at, at, indexing="ij"))
        tables.append(pd.DataFrame({"quantity": quantity, "upper": upper, "lower": lower, "value": values.ravel()}))
    write_table(path, pd.concat(tables).dropna(), digits=6)


def _with_data(drawn: Picture, name: str) -> Picture:
    return replace(drawn, data=name)


def _with_zero(ends: tuple[float, float]) -> tuple[float, float]:
    return min(ends[0], 0.0), max(ends[1], 0.0)


def _unit(units: Units, power: int) -> str:
    """Of the output over a power of the input; a quantity without a unit goes by its own name."""
    above, below = (named("", units, key).strip(" ()") or key for key in ("output", "input"))
    return f"{above}/{below}{'²' if power == 2 else ''}" if power else above
