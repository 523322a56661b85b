"""What followed a static problem: the linear section, the model check, staged against all at once; published beside."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.paper.published import Table as Printed
from hysteresis_bench.report.shared.page import NONE, Cell, Table, number, percent
from hysteresis_bench.report.shared.signal_figures import named
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture
from hysteresis_bench.study.afterwards.stages import FITTED, HELD, LARGEST, RMSE, STAGED, TRACKING
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import StageSpec

PAPERS = "sliding-mode"
"""The controller that is the paper's: equation (15) beside the inverse."""
CYCLES = 3
"""Cycles of a periodic record that a figure shows: all of them would be a smear."""


@dataclass(frozen=True)
class StageView:
    """One stage as the page shows it."""

    name: str
    sentences: list[str]
    tables: list[Table]
    fits: list[Picture]
    loops: list[Picture]


def stage_views(results: Results, published: Published, folder: Path) -> list[StageView]:
    """Every stage of the study; none where it has none."""
    if results.stages.empty:
        return []
    return [_view(i, spec, results, published, folder) for i, spec in enumerate(results.study.stage, 1)]


def of_a_stage(table: Printed, results: Results) -> bool:
    """Does a printed table stand beside ours here, and so not among the others?"""
    fitted = any(set(spec.fit) <= set(table.columns) for spec in results.study.stage)
    tracked = "reference" in table.columns and any(spec.control for spec in results.study.stage)
    return fitted or tracked or (bool(results.study.stage) and "record" in table.columns)


def _view(i: int, spec: StageSpec, results: Results, published: Published, folder: Path) -> StageView:
    rows = results.stages[results.stages["stage"] == spec.name]
    units = results.provenance.get("units", {}).get(spec.after, {})
    unit = units.get("output", "1")
    checked = [table for table in published.tables.values() if "record" in table.columns] if spec.check else []
    tables = [_section(spec, rows, published if spec.check else Published())]
    if spec.check:
        tables += [_check(spec, rows, checked, quantity, unit) for quantity in (LARGEST, RMSE)]
    if spec.check and spec.beside:
        tables.append(_ways(spec, rows, unit))
    if spec.control:
        tables.append(_tracking(spec, rows, published, unit))
    drawn = results.responses
    drawn = drawn[drawn["problem"] == spec.name] if not drawn.empty else drawn
    records = dict(list(drawn.groupby("record", sort=False))) if not drawn.empty else {}
    fits = [_fit(folder, f"stage-{i}-fit-{j}", part, units) for j, part in enumerate(records.values(), 1)]
    loops = [_loop(folder, f"stage-{i}-loop-{j}", part, units) for j, part in enumerate(records.values(), 1)]
    return StageView(spec.name, list(_sentences(spec, rows, checked)), tables, fits, loops)


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
        ours = [_mean(spec, rows, label, STAGED, quantity) for label in (first, second)]
        if None in ours:
            continue
        told = f"Mean {quantity} over the {len(spec.check)} signals: {_less(first, second, ours)}"
        for table in checked:
            names = [f"{label}_{column}" for label in (first, second)]
            if set(names) <= set(table.columns):
                printed = [float(np.mean(np.array(table.columns[name], dtype=float))) for name in names]
                told += f"; in the paper, by its own entries, {_less(first, second, printed)}"
        yield f"{told}."
    if spec.beside:
        yield from _which_way(spec, rows)


def _which_way(spec: StageSpec, rows: pd.DataFrame) -> Iterator[str]:
    means = {}
    for way in (STAGED, spec.beside or ""):
        labels = rows[rows["way"] == way]["optimizer"].drop_duplicates()
        means[way] = _mean(spec, rows, labels.iloc[-1], way, RMSE) if len(labels) else None
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


def _value(rows: pd.DataFrame, label: str, way: str, quantity: str, name: str) -> pd.Series | None:
    found = rows[(rows["optimizer"] == label) & (rows["way"] == way) & (rows["quantity"] == quantity)]
    found = found[found["name"] == name]
    return None if found.empty else found.iloc[0]


def _error(rows: pd.DataFrame, label: str, way: str, quantity: str, name: str) -> float | None:
    found = _value(rows, label, way, quantity, name)
    return None if found is None or pd.isna(found["value"]) else float(found["value"])


def _mean(spec: StageSpec, rows: pd.DataFrame, label: str, way: str, quantity: str) -> float | None:
    errors = [_error(rows, label, way, quantity, record) for record in spec.check]
    return None if None in errors else float(np.mean(np.array(errors, dtype=float)))


def _labels(rows: pd.DataFrame, way: str) -> list[str]:
    return list(rows[rows["way"] == way]["optimizer"].drop_duplicates())


