"""What the data say of the law before any is fitted: the table of the structure tests, and a small picture of each."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.structure.finding import Finding
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import NONE, Units, named, number
from hysteresis_bench.report.shared.theme import SERIES, Picture, picture

SIZE = (3.1, 2.1)
"""Of a small picture, inches."""


def structure_table(findings: Sequence[Finding]) -> Table:
    """A row a test, with its consequence or why the data do not allow it."""
    rows: list[list[str | Cell]] = [
        [
            Cell(finding.name, "line"),
            number(finding.statistic, 2) + ("\u202f%" if finding.unit else "") if finding.applies else NONE,
            number(finding.p, 2) if finding.applies else NONE,
            Cell(_sentence(finding.words), "prose" if finding.applies else "prose quiet"),
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


def structure_figures(folder: Path, findings: Sequence[Finding], units: Units) -> list[Picture]:
    """The curves that each test compares, of those that the data allow."""
    return [_small(folder, finding, units) for finding in findings if finding.applies and finding.curves]


def _small(folder: Path, finding: Finding, units: Units) -> Picture:
    grows = finding.along == "amplitude"

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for number_, (x, y) in enumerate(finding.curves):
            axes.plot(x, y, "o" if grows else "-", color=SERIES[number_ % len(SERIES)], linewidth=1.0, markersize=3)
        if grows:
            axes.set_xscale("log")
            axes.set_yscale("log")
        axes.set_xlabel(named(finding.along, units, "input"))
        axes.set_ylabel("area" if grows else named("output", units, "output"))

    caption = f"{_sentence(finding.name)}: {_verdict(finding)}."
    return picture(folder, f"structure {finding.name}", SIZE, alt=finding.words, caption=caption, draw=draw)


def _verdict(finding: Finding) -> str:
    if finding.name in ("sense", "growth of the area"):
        return f"{number(finding.statistic, 2)}{finding.unit and ' % of the rectangle'}"
    return f"{number(finding.statistic, 2)} % of the range, {'refuted' if finding.refutes else 'not refuted'}"


def _sentence(words: str) -> str:
    return words[0].upper() + words[1:]
