"""Maps in opacities of two colours of the palette, one of them below zero: a dark page has its own."""

from __future__ import annotations

from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.report.shared.text import number
from hysteresis_bench.report.shared.theme import GRID, MUTED, SERIES

ABOVE, BELOW = SERIES[0], SERIES[1]
FAINTEST, FULLEST = 0.04, 0.95
"""Opacities of the shades."""
STEPS = 9
"""Shades, about."""
RARE = 1.0
"""Per cent of the values at either end that are drawn like the next ones: an edge of the law must not pale the rest."""

SLIGHT = 0.02
"""Share of the largest value below which values of the other sign have no shade of their own."""


def scale(values: Array) -> Array:
    """Round limits of the shades of these finite values, rising, with 0 among them or at an end."""
    from matplotlib.ticker import MaxNLocator

    low, high = np.percentile(values, (RARE, 100.0 - RARE))
    low, high = min(float(low), 0.0), max(float(high), 0.0)
    largest = max(-low, high) or 1.0
    low, high = (edge if abs(edge) > SLIGHT * largest else 0.0 for edge in (low, high))
    if low == high:
        high = largest
    limits: Array = np.asarray(MaxNLocator(STEPS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    return limits


def shades(limits: Array) -> list[tuple[float, float, float, float]]:
    """A colour between each two limits."""
    from matplotlib.colors import to_rgba

    middles = 0.5 * (limits[1:] + limits[:-1])
    share = np.abs(middles) / np.max(np.abs(middles))
    opacities = FAINTEST + (FULLEST - FAINTEST) * share
    return [to_rgba(ABOVE if at > 0.0 else BELOW, float(part)) for at, part in zip(middles, opacities, strict=True)]


def coloured(axes: Any, limits: Array, colours: list[tuple[float, float, float, float]], label: str) -> None:
    """A bar beside the axes that tells what the shades mean."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm, ListedColormap

    shown = ScalarMappable(BoundaryNorm(limits, len(colours)), ListedColormap(colours))
    every = 1 + len(limits) // 8
    ticks = limits[int(np.argmin(np.abs(limits))) % every :: every]
    bar = axes.figure.colorbar(shown, ax=axes, label=label, shrink=0.9, aspect=16)
    bar.set_ticks(ticks, labels=[number(tick, 3).replace("-", "−") for tick in ticks])
    bar.outline.set_edgecolor(MUTED)
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(length=2)
    bar.ax.grid(visible=False)


def triangle(axes: Any, at: Array, values: Array, label: str) -> None:
    """A map over lower (to the right) and upper values; values : (upper, lower), NaN where lower is above upper."""
    from matplotlib.patches import Polygon

    limits = scale(values[np.isfinite(values)])
    colours = shades(limits)
    whole = np.where(np.isfinite(values), values, values.T)  # the map is cut along the diagonal, not in steps
    drawn = axes.contourf(at, at, np.clip(whole, limits[0], limits[-1]), levels=limits, colors=colours)
    low, high = at[0], at[-1]
    corners = Polygon([(low, low), (low, high), (high, high)], closed=True, fill=False, edgecolor=MUTED, linewidth=0.6)
    axes.add_patch(corners)
    drawn.set_clip_path(corners)
    axes.set(xlim=(low, high), ylim=(low, high), box_aspect=1.0)
    axes.grid(color=GRID)
    coloured(axes, limits, colours, label)
