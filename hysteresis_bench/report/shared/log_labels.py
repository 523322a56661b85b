"""Labels of a logarithmic axis as plain text, 10⁻³: a formula takes matplotlib as long to typeset as all else."""

from __future__ import annotations

import re
from typing import Any

from matplotlib.ticker import Formatter, LogFormatterMathtext

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class PlainPowers(Formatter):
    """What another formatter of powers says, as plain text."""

    def __init__(self, formulas: LogFormatterMathtext) -> None:
        self.formulas = formulas

    def __call__(self, value: float, position: int | None = None) -> str:
        formula = self.formulas(value, position).removeprefix(r"$\mathdefault{").removesuffix("}$")
        return (
            re.sub(r"\^\{(.*?)\}", lambda power: power[1].translate(SUPERSCRIPTS), formula)
            .replace(r"\times", "×")
            .replace("-", "−")
        )

    def set_axis(self, axis: Any) -> None:
        self.formulas.set_axis(axis)

    def set_locs(self, locs: Any) -> None:
        self.formulas.set_locs(locs)


def in_plain_powers(figure: Any) -> None:
    """Every axis of the figure."""
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        if isinstance(axis.get_major_formatter(), LogFormatterMathtext):
            axis.set_major_formatter(PlainPowers(axis.get_major_formatter()))
        if isinstance(axis.get_minor_formatter(), LogFormatterMathtext):
            axis.set_minor_formatter(PlainPowers(axis.get_minor_formatter()))