def _section(spec: StageSpec, rows: pd.DataFrame, published: Published) -> Table:
    """The linear section as published and as ours, with standard errors, and what follows from it."""
    printed = next((t.columns for t in published.tables.values() if {"optimizer", *spec.fit} <= set(t.columns)), None)
    header, sides = ["Quantity"], []
    for label in _labels(rows, STAGED):
        if printed and label in printed["optimizer"]:
            place = printed["optimizer"].index(label)
            values = {name: float(printed[name][place]) for name in spec.fit}
            header.append(f"{label}, published")
            sides.append({name: number(value, 7) for name, value in values.items()} | _derived(spec, values))
        mine = rows[(rows["optimizer"] == label) & (rows["way"] == STAGED)]
        of_fit = mine[mine["quantity"] == FITTED].set_index("name")
        header.append(f"{label}, ours" if printed and label in printed["optimizer"] else label)
        side = {name: _with_error(row["value"], row["standard_error"]) for name, row in of_fit.iterrows()}
        values = {str(name): float(value) for name, value in of_fit["value"].items()}
        side |= {} if _fault(mine) else _derived(spec, values)
        held = mine[mine["quantity"] == HELD].set_index("name")["value"]
        side |= {f"{name}, held": number(value, 6) for name, value in held.items()}
        if fault := _fault(mine):
            side["fault"] = fault
        sides.append(side)
    names = list(dict.fromkeys(name for side in sides for name in side))
    cells: list[list[str | Cell]] = [[name, *(_cell(name, side.get(name, NONE)) for side in sides)] for name in names]
    note = f"± standard error, allowing for residuals that are correlated in time. Fitted to {', '.join(spec.fitted)}."
    return Table(f"{spec.name}: the linear section", header, cells, note)


def _fault(rows: pd.DataFrame) -> str:
    return next((str(fault) for fault in rows["fault"].dropna() if fault), "")


def _cell(name: str, text: str) -> Cell:
    return Cell(text, "bad" if name == "fault" and text != NONE else "line")


def _with_error(value: float, error: float) -> str:
    return number(value, 6) if pd.isna(error) else f"{number(value, 6)} ± {number(error, 2)}"


def _derived(spec: StageSpec, values: Mapping[str, float]) -> dict[str, str]:
    gain, damping, stiffness = (values.get(name, math.nan) for name in spec.fit)
    if not (damping > 0.0 and stiffness > 0.0):
        return {}
    omega = math.sqrt(stiffness)
    return {
        "natural frequency, Hz": number(omega / (2.0 * math.pi)),
        "damping ratio": number(damping / (2.0 * omega)),
        "static gain": number(gain / stiffness),
    }


def _check(spec: StageSpec, rows: pd.DataFrame, checked: list[Printed], quantity: str, unit: str) -> Table:
    """Errors on the check's records, published beside ours, with the mean."""
    column = {LARGEST: "error", RMSE: "rmse"}[quantity]
    header, sides = ["Signal"], []
    for label in _labels(rows, STAGED):
        printed = next((t.columns for t in checked if f"{label}_{column}" in t.columns), None)
        if printed:
            header.append(f"{label}, published")
            sides.append(dict(zip(map(str, printed["record"]), map(float, printed[f"{label}_{column}"]), strict=True)))
        header.append(f"{label}, ours" if printed else label)
        ours = {record: _error(rows, label, STAGED, quantity, record) for record in spec.check}
        sides.append({record: value for record, value in ours.items() if value is not None})
    cells: list[list[str | Cell]] = [
        [record, *(number(side.get(record)) for side in sides)] for record in (*spec.fitted, *spec.check)
        if any(record in side for side in sides)
    ]  # fmt: skip
    means = [np.mean(list(side.values())) if set(spec.check) <= set(side) else None for side in sides]
    cells.append([Cell("mean", strong=True), *(Cell(number(mean), strong=True) for mean in means)])
    equation = {LARGEST: "F_error, eq. (12)", RMSE: "F_rmse, eq. (13)"}[quantity] if checked else quantity
    note = "Published means are computed here from the printed entries." if checked else ""
    return Table(f"{spec.name}: {equation}, {named(quantity, {'output': unit}, 'output')}", header, cells, note)


def _ways(spec: StageSpec, rows: pd.DataFrame, unit: str) -> Table:
    """Staged against all at once: rmse on what was fitted and on the check."""
    header, sides = ["Signal"], []
    for way in (STAGED, spec.beside or ""):
        for label in _labels(rows, way):
            header.append(f"{label}, {way}")
            every = {record: _error(rows, label, way, RMSE, record) for record in (*spec.fitted, *spec.check)}
            sides.append(every | {"mean of the check": _mean(spec, rows, label, way, RMSE)})
    cells = [[name, *(number(side[name]) for side in sides)] for name in (sides[0] if sides else {})]
    return Table(f"{spec.name}: staged against {spec.beside}, {named(RMSE, {'output': unit}, 'output')}", header, cells)


