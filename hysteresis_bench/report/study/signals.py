"""The signals of a study: drive and response, loops, errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pandas as pd

from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.shared.blocks import Block, Figures, Heading
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.signal_figures import DRIVE, drive, errors, loop, measured_loops
from hysteresis_bench.report.shared.text import Units
from hysteresis_bench.report.shared.theme import INK, Picture
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import Results


def section(
    results: Results, here: Sequence[Problem], papers: Sequence[str], *, looks: Mapping[str, Look], folder: Path
) -> Section | None:
    """None where no response was kept."""
    if results.responses.empty:
        return None
    drives: list[Picture] = []
    loops: list[Picture] = []
    residuals: list[Picture] = []
    drawn: list[pd.DataFrame] = []
    for i, problem in enumerate(here, 1):
        rows = results.responses[results.responses["problem"] == problem.name]
        units = results.provenance.get("units", {}).get(problem.name, {})
        labels = shown(problem, papers, rows["optimizer"])
        drives += _drives(folder, i, problem.name, rows, units, drawn)
        for j, ((record, role), part) in enumerate(rows.groupby(["record", "role"], sort=False), 1):
            where, parts = f"{problem.name}, {record} ({role})", {}
            for k, label in enumerate(labels, 1):
                parts[label] = (part[part["optimizer"] == label], looks[label].colour if label in looks else INK)
                if role == "fitted" or label == problem.winner:
                    one, caption = {label: parts[label]}, f"{where}: best trial of {label}."
                    loops.append(loop(folder, f"loop-{i}-{j}-{k}", one, units=units, caption=caption))
            residuals.append(
                errors(folder, f"errors-{i}-{j}", parts, units=units, caption=f"{where}: simulated minus measured.")
            )
    if not drives:
        return None
    blocks: list[Block] = [
        Figures(drives, "small"),
        Heading("Loops of the best trials"),
        Figures(loops, "small"),
        Heading("Errors of the best trials"),
        Figures(residuals),
    ]
    return Section("signals", "Drive and response, loops, errors", blocks)


def shown(problem: Problem, papers: Sequence[str], present: pd.Series) -> list[str]:
    """The paper's optimizers, the reference and the best of a problem, where they are present in any row."""
    wanted = (*papers, problem.reference, problem.winner)
    here = {*problem.labels}.intersection(present.unique())
    return [label for label in dict.fromkeys(wanted) if label in here]


def _drives(
    folder: Path, number: int, problem: str, rows: pd.DataFrame, units: Units, drawn: list[pd.DataFrame]
) -> Iterator[Picture]:
    """Of a problem's records those that are not in `drawn`, which grows; then the loops of all, where one was new."""
    mine = rows[rows["optimizer"] == rows["optimizer"].iloc[0]] if len(rows) else rows
    new = False
    for j, ((record, role), part) in enumerate(mine.groupby(["record", "role"], sort=False), 1):
        one = part[[name for name in ("time", "input", "output", DRIVE) if name in part]].reset_index(drop=True)
        if not any(one.equals(other) for other in drawn):
            drawn.append(one)
            new = True
            yield drive(folder, f"drive-{number}-{j}", one, units=units, caption=f"{record} ({role}).")
    caption = f"{problem}: measured, all records."
    if new and (together := measured_loops(folder, f"measured-{number}", mine, units=units, caption=caption)):
        yield together
