"""The page of a fitted model: parameters, errors, loops, what is left."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.report.shared.blocks import (
    ESTIMATE_HEADER,
    ESTIMATE_NOTE,
    Block,
    Bullets,
    Cell,
    Figures,
    Table,
    Terms,
    estimate_cells,
)
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.signal_figures import errors, loop
from hysteresis_bench.report.shared.text import NONE, Units, named, number, percent
from hysteresis_bench.report.shared.theme import SERIES, Picture

FILE = "fit.html"

RECORDS_DRAWN = 24
"""Records whose figures are shown; the tables have all of them."""

GRADES = (
    (0.01, "very good: within 1 % of the largest output"),
    (0.05, "good enough for many purposes: a few per cent of the largest output"),
    (0.15, "rough: the shape is followed, the details are not"),
    (float("inf"), "poor: the model does not follow these records"),
)
"""Relative RMS below which a fit is called so. Ours; a reader's purpose decides."""


def write_fit_page(
    folder: Path, fit: Mapping[str, Any], responses: pd.DataFrame, memory: Section | None = None
) -> Path:
    """Write fit.html and figures/*.svg into the folder; returns the page.

    fit : title, model, effects, units, parameters, records, agreement, notes, warnings, provenance;
        a parameter has name, value, standard_error (or None), unit, at_bound; a record has record, role,
        rmse, relative_rms, max_error
    responses : record, role, time, input, output, simulated;  memory : of its law
    """
    loops, residuals = _pictures(folder, fit, responses)
    made: list[Block] = [Bullets(fit["notes"])] if fit.get("notes") else []
    sections = [
        Section("parameters", "Parameters", [_parameters(fit["parameters"])]),
        Section("errors", "Errors", [_errors(fit["records"], fit.get("units", {}))]),
        Section("loops", "Measured and fitted", [Figures(loops, "small")]),
        Section("residuals", "What is left", [Figures(residuals)]),
        *([memory] if memory else []),
        Section("notes", "How it was made", [*made, Terms(_facts(fit.get("provenance", {})))]),
    ]
    page = Page(
        fit["title"],
        _kicker(fit),
        sections,
        [said for said in (_grade(fit["records"]), fit.get("agreement"), _left_out(responses)) if said],
        answers="How good is this",
        warnings=fit.get("warnings", ()),
    )
    return page.write(folder / FILE)


def _kicker(fit: Mapping[str, Any]) -> str:
    effects = list(fit.get("effects", ()))
    return f"{fit['model']}{' with ' + ', '.join(effects) if effects else ''}"


def _grade(records: Sequence[Mapping[str, Any]]) -> str:
    """How good is this: the errors in words, fitted and held out apart."""
    said = []
    for role, verb in (("fitted", "it was fitted to"), ("held-out", "it has not seen")):
        mine = [record for record in records if record["role"] == role]
        if not mine:
            continue
        worst, furthest = (max(mine, key=lambda record: record[error]) for error in ("relative_rms", "max_error"))
        grade = next(words for edge, words in GRADES if worst["relative_rms"] < edge)
        several = (
            f"the {len(mine)} records {verb}, at worst ({worst['record']})" if len(mine) > 1 else f"the record {verb}"
        )
        where = "" if furthest is worst else f" (in {furthest['record']})"
        said.append(
            f"On {several} the model leaves a relative RMS of {percent(worst['relative_rms'])} and a largest error of "
            f"{percent(furthest['max_error'])}{where}. That is {grade}."
        )
    if not any(record["role"] == "held-out" for record in records):
        said.append("No record was held out, so nothing here says how well it predicts.")
    return " ".join(said)


def _left_out(responses: pd.DataFrame) -> str:
    count = responses["record"].nunique() if len(responses) else 0
    return f"The figures show the first {RECORDS_DRAWN} of {count} records." if count > RECORDS_DRAWN else ""


def _parameters(parameters: Sequence[Mapping[str, Any]]) -> Table:
    marked = any(each.get("at_bound") for each in parameters)
    rows = [
        [
            *estimate_cells(each["name"], each["value"], each.get("standard_error"), unit=each.get("unit")),
            *([Cell("at its bound", "bad") if each.get("at_bound") else ""] if marked else []),
        ]
        for each in parameters
    ]
    return Table("Identified values", [*ESTIMATE_HEADER, *(["Remark"] if marked else [])], rows, ESTIMATE_NOTE)


def _errors(records: Sequence[Mapping[str, Any]], units: Units) -> Table:
    rows = [
        [record["record"], record["role"], number(record["rmse"]), percent(record["relative_rms"]),
         percent(record["max_error"])]
        for record in records
    ]  # fmt: skip
    header = ["Record", "Role", named("RMSE", units, "output"), "Relative RMS", "Largest error"]
    return Table("Errors of each record", header, rows, note="Relative to the largest |output − offset| measured.")


def _pictures(folder: Path, fit: Mapping[str, Any], responses: pd.DataFrame) -> tuple[list[Picture], list[Picture]]:
    loops, residuals = [], []
    units = fit.get("units", {})
    for index, (record, rows) in enumerate(responses.groupby("record", sort=False)):
        if index >= RECORDS_DRAWN:
            break
        role = rows["role"].iloc[0]
        colour = SERIES[0] if role == "fitted" else SERIES[1]
        caption = f"{record} ({role})."
        if rows["output"].notna().any():
            loops.append(
                loop(folder, f"loop-{index + 1}-{record}", {fit["model"]: (rows, colour)}, units=units, caption=caption)
            )
            minus = f"{caption} Simulated minus measured."
            residuals.append(
                errors(folder, f"residual-{index + 1}-{record}", {role: (rows, colour)}, units=units, caption=minus)
            )
    return loops, residuals


def _facts(provenance: Mapping[str, Any]) -> list[tuple[str, str]]:
    found = []
    for term, value in provenance.items():
        if isinstance(value, Mapping):
            value = ", ".join(f"{key} {each}" for key, each in value.items())
        elif isinstance(value, (list, tuple)):
            value = ", ".join(str(each) for each in value)
        found.append((str(term).replace("_", " ").capitalize(), str(value) if value is not None else NONE))
    return found
