"""How figures look: one palette with a light and a dark side, and SVG that follows the page it stands in.

A figure is drawn once, in the light colours, and its file on disk keeps them (it can go into a paper). In a
page every colour becomes a CSS variable, so that the figure follows the reader's light or dark setting.
Hues after Okabe and Ito (2008), told apart by colour-blind readers.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

INK, MUTED, GRID = "#1b2631", "#6b7683", "#dfe3e8"
SERIES = ("#0072b2", "#d55e00", "#009e73", "#b8559a", "#c98a00", "#3f9fd8")

VARIABLES = {INK: "ink", MUTED: "muted", GRID: "grid"} | {
    colour: f"series-{number}" for number, colour in enumerate(SERIES, 1)
}
"""What each colour is called in templates/style.css, where both sides of the palette stand."""

STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "path.simplify_threshold": 0.4,
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.titlesize": 9,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.facecolor": "none",
    "figure.facecolor": "none",
    "text.color": INK,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
}


LEGIBLE = 0.9
"""Pixels a point below which a figure is scrolled, not made smaller: 5.5 inches still fit a phone of 390 pixels."""


WIDE, CHARACTER = 40, 5.5
"""Points: a column of numbers beside rows, at least, and what a character of it takes."""

POINTS, BESIDE = 72, 40
"""Points of an inch; and of a figure's width what stands beside the axes."""
HANDLE, LETTER = 2.4, 5.2
"""Of a legend: the length of its lines in letters' heights, and points that a letter takes."""
AROUND = 8.5 * (HANDLE + 2.8)
"""Points of a legend's column beside its letters."""

WIDEST = 1.6
"""Points by which the first of several lines is wider than the last."""
DASHES: tuple[Any, ...] = ("-", (0, (4, 1.5)), (0, (1.3, 1.3)), (0, (7, 1.5, 1.3, 1.5)), (0, (3, 3)))
"""Of lines above each other, in their order."""


@dataclass(frozen=True)
class Picture:
    """A figure on disk and in the page.

    name : of its file;  alt : what it shows, for who cannot see it;  data : the file beside it that holds its numbers
    """

    name: str
    alt: str
    caption: str
    inline: str
    data: str = ""


def picture(
    folder: Path, name: str, size: tuple[float, float], *, alt: str, caption: str, draw: Callable[[Any], None]
) -> Picture:
    """Draw on a figure of `size` inches, write figures/NAME.svg into the folder, and return both forms.

    name : of the file; what no file name should hold becomes a hyphen
    """
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    from hysteresis_bench.report.shared.log_labels import in_plain_powers
    from hysteresis_bench.report.shared.short_svg import shortened

    name = re.sub(r"[^A-Za-z0-9-]+", "-", name).strip("-")
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": name}):
        figure = Figure(figsize=size)
        draw(figure)
        in_plain_powers(figure)
        canvas = FigureCanvasSVG(figure)
        # savefig lays the figure out, draws it unseen, then draws it: the first and the last are enough
        if layout := figure.get_layout_engine():
            layout.execute(figure)
        figure.set_layout_engine("none")
        text = io.StringIO()
        canvas.print_svg(text, metadata={"Date": None, "Creator": None})  # type: ignore[no-untyped-call]
    svg = shortened(re.sub(r"\s*<metadata>.*?</metadata>", "", text.getvalue(), flags=re.S))
    (folder / "figures").mkdir(exist_ok=True)
    (folder / "figures" / f"{name}.svg").write_text(svg, encoding="utf-8")
    return Picture(name, alt, caption, inline(svg, name, alt))


def inline(svg: str, name: str, alt: str) -> str:
    """A stand-alone SVG -> one that can stand in a page beside others and follows its colours."""
    body = svg[svg.index("<svg") :]
    box = re.search(r'viewBox="([^"]+)"', body)
    assert box is not None
    width = float(box[1].split()[2])
    label = escape(alt, quote=True)
    style = f"max-width: {1.55 * width:.0f}px; --least: {LEGIBLE * width:.0f}px"
    head = f'<svg viewBox="{box[1]}" role="img" aria-label="{label}" style="{style}">'
    body = head + body[body.index(">") + 1 :]
    body = re.sub(r'\bid="([^"]+)"', rf'id="{name}.\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}.\1)", body)
    body = re.sub(r'xlink:href="#([^"]+)"', rf'href="#{name}.\1"', body)
    for colour, variable in VARIABLES.items():
        body = body.replace(colour, f"var(--{variable})")
    return re.sub(r"font: ([0-9.]+px|bold [0-9.]+px)[^;\"]*", r"font: \1 var(--sans)", body)


def legend(axes: Any, columns: int = 2) -> None:
    """Above the axes, in so many columns, and in fewer where the figure has no room for them."""
    labels = axes.get_legend_handles_labels()[1]
    room = POINTS * axes.figure.get_size_inches()[0] - BESIDE
    while columns > 1 and _legend_width(labels, columns) > room:
        columns -= 1
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=columns, borderaxespad=0, handlelength=HANDLE)


def _legend_width(labels: Sequence[str], columns: int) -> float:
    """In points, of a legend that is filled column by column."""
    each, more = divmod(len(labels), columns)
    sizes = [each + (place < more) for place in range(columns)]
    ends = [sum(sizes[: place + 1]) for place in range(columns)]
    parts = [labels[end - size : end] for end, size in zip(ends, sizes, strict=True) if size]
    return sum(LETTER * max(map(len, part)) + AROUND for part in parts)


def stroke(place: int, count: int, width: float = 1.0) -> dict[str, Any]:
    """How a line is drawn that others may cover: the first wide and whole, those above it thinner and dashed, so that
    each is seen through the next. place : 0, 1, ... of `count`;  width : of a line alone, and of the last, in points"""
    if count < 2:
        return {"linewidth": width}
    wider = WIDEST * (count - 1 - place) / (count - 1)
    return {"linewidth": width + wider, "linestyle": DASHES[place % len(DASHES)], "dash_capstyle": "butt"}


def numbers_beside(axes: Any, columns: Sequence[tuple[str, str, Mapping[int, str]]]) -> None:
    """Columns of numbers to the right of rows 0, 1, ... that run downwards; columns : heading, colour, text by row"""
    right = 5.0
    for heading, colour, by_row in columns:
        for row, text in ((-0.7, heading), *by_row.items()):
            at = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points", "annotation_clip": False}
            axes.annotate(text, (1.0, row), (right, 0), color=colour, va="center", fontsize=8, **at)
        right += max(WIDE, CHARACTER * max(map(len, by_row.values()), default=0))


def spread_labels(positions: Sequence[float], gap: float, *, low: float = 0.0, high: float = 1.0) -> list[float]:
    """Positions of labels on an axis, in axes fractions, moved apart to at least `gap` and kept in order."""
    order = sorted(range(len(positions)), key=lambda i: positions[i])
    placed = [min(max(positions[i], low), high) for i in order]
    for k in range(1, len(placed)):
        placed[k] = max(placed[k], placed[k - 1] + gap)
    if placed and placed[-1] > high:
        placed[-1] = high
        for k in range(len(placed) - 2, -1, -1):
            placed[k] = min(placed[k], placed[k + 1] - gap)
    found = [0.0] * len(positions)
    for index, value in zip(order, placed, strict=True):
        found[index] = value
    return found
