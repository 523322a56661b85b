"""Figures of signals: drive and response, loops, errors; measured beside simulated. Studies and fits share them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.shared.theme import INK, MUTED, SERIES, Picture, picture

Units = Mapping[str, str]


def named(quantity: str, units: Units, key: str) -> str:
    """An axis label with its unit, where it is known: `Input (°C)`."""
    unit = {"degC": "°C", "deg": "°", "um": "μm"}.get(units.get(key, ""), units.get(key, ""))
    return f"{quantity} ({unit})" if unit not in ("", "1") else quantity


def drive(folder: Path, name: str, rows: pd.DataFrame, units: Units, caption: str) -> Picture:
    """Input and measured output of one record over time."""

    def draw(figure: Any) -> None:
        upper, lower = figure.subplots(2, 1, sharex=True)
        upper.plot(rows["time"], rows["input"], color=SERIES[4], linewidth=1.2)
        lower.plot(rows["time"], rows["output"], color=INK, linewidth=1.2)
        upper.set_ylabel(named("Input", units, "input"))
        lower.set_ylabel(named("Output", units, "output"))
        lower.set_xlabel(named("Time", units, "time"))
        figure.align_ylabels()

    return picture(folder, name, (4.2, 3.2), f"Input and output over time. {caption}", caption, draw)


def loop(
    folder: Path, name: str, rows: pd.DataFrame, units: Units, who: str, caption: str, colour: str = SERIES[1]
) -> Picture:
    """Output over input of one record, measured and simulated."""

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(rows["input"], rows["output"], color=MUTED, linewidth=2.6, alpha=0.55, label="measured")
        axes.plot(rows["input"], rows["simulated"], color=colour, linewidth=1.2, label=who)
        axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=2, borderaxespad=0, handlelength=1.4)

    return picture(folder, name, (3.4, 3.1), f"Hysteresis loop, measured and simulated. {caption}", caption, draw)


def errors(
    folder: Path, name: str, parts: Mapping[str, tuple[pd.DataFrame, str]], units: Units, caption: str
) -> Picture:
    """Simulated minus measured over time, per cent of the largest measured |output|.

    parts : name -> rows of one record and a colour
    """

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(0, color=MUTED, linewidth=0.8)
        for who, (rows, colour) in parts.items():
            axes.plot(rows["time"], relative_error(rows), color=colour, linewidth=1.0, label=who)
        axes.set(xlabel=named("Time", units, "time"), ylabel="Error (% of largest output)")
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=3, borderaxespad=0, handlelength=1.4)

    return picture(folder, name, (4.6, 2.7), f"Error over time. {caption}", caption, draw)


def relative_error(rows: pd.DataFrame) -> np.ndarray:
    """Simulated minus measured, per cent of the largest measured |output|."""
    measured = rows["output"].to_numpy(dtype=float)
    scale = float(np.max(np.abs(measured), initial=0.0)) or 1.0
    return 100.0 * (rows["simulated"].to_numpy(dtype=float) - measured) / scale
