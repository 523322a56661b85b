"""What a fit leaves behind: model.json, tables, a page; and the same on the terminal."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.data.units import rounded
from hysteresis_bench.fit.fitting import Fit
from hysteresis_bench.fit.model_file import FittedModel, write_model
from hysteresis_bench.report.fit.page import FILE, write_fit_page
from hysteresis_bench.report.laws.memory import memory_section
from hysteresis_bench.report.shared.text import listed

MODEL, RESPONSES, PARAMETERS = "model.json", "responses.csv", "parameters.csv"
FILES = (MODEL, RESPONSES, PARAMETERS, FILE)

PARAMETERS_SHOWN = 30
"""Parameters of which the terminal shows all: of more it leaves out those that are not determined one by one."""


def write_fit(folder: Path, fit: Fit, files: Sequence[Path]) -> Path:
    """Write model.json, parameters.csv, responses.csv, figures and the page; returns the page."""
    folder.mkdir(parents=True, exist_ok=True)
    sums = [hashlib.sha256(file.read_bytes()).hexdigest() for file in files]
    data = {"files": [str(file) for file in files], "sha256": sums, **fit.model.data}
    write_model(folder / MODEL, replace(fit.model, data=data))
    write_table(folder / PARAMETERS, fit.parameters)
    write_table(folder / RESPONSES, fit.responses, digits=8)
    summary = {
        "title": f"{fit.model.model} fitted to {listed(fit.model.data['fitted'])}",
        "model": fit.model.model,
        "effects": list(fit.model.effects),
        "units": dict(fit.model.units),
        "parameters": _rows(fit.parameters),
        "records": _rows(fit.records),
        "notes": list(fit.notes),
        "warnings": list(fit.warnings),
        "agreement": fit.agreement,
        "provenance": {
            **fit.model.created_by,
            **{f"sha256 of {file.name}": sha for file, sha in zip(files, sums, strict=True)},
        },
    }
    fitted = fit.responses[fit.responses["role"] == "fitted"]
    inputs = [rows["input"].to_numpy() for _, rows in fitted.groupby("record", sort=False)]
    return write_fit_page(folder, summary, fit.responses, memory_section(folder, fit.model, inputs))


def spared(model: FittedModel) -> list[str]:
    """Parameters that the terminal leaves out, such as the weights of a density, of which no single one means much."""
    unknown = [name for name, estimate in model.parameters.items() if estimate.standard_error is None]
    return unknown if len(model.parameters) > PARAMETERS_SHOWN else []


def spared_words(left_out: Sequence[str], file: str) -> str:
    """How many are left out, and where all of them stand."""
    return f"{len(left_out)} more are not determined one by one; all stand in {file}."


def print_fit(fit: Fit, console: Console) -> None:
    """Parameters, errors, agreement and warnings."""
    parameters = Table(title=f"{fit.model.model}: parameters", title_justify="left", box=None, title_style="bold")
    for heading, side in (("parameter", "left"), ("value", "right"), ("± standard error", "right"), ("unit", "left")):
        parameters.add_column(heading, justify=side)  # type: ignore[arg-type]
    left_out = spared(fit.model)
    for row in fit.parameters[~fit.parameters["name"].isin(left_out)].itertuples(index=False):
        known = row.standard_error is not None and pd.notna(row.standard_error)
        error = rounded(row.standard_error) if known else "not determined"
        mark = "  at bound" if row.at_bound else ""
        parameters.add_row(row.name, f"{row.value:.6g}", error, row.unit + mark, style="yellow" if mark else "")
    console.print(parameters)
    if left_out:
        console.print(spared_words(left_out, PARAMETERS), highlight=False)
    unit = fit.model.units["output"]
    rmse = "RMSE" if unit == "1" else f"RMSE [{unit}]"
    errors = Table(title="errors", title_justify="left", box=None, title_style="bold")
    errors.add_column("record")
    for heading in (escape(rmse), "relative RMS", "largest error"):
        errors.add_column(heading, justify="right")
    errors.add_column("")
    for row in fit.records.itertuples(index=False):
        rms, largest = f"{100 * row.relative_rms:.2f} %", f"{100 * row.max_error:.2f} %"
        errors.add_row(escape(row.record), f"{row.rmse:.4g}", rms, largest, row.role)
    console.print(errors)
    console.print(fit.agreement, style="" if fit.agrees else "bold yellow", highlight=False)
    for warning in fit.warnings:
        console.print(f"[yellow]note:[/] {escape(warning)}", highlight=False)


def _rows(table: pd.DataFrame) -> list[dict[str, Any]]:
    """Records of a table, absent values as None."""
    return [{key: None if pd.isna(value) else value for key, value in row.items()} for row in table.to_dict("records")]
