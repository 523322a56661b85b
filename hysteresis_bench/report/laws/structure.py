"""What the data say of the law before any is fitted: the table of the structure tests, and a small picture of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.structure.curves import FILE, Curve
from hysteresis_bench.report.shared.blocks import Block, Cell, Figures, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, Units, named, number, p_equals, sentence
from hysteresis_bench.report.shared.theme import GRID, MUTED, SERIES, Picture, legend, picture

WIDTH, HEIGHT, STRIP = 3.1, 2.1, 0.8
"""Of a small picture, inches, and how much higher it is with the strip of differences."""
GROWTH, SENSE = "growth of the area", "sense"

Findings = Sequence[Mapping[str, Any]]
"""Of the tests, as `Finding.as_dict` tells them."""


def structure_section(folder: Path, findings: Findings, curves: Mapping[str, Sequence[Curve]], units: Units) -> Section:
    """The table, and a picture of every test that the data allow; curves : by the tests' names"""
    shown = [
        _small(folder, finding, curves[finding["test"]], units)
        for finding in findings
        if finding["applies"] and curves.get(finding["test"])
    ]
    blocks: list[Block] = [_table(findings), *([Figures(shown, "small")] if shown else [])]
    return Section("structure", "What the data say before any fit", blocks)


def _table(findings: Findings) -> Table:
    """A row a test, with its consequence or why the data do not allow it."""
    rows: list[list[str | Cell]] = [
        [
            Cell(finding["test"], "line"),
            number(finding["statistic"], 2) + ("\u202f%" if finding["unit"] else "") if finding["applies"] else NONE,
            number(finding["p_value"], 2) if finding["applies"] else NONE,
            Cell(sentence(finding["words"]), "prose" if finding["applies"] else "prose quiet"),
        ]
        for finding in findings
    ]
    return Table(
        "Structure of the data",
        ["Asked for", "Statistic", "p", "What follows"],
        rows,
        note="Differences are RMS, in % of the output's range; of the sense, the enclosed area over the rectangle "
        "around the loop; of the growth, its exponent. p is that of the measured noise alone.",
    )


def _small(folder: Path, finding: Mapping[str, Any], curves: Sequence[Curve], units: Units) -> Picture:
    """The curves that a test compares, moved onto each other, and below them what they differ by."""
    apart, name = any(curve.apart.size for curve in curves), finding["test"]

    def draw(figure: Any) -> None:
        upper, *strip = figure.subplots(1 + apart, 1, sharex=True, squeeze=False, height_ratios=(5, 2)[: 1 + apart])[
            :, 0
        ]
        if name == GROWTH:
            _powers(upper, curves, float(finding["statistic"]))
        else:
            _curves(upper, curves)
            upper.locator_params(axis="x", nbins=5)
        upper.set_ylabel(_upwards(finding, units))
        for lower in strip:
            if finding.get("noise") is not None:
                lower.axhspan(-2.0 * finding["noise"], 2.0 * finding["noise"], color=GRID, linewidth=0)
            _curves(lower, [Curve(curve.x, curve.apart) for curve in curves])
            lower.set_ylabel("apart (%)")
            lower.locator_params(axis="y", nbins=3)
        (strip or [upper])[-1].set_xlabel(_along(finding, units))
        figure.align_ylabels()

    caption = f"{sentence(name)[:-1]}: {_verdict(finding)}."
    caption += " Below: what each differs by; shaded: twice the noise." if apart else ""
    size = WIDTH, HEIGHT + STRIP * apart
    drawn = picture(folder, f"structure {name}", size, alt=finding["words"], caption=caption, draw=draw)
    return replace(drawn, data=FILE)


def _curves(axes: Any, curves: Sequence[Curve]) -> None:
    for place, curve in enumerate(curves):
        label = None if curve.name.isdigit() else curve.name or None
        alone = "." if curve.x.size == 1 else ""
        axes.plot(curve.x, curve.y, alone + "-", color=SERIES[place % len(SERIES)], linewidth=1.0, label=label)
    if any(axes.get_legend_handles_labels()):
        legend(axes)


def _powers(axes: Any, curves: Sequence[Curve], statistic: float) -> None:
    """Points, and the power of the amplitude that they follow, on logarithmic axes that tell two values each."""
    from matplotlib.ticker import NullLocator

    axes.set_xscale("log")
    axes.set_yscale("log")
    for curve in curves:
        x = curve.x[[0, -1]]
        through = (curve.y / curve.x**statistic).mean()
        axes.plot(x, through * x**statistic, color=MUTED, linewidth=1.0)
        axes.plot(curve.x, curve.y, "o", color=SERIES[0], markersize=3)
        for axis, values in ((axes.xaxis, curve.x), (axes.yaxis, curve.y)):
            axis.set_minor_locator(NullLocator())
            axis.set_ticks(ends := [float(values.min()), float(values.max())], [number(end, 2) for end in ends])


def _upwards(finding: Mapping[str, Any], units: Units) -> str:
    if finding["test"] == "reversal lag":
        return "share of the way"
    return "area" if finding["test"] == GROWTH else named("output", units, "output")


def _along(finding: Mapping[str, Any], units: Units) -> str:
    along = finding["along"]
    return named(along, units, "time" if along.startswith("time") else "input")


def _verdict(finding: Mapping[str, Any]) -> str:
    """The statistic with its p, and what the test is about: the data refute the property or they do not."""
    value, p = number(finding["statistic"], 2), p_equals(finding["p_value"])
    if finding["test"] == GROWTH:
        return f"exponent {value}, {p} of the 2 of what merely scales"
    if finding["test"] == SENSE:
        return f"{value}\u202f% of the rectangle around the loops, {p}"
    if finding["test"] == "reversal lag":
        return f"{value}\u202f% of the range, {p}, {'a lag is there' if finding['refutes'] else 'no lag is seen'}"
    return f"{value}\u202f% of the range, {p}, {'refuted' if finding['refutes'] else 'not refuted'}"
