"""What a page shows of a diagnosis, at hand or read from files: the errors and the records, before and after."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.report.diagnosis.figures import loops, residuals
from hysteresis_bench.report.shared.page import NONE, Cell, Table, number, percent
from hysteresis_bench.report.shared.signal_figures import Units
from hysteresis_bench.report.shared.theme import Picture

Errors = Mapping[str, Mapping[str, Any] | None]
"""What diagnosis.json says under "before" and "after": fitted and held_out, each with rmse, relative_rms, max_error."""

ROLES = {"fitted": "fitted", "held_out": "held out"}


def errors_table(before: Errors, after: Errors, noise: float | None, units: Units, note: str) -> Table:
    """Fitted and held out, before and after; noise : RMS, what the errors are divided by."""
    rows: list[list[str | Cell]] = []
    for role, words in ROLES.items():
        first, last = before[role], after[role]
        if first is None or last is None:
            continue
        for name, errors in (("before", first), ("after", last)):
            rmse = errors["rmse"]
            rows.append(
                [
                    f"{words}, {name}",
                    Cell(number(rmse), "", name == "after"),
                    percent(errors["relative_rms"]),
                    percent(errors["max_error"]),
                    NONE if name == "before" else number(_ratio(first["rmse"], rmse), 3, never=NONE),
                    number(_ratio(rmse, noise), 3, never=NONE),
                ]
            )
    rows.append(["noise", number(noise), *4 * [NONE]])
    header = ["Records", rmse_in(units), "Relative RMS", "Largest error", "Times smaller", "Times the noise"]
    return Table("Errors before and after", header, rows, note=note)


def record_pictures(
    folder: Path, place: str, rows: pd.DataFrame, noise: float, units: Units
) -> tuple[str, Picture, Picture]:
    """Heading, loop and residual of one record; place : what the figures' names have before the record's."""
    record, role = rows["record"].iloc[0], rows["role"].iloc[0]
    heading = f"{record} ({role})"
    name = re.sub(r"[^A-Za-z0-9-]+", "-", f"{place}-{record}").strip("-")
    return (
        heading,
        loops(folder, f"loop-{name}", rows, units, f"{heading}."),
        residuals(folder, f"residual-{name}", rows, noise, units, f"{heading}."),
    )


def besides_ties(warnings: Sequence[str], ties: Iterable[tuple[str, str]]) -> list[str]:
    """Warnings without those that only say what a list of ties says; ties : effect and rival."""
    told = tuple(f"{effect} and {rival} cannot" for effect, rival in ties)
    return [warning for warning in warnings if not (told and warning.startswith(told))]


def rmse_in(units: Units) -> str:
    """RMSE (um)"""
    unit = units.get("output", "1")
    return f"RMSE ({unit})" if unit != "1" else "RMSE"


def sentence(words: str) -> str:
    """A capital at the beginning, a full stop at the end."""
    return f"{words[:1].upper()}{words[1:]}{'' if words.endswith('.') else '.'}"


def _ratio(above: float | None, below: float | None) -> float | None:
    if above is None or below is None:
        return None
    return above / below if below > 0 else float("inf")
