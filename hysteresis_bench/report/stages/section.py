"""What followed a static problem: the linear section, the model check, staged against all at once; published beside."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.paper.published import Table as Printed
from hysteresis_bench.report.shared.blocks import Block, Details, Figures, Heading, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import percent
from hysteresis_bench.report.shared.theme import Picture
from hysteresis_bench.report.stages.figures import feed_forward_figure, loop_figures, stage_figures
from hysteresis_bench.report.stages.rows import mean_error
from hysteresis_bench.report.stages.spread import spread_tables, tuned_table
from hysteresis_bench.report.stages.tables import check, linear_section, tracking, ways
from hysteresis_bench.study.afterwards.stages import LARGEST, RMSE, STAGED
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import StageSpec


@dataclass(frozen=True)
class StageView:
    """One stage as the page shows it.

    spread : over all trials;  tables : of the best trials, on the first instance
    alone : the feed-forward without feedback
    """

    name: str
    sentences: list[str]
    spread: list[Table]
    tables: list[Table]
    fits: list[Picture]
    loops: list[Picture]
    alone: Picture | None
    controlled: list[Picture]


def section(results: Results, published: Published, folder: Path) -> Section | None:
    """None where the study has no stage, or none has run."""
    blocks: list[Block] = []
    for view in stage_views(results, published, folder):
        best: list[Block] = [*view.tables]
        if view.spread:
            best = [*view.spread, Details("The best trial of each, on the first instance", view.tables)]
        blocks += [Heading(view.name), *view.sentences, *best, Figures(view.fits), Figures(view.loops, "small")]
        if view.alone:
            blocks.append(Figures([view.alone], "large"))
        if view.controlled:
            blocks.append(Details("Closed loops on the rig, as the paper’s Figure 15", [Figures(view.controlled)]))
    return Section("stages", "The linear section, and the whole model", blocks) if blocks else None


def stage_views(results: Results, published: Published, folder: Path) -> list[StageView]:
    """Every stage of the study; none where it has none."""
    if results.stages.empty:
        return []
    return [_view(i, spec, results, published, folder) for i, spec in enumerate(results.study.stage, 1)]


def _view(i: int, spec: StageSpec, results: Results, published: Published, folder: Path) -> StageView:
    rows = results.stages[results.stages["stage"] == spec.name]
    units = results.provenance.get("units", {}).get(spec.after, {})
    unit = units.get("output", "1")
    checked = [table for table in published.tables.values() if "record" in table.columns] if spec.check else []
    tables = [linear_section(spec, rows, published if spec.check else Published())]
    if spec.check:
        tables += [check(spec, rows, checked, quantity=quantity, unit=unit) for quantity in (LARGEST, RMSE)]
    if spec.check and spec.beside:
        tables.append(ways(spec, rows, unit))
    if spec.control:
        tables.append(tracking(spec, rows, published, unit=unit))
    drawn = results.responses
    mine = drawn if drawn.empty else drawn[drawn["problem"] == spec.name]
    fits, loops = stage_figures(folder, i, mine, units=units)
    controlled = loop_figures(folder, i, mine, units=units)
    staged = results.staged if results.staged.empty else results.staged[results.staged["stage"] == spec.name]
    spread = spread_tables(spec, staged, published if spec.check else Published(), unit)
    constants = tuned_table(spec, staged, published)
    (spread or tables).extend([constants] if constants else [])
    alone = feed_forward_figure(folder, i, mine, units=units)
    return StageView(spec.name, list(_sentences(spec, rows, checked)), spread, tables, fits, loops, alone, controlled)


def _sentences(spec: StageSpec, rows: pd.DataFrame, checked: list[Printed]) -> Iterator[str]:
    yield (
        f"After “{spec.after}”: the static section is held at the best trial of each, and {', '.join(spec.fit)} are "
        f"fitted to {', '.join(spec.fitted)} by least squares on the output, started from a linear regression on "
        "filtered signals."
    )
    faults = rows[rows["fault"].notna()][["optimizer", "way", "fault"]].drop_duplicates()
    for _, row in faults.iterrows():
        yield f"{row['optimizer']}, {row['way']}: {row['fault']}. What would follow from it has no number here."
    if not spec.check or len(spec.optimizers) < 2:
        return
    first, second = spec.optimizers[:2]
    for quantity, column in ((LARGEST, "error"), (RMSE, "rmse")):
        ours = [mean_error(spec, rows, label, way=STAGED, quantity=quantity) for label in (first, second)]
        if None in ours:
            continue
        said = f"Mean {quantity} over the {len(spec.check)} signals, of the best trials on the first instance: "
        said += _less(first, second, ours)
        for table in checked:
            names = [f"{label}_{column}" for label in (first, second)]
            if set(names) <= set(table.columns):
                printed = [float(np.mean(np.array(table.columns[name], dtype=float))) for name in names]
                said += f"; in the paper, by its own entries, {_less(first, second, printed)}"
        yield f"{said}."
    if spec.beside:
        yield from _which_way(spec, rows)


def _which_way(spec: StageSpec, rows: pd.DataFrame) -> Iterator[str]:
    means = {}
    for way in (STAGED, spec.beside or ""):
        labels = rows[rows["way"] == way]["optimizer"].drop_duplicates()
        means[way] = mean_error(spec, rows, labels.iloc[-1], way=way, quantity=RMSE) if len(labels) else None
    staged, together = means.values()
    if staged and together:
        better = "lowers" if together < staged else "raises"
        yield (
            f"Fitting all at once (best of all trials) {better} the mean {RMSE} on these signals by "
            f"{percent(abs(1 - together / staged), 2)} against the stages."
        )


def _less(first: str, second: str, values: list[Any]) -> str:
    change = 1.0 - values[0] / values[1]
    if abs(change) < 5e-4:
        return f"{first} and {second} are equal to 0.05 %"
    return f"{first}'s is {percent(abs(change), 3)} {'lower' if change > 0 else 'higher'} than {second}'s"
