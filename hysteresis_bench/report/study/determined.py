"""What the data determine: standard errors at the best of all trials, and profiles of single parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.fit.least_squares import at_bound
from hysteresis_bench.parameters import Space
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Figures, Heading, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, listed, number, percent, to_its_error, unit_cell
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture
from hysteresis_bench.report.study.recovered import recovered
from hysteresis_bench.report.trials.best_known import EXACT
from hysteresis_bench.study.problems import boxed, build_system
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import ProblemSpec

LIMIT = NormalDist().inv_cdf(0.975) ** 2
"""95 % quantile of chi-square with one degree of freedom, for uncorrelated residuals."""
WELL = 0.2
"""Standard error over the value up to which a parameter is well determined. Ours: of the kept results 29 % and more are
named and 17 % are not; at half of it those from 10 to 17 % were named, too, at twice of it 30 and 34 % were not."""


def section(results: Results, folder: Path) -> Section | None:
    """Every problem that was analysed: what a user must know before believing the parameters."""
    blocks: list[Block] = [
        "At the best of all trials, polished locally. A parameter without standard error cannot be told from these "
        "records: other values, with others changed to suit, fit as well."
    ]
    for i, spec in enumerate(results.study.problem, 1):
        analysis = results.identifiability.get(spec.name)
        if analysis is not None:
            blocks += [Heading(spec.name), *_of_problem(folder, i, spec, analysis)]
    return Section("determined", "What the data determine", blocks) if len(blocks) > 1 else None


def _of_problem(folder: Path, number: int, spec: ProblemSpec, analysis: Mapping[str, Any]) -> Iterator[Block]:
    """Sentences, table, who recovers a known truth, profiles; number : in the names of figures"""
    problem = spec.name
    if "fault" in analysis:
        yield Bullets([analysis["fault"]])
    else:
        yield Bullets([*analysis["sentences"], *how_well(analysis)])
        yield _table(problem, analysis, _at_bounds(spec, analysis))
    if analysis.get("recovery"):
        yield recovered(problem, analysis["recovery"])
    if profiles := analysis.get("profiles"):
        drawn = [_profile(folder, f"profile-{number}-{j}", problem, p, analysis) for j, p in enumerate(profiles, 1)]
        yield Figures(drawn, "small")


def how_well(analysis: Mapping[str, Any]) -> Iterator[str]:
    """What the standard errors say: which parameters are known to more than WELL of their value, or that none is.

    analysis : of a problem, see Results.identifiability; a parameter whose error is None is told elsewhere
    """
    shares = dict(sorted(_shares(analysis).items(), key=lambda pair: pair[1]))
    yield from (f"{name} is known to {percent(each, 2)} only." for name, each in shares.items() if WELL < each <= 1.0)
    if lost := [name for name, each in shares.items() if each > 1.0]:
        yield f"The standard error of {listed(lost)} is larger than the value{'s' * (len(lost) > 1)}."
    if not analysis["sentences"] and shares and max(shares.values()) <= WELL:
        name, least = list(shares.items())[-1]
        how = f"; the least of them, {name}, to {percent(least, 2)}" if least > EXACT else ""
        yield f"All parameters are well determined{how}."


def _shares(analysis: Mapping[str, Any]) -> dict[str, float]:
    """Standard error over value, of the parameters that have both."""
    found = zip(analysis["names"], analysis["values"], analysis["standard_errors"], strict=True)
    return {name: abs(error / value) for name, value, error in found if error is not None and value}


def _at_bounds(spec: ProblemSpec, analysis: Mapping[str, Any]) -> list[str]:
    """Parameters at an end of their box, as far as the box is known without the data."""
    if registry.faults("models", spec.model, spec.settings):
        return []
    parameters, faults = boxed(build_system(spec.model, spec.settings, fixed=spec.fixed).parameters, spec)
    found = dict(zip(analysis["names"], analysis["values"], strict=True))
    known = [each for each in parameters if each.name in found and (spec.box == "model" or each.name in spec.bounds)]
    if faults or not known:
        return []
    values = np.array([found[parameter.name] for parameter in known], dtype=float)
    edges = at_bound(Space(tuple(known)), values)
    return [parameter.name for parameter, edge in zip(known, edges, strict=True) if edge]


def _table(problem: str, analysis: Mapping[str, Any], at_bounds: list[str]) -> Table:
    rows: list[list[str | Cell]] = []
    for name, unit, value, error in zip(
        analysis["names"], analysis["units"], analysis["values"], analysis["standard_errors"], strict=True
    ):
        share = None if error is None or value == 0 else abs(error / value)
        tone = "bad" if share is not None and share > 1.0 else ""
        shown: list[str | Cell] = [Cell("none", "bad"), NONE]
        if error is not None:
            shown = [number(error, 2), Cell(percent(share, 2), tone)]
        best = Cell(to_its_error(value, error), "bad" if name in at_bounds else "")
        rows.append([name, best, *shown, unit_cell(unit)])
    note = f"The output sees {analysis['rank']} of {len(analysis['names'])} directions of the parameters; "
    note += f"{analysis['determined']} of them are known above the noise."
    if at_bounds:
        note += f" At an end of the box: {listed(at_bounds)}. A wider box might hold a better fit."
    header = ["Parameter", "Best of all trials", "Standard error", "Of the value", "Unit"]
    return Table(f"{problem}: what the data determine", header, rows, note)


def _profile(folder: Path, name: str, problem: str, profile: Mapping[str, Any], analysis: Mapping[str, Any]) -> Picture:
    grid, ratio = np.array(profile["grid"], dtype=float), np.array(profile["ratio"], dtype=float)
    unit = dict(zip(analysis["names"], analysis["units"], strict=True)).get(profile["name"], "1")

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.axhline(LIMIT, color=MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.plot(grid, ratio, "o-", color=SERIES[0], markersize=3)
        if grid.min() > 0 and grid.max() > 20 * grid.min():
            axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=10.0)
        axes.set_ylim(0, max(10.0, 1.2 * float(ratio.max())))
        axes.set(xlabel=profile["name"] + ("" if unit == "1" else f" ({unit})"), ylabel="Likelihood ratio")

    caption = f"{problem}: how much worse the best fit becomes with {profile['name']} held; below the dotted line "
    caption += "a value is within the 95 % interval, if residuals are uncorrelated."
    return picture(
        folder, name, (3.4, 2.6), alt=f"Profile likelihood of {profile['name']}.", caption=caption, draw=draw
    )
