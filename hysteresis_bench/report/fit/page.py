"""The page of a fitted model: parameters, errors, loops, what is left."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.report.shared.page import NONE, Cell, Table, number, percent, render
from hysteresis_bench.report.shared.signal_figures import errors, loop
from hysteresis_bench.report.shared.theme import SERIES, Picture

FILE = "fit.html"

MOST = 24
"""Records whose figures are shown; the tables have all of them."""

GRADES = (
    (0.01, "very good: within 1 % of the largest output"),
    (0.05, "good enough for many purposes: a few per cent of the largest output"),
    (0.15, "rough: the shape is followed, the details are not"),
    (float("inf"), "poor: the model does not follow these records"),
)
"""Relative RMS below which a fit is called so. Ours; a reader's purpose decides."""


def write_fit_page(folder: Path, fit: Mapping[str, Any], responses: pd.DataFrame) -> Path:
    """Write fit.html and figures/*.svg into the folder; returns the page.

    fit : title, model, effects, units, parameters, records, agreement, notes, warnings, provenance;
        a parameter has name, value, standard_error (or None), unit, at_bound; a record has record, role,
        rmse, relative_rms, max_error
    responses : record, role, time, input, output, simulated
    """
    loops, residuals = _pictures(folder, fit, responses)
    page = folder / FILE
    text = render(
        "fit.html.j2",
        title=fit["title"],
        kicker=_kicker(fit),
        answer=list(filter(None, [_grade(fit["records"]), fit.get("agreement"), _left_out(responses)])),
        warnings=fit.get("warnings", ()),
        parameters=_parameters(fit["parameters"]),
        errors=_errors(fit["records"], fit.get("units", {})),
        loops=loops,
        residuals=residuals,
        notes=fit.get("notes", ()),
        facts=_facts(fit.get("provenance", {})),
    )
    page.write_text(text, encoding="utf-8")
    return page


def _kicker(fit: Mapping[str, Any]) -> str:
    effects = list(fit.get("effects", ()))
    return f"{fit['model']}{' with ' + ', '.join(effects) if effects else ''}"


def _grade(records: Sequence[Mapping[str, Any]]) -> str:
    """How good is this: the errors in words, fitted and held out apart."""
    told = []
    for role, verb in (("fitted", "it was fitted to"), ("held-out", "it has not seen")):
        mine = [record for record in records if record["role"] == role]
        if not mine:
            continue
        worst = max(mine, key=lambda record: record["relative_rms"])
        grade = next(words for edge, words in GRADES if worst["relative_rms"] < edge)
        several = (
            f"the {len(mine)} records {verb}, at worst ({worst['record']})" if len(mine) > 1 else f"the record {verb}"
        )
        largest = max(record["max_error"] for record in mine)
        told.append(
            f"On {several} the model leaves a relative RMS of {percent(worst['relative_rms'])} and a largest error of "
            f"{percent(largest)}. That is {grade}."
        )
    if not any(record["role"] == "held-out" for record in records):
        told.append("No record was held out, so nothing here says how well it predicts.")
    return " ".join(told)


def _left_out(responses: pd.DataFrame) -> str:
    count = responses["record"].nunique() if len(responses) else 0
    return f"The figures show the first {MOST} of {count} records." if count > MOST else ""


def _parameters(parameters: Sequence[Mapping[str, Any]]) -> Table:
    rows: list[list[str | Cell]] = []
    for parameter in parameters:
        value, error = parameter["value"], parameter.get("standard_error")
        share = abs(error / value) if error is not None and value else None
        unsure = share is not None and share > 1.0
        rows.append(
            [
                parameter["name"],
                number(value, 6),
                number(error, 2, never="not determined"),
                Cell(percent(share, 2, never="not determined"), "bad" if unsure else ""),
                "" if parameter.get("unit") in ("1", None) else str(parameter["unit"]),
                Cell("at its bound", "bad") if parameter.get("at_bound") else "",
            ]
        )
    return Table(
        "Identified values",
        ["Parameter", "Value", "Standard error", "Of the value", "Unit", "Remark"],
        rows,
        note="Standard errors allow for correlated residuals; they do not know of what the model lacks.",
    )


def _errors(records: Sequence[Mapping[str, Any]], units: Mapping[str, str]) -> Table:
    unit = units.get("output", "1")
    rows = [
        [record["record"], record["role"], number(record["rmse"]), percent(record["relative_rms"]),
         percent(record["max_error"])]
        for record in records
    ]  # fmt: skip
    header = ["Record", "Role", f"RMSE ({unit})" if unit != "1" else "RMSE", "Relative RMS", "Largest error"]
    return Table("Errors of each record", header, rows, note="Relative to the largest |output − offset| measured.")


def _pictures(folder: Path, fit: Mapping[str, Any], responses: pd.DataFrame) -> tuple[list[Picture], list[Picture]]:
    loops, residuals = [], []
    units = fit.get("units", {})
    for index, (record, rows) in enumerate(responses.groupby("record", sort=False)):
        if index >= MOST:
            break
        role = rows["role"].iloc[0]
        colour = SERIES[0] if role == "fitted" else SERIES[1]
        name = re.sub(r"[^A-Za-z0-9-]+", "-", f"{index + 1}-{record}").strip("-")
        caption = f"{record} ({role})."
        if rows["output"].notna().any():
            loops.append(loop(folder, f"loop-{name}", rows, units, fit["model"], caption, colour))
            told = f"{caption} Simulated minus measured."
            residuals.append(errors(folder, f"residual-{name}", {role: (rows, colour)}, units, told))
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
