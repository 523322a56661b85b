"""What the data determine: standard errors at the best of all trials, and profiles of single parameters."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench.report.shared.page import NONE, Cell, Table, number, percent
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture
from hysteresis_bench.report.study.recovered import recovered
from hysteresis_bench.study.results import Results

LIMIT = 3.841
"""95 % quantile of chi-square with one degree of freedom, for uncorrelated residuals."""


@dataclass(frozen=True)
class Determined:
    """One problem. sentences : what a user must know before believing the parameters; recovered : where the
    truth is known, who found it."""

    problem: str
    sentences: Sequence[str]
    table: Table | None
    profiles: Sequence[Picture]
    recovered: Table | None


def determined(results: Results, folder: Path) -> list[Determined]:
    """Every problem whose identifiability the study has told."""
    found = []
    for i, spec in enumerate(results.study.problem, 1):
        told = results.identifiability.get(spec.name)
        if told is None:
            continue
        known = recovered(spec.name, told["recovery"]) if told.get("recovery") else None
        if "fault" in told:
            found.append(Determined(spec.name, [told["fault"]], None, [], known))
            continue
        profiles = [_profile(folder, f"profile-{i}-{j}", spec.name, p, told) for j, p in enumerate(told["profiles"], 1)]
        sentences = told["sentences"] or ["All parameters are well determined."]
        found.append(Determined(spec.name, sentences, _table(spec.name, told), profiles, known))
    return found


def _table(problem: str, told: Mapping[str, Any]) -> Table:
    rows: list[list[str | Cell]] = []
    for name, unit, value, error in zip(
        told["names"], told["units"], told["values"], told["standard_errors"], strict=True
    ):
        share = None if error is None or value == 0 else abs(error / value)
        tone = "bad" if share is not None and share > 1.0 else ""
        shown: list[str | Cell] = [Cell("none", "bad"), NONE]
        if error is not None:
            shown = [number(error, 2), Cell(percent(share, 2), tone)]
        rows.append([name, number(value, 6), *shown, "" if unit == "1" else unit])
    note = f"The output sees {told['rank']} of {len(told['names'])} directions of the parameters; {told['determined']} "
    note += "of them are known above the noise."
    header = ["Parameter", "Best of all trials", "Standard error", "Of the value", "Unit"]
    return Table(f"{problem}: what the data determine", header, rows, note)


def _profile(folder: Path, name: str, problem: str, told: Mapping[str, Any], all_: Mapping[str, Any]) -> Picture:
    grid, ratio = np.array(told["grid"], dtype=float), np.array(told["ratio"], dtype=float)
    unit = dict(zip(all_["names"], all_["units"], strict=True)).get(told["name"], "1")

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(LIMIT, color=MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.plot(grid, ratio, "o-", color=SERIES[0], markersize=3)
        if grid.min() > 0 and grid.max() > 20 * grid.min():
            axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=10.0)
        axes.set_ylim(0, max(10.0, 1.2 * float(ratio.max())))
        axes.set(xlabel=told["name"] + ("" if unit == "1" else f" ({unit})"), ylabel="Likelihood ratio")

    caption = f"{problem}: how much worse the best fit becomes with {told['name']} held; below the dotted line "
    caption += "a value is within the 95 % interval, if residuals are uncorrelated."
    name = re.sub(r"[^A-Za-z0-9-]+", "-", name)
    return picture(folder, name, (3.4, 2.6), f"Profile likelihood of {told['name']}.", caption, draw)