def _tracking(spec: StageSpec, rows: pd.DataFrame, published: Published, unit: str) -> Table:
    """Closed loop on the rig, every controller on every reference; the paper's beside its own controller."""
    printed = next((table.columns for table in published.tables.values() if "reference" in table.columns), {})
    here = rows[rows["controller"].notna()]
    pairs = here[["name", "controller"]].drop_duplicates()
    header, cells = ["Reference", "Controller"], []
    for label in spec.control:
        for quantity in TRACKING.values():
            header += [f"{label}, {quantity}, published", "ours"]
    for reference, controller in pairs.itertuples(index=False):
        row: list[str | Cell] = [Cell(reference, "line"), Cell(controller, "line")]
        for label in spec.control:
            for key, quantity in TRACKING.items():
                column = printed.get(f"{label}_{key.removeprefix('t_')}")
                theirs = dict(zip(printed["reference"], column, strict=True)).get(reference) if column else None
                mine = here[(here["name"] == reference) & (here["controller"] == controller)]
                mine = mine[(mine["optimizer"] == label) & (mine["quantity"] == quantity)]["value"]
                row += [number(theirs) if controller == PAPERS else NONE, number(None if mine.empty else mine.iloc[0])]
        cells.append(row)
    note = f"The paper's numbers stand beside {PAPERS}, its own controller; its settings are not known, ours are tuned "
    note += "from the model. Largest and RMS error of the true displacement, where the reference is scored."
    return Table(
        f"{spec.name}: closed loop on the rig, {named('errors', {'output': unit}, 'output')}", header, cells, note
    )


def _window(rows: pd.DataFrame) -> pd.DataFrame:
    """The last CYCLES of a record that has many; all of one that has few."""
    drive = rows["input"].to_numpy(dtype=float)
    starts = np.nonzero((drive[:-1] < 0.0) & (drive[1:] >= 0.0))[0]
    return rows.iloc[starts[-CYCLES - 1] :] if starts.size > 3 * CYCLES else rows


def _windows(rows: pd.DataFrame) -> dict[str, pd.DataFrame]:
    return {str(label): _window(part) for label, part in rows.groupby("optimizer", sort=False)}


def _colours(parts: Mapping[str, Any]) -> dict[str, str]:
    return dict(zip(parts, SERIES, strict=False))


def _fit(folder: Path, name: str, rows: pd.DataFrame, units: Mapping[str, str]) -> Picture:
    """Measured and simulated above, the errors below."""
    parts, record = _windows(rows), str(rows["record"].iloc[0])
    first = next(iter(parts.values()))

    def draw(figure: Any) -> None:
        upper, lower = figure.subplots(2, 1, sharex=True)
        upper.plot(first["time"], first["output"], color=MUTED, linewidth=2.6, alpha=0.55, label="measured")
        lower.axhline(0, color=MUTED, linewidth=0.8)
        for who, colour in _colours(parts).items():
            part = parts[who]
            upper.plot(part["time"], part["simulated"], color=colour, linewidth=1.0, label=who)
            lower.plot(part["time"], part["simulated"] - part["output"], color=colour, linewidth=0.9)
        upper.set_ylabel(named("Output", units, "output"))
        lower.set_ylabel(named("Error", units, "output"))
        lower.set_xlabel(named("Time", units, "time"))
        upper.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=3, borderaxespad=0, handlelength=1.4)
        figure.align_ylabels()

    caption = f"{record}: fit above, simulated minus measured below{_shown(rows, first)}."
    return picture(folder, _plain(name), (4.6, 3.6), f"Measured and simulated output. {caption}", caption, draw)


def _loop(folder: Path, name: str, rows: pd.DataFrame, units: Mapping[str, str]) -> Picture:
    parts, record = _windows(rows), str(rows["record"].iloc[0])
    first = next(iter(parts.values()))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(first["input"], first["output"], color=MUTED, linewidth=2.6, alpha=0.55, label="measured")
        for who, colour in _colours(parts).items():
            axes.plot(parts[who]["input"], parts[who]["simulated"], color=colour, linewidth=1.0, label=who)
        axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=2, borderaxespad=0, handlelength=1.4)

    caption = f"{record}: hysteresis loops, measured and simulated{_shown(rows, first)}."
    return picture(folder, _plain(name), (3.4, 3.4), caption, caption, draw)


def _shown(rows: pd.DataFrame, window: pd.DataFrame) -> str:
    whole = rows[rows["optimizer"] == rows["optimizer"].iloc[0]]
    return f", last {CYCLES} cycles" if len(window) < len(whole) else ""


def _plain(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9-]+", "-", name)
