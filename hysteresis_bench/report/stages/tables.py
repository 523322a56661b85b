"""The tables of a stage: the linear section, the model check, staged against all at once, the closed loop."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pandas as pd

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.paper.published import Table as Printed
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import AS_PRINTED, NONE, named, number, to_its_error
from hysteresis_bench.report.stages.rows import error_of, labels_of, mean_error
from hysteresis_bench.study.afterwards.stages import FITTED, HELD, LARGEST, RMSE, STAGED, TRACKING
from hysteresis_bench.study.study_file import StageSpec


def linear_section(spec: StageSpec, rows: pd.DataFrame, published: Published) -> Table:
    """The linear section as published and as ours, with standard errors, and what follows from it."""
    printed = next((t.columns for t in published.tables.values() if {"optimizer", *spec.fit} <= set(t.columns)), None)
    header, sides = ["Quantity"], []
    for label in labels_of(rows, STAGED):
        if printed and label in printed["optimizer"]:
            place = printed["optimizer"].index(label)
            values = {name: float(printed[name][place]) for name in spec.fit}
            header.append(f"{label}, published")
            sides.append({name: number(value, AS_PRINTED) for name, value in values.items()} | _derived(spec, values))
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
    return number(value) if pd.isna(error) else f"{to_its_error(value, error)} ± {number(error, 2)}"


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


def check(spec: StageSpec, rows: pd.DataFrame, checked: list[Printed], *, quantity: str, unit: str) -> Table:
    """Errors on the check's records, published beside ours, with the mean."""
    column = {LARGEST: "error", RMSE: "rmse"}[quantity]
    header, sides = ["Signal"], []
    for label in labels_of(rows, STAGED):
        printed = next((t.columns for t in checked if f"{label}_{column}" in t.columns), None)
        if printed:
            header.append(f"{label}, published")
            sides.append(dict(zip(map(str, printed["record"]), map(float, printed[f"{label}_{column}"]), strict=True)))
        header.append(f"{label}, ours" if printed else label)
        ours = {record: error_of(rows, label, STAGED, quantity=quantity, name=record) for record in spec.check}
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


def ways(spec: StageSpec, rows: pd.DataFrame, unit: str) -> Table:
    """Staged against all at once: rmse on what was fitted and on the check."""
    header, sides = ["Signal"], []
    for way in (STAGED, spec.beside or ""):
        for label in labels_of(rows, way):
            header.append(f"{label}, {way}")
            every = {
                record: error_of(rows, label, way, quantity=RMSE, name=record) for record in (*spec.fitted, *spec.check)
            }
            sides.append(every | {"mean of the check": mean_error(spec, rows, label, way=way, quantity=RMSE)})
    cells = [[name, *(number(side[name]) for side in sides)] for name in (sides[0] if sides else {})]
    return Table(f"{spec.name}: staged against {spec.beside}, {named(RMSE, {'output': unit}, 'output')}", header, cells)


def tracking(spec: StageSpec, rows: pd.DataFrame, published: Published, *, unit: str) -> Table:
    """Closed loop on the rig, every controller on every reference; the paper's beside its own controller."""
    table = next((each for each in published.tables.values() if "reference" in each.columns), None)
    printed, papers = (table.columns, table.controller) if table else ({}, "")
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
                row += [
                    number(theirs, AS_PRINTED) if controller == papers else NONE,
                    number(None if mine.empty else mine.iloc[0]),
                ]
        cells.append(row)
    note = "Largest and RMS error of the true displacement, where the reference is scored."
    if papers:
        own = f"The paper's numbers stand beside {papers}, its own controller; its settings are not known, ours are "
        note = f"{own}tuned from the model. {note}"
    return Table(
        f"{spec.name}: closed loop on the rig, {named('errors', {'output': unit}, 'output')}", header, cells, note
    )
