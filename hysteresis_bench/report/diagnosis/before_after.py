"""What a page shows of a diagnosis, its own and a study's: the errors and the records before and after, and the ties.

`found` is the content of diagnosis.json.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.diagnosis.laws.comparison import BASELINE
from hysteresis_bench.report.diagnosis.figures import WITHOUT, Bar, bars_of, loops, residuals, waterfall
from hysteresis_bench.report.diagnosis.in_print import in_print
from hysteresis_bench.report.shared.blocks import Block, Cell, Figures, Heading, Table
from hysteresis_bench.report.shared.text import NONE, Units, named, number, percent, sentence
from hysteresis_bench.report.shared.theme import Picture

ROLES = {"fitted": "fitted", "held_out": "held out"}


def errors_table(found: Mapping[str, Any], noise: float | None, units: Units, *, more: str = "") -> Table:
    """Fitted and held out, before and after; noise : RMS, what the errors are divided by;  more : to be noted"""
    rows: list[list[str | Cell]] = []
    for role, words in ROLES.items():
        first, last = found["before"][role], found["after"][role]
        if first is None or last is None:
            continue
        for name, errors in (("before", first), ("after", last)):
            error = errors["rmse"]
            rows.append(
                [
                    f"{words}, {name}",
                    Cell(number(error), "", name == "after"),
                    percent(errors["relative_rms"]),
                    percent(errors["max_error"]),
                    NONE if name == "before" else number(_ratio(first["rmse"], error), 3, never=NONE),
                    number(_ratio(error, noise), 3, never=NONE),
                ]
            )
    rows.append(["noise", number(noise), *4 * [NONE]])
    header = [
        "Records",
        named("RMSE", units, "output"),
        "Relative RMS",
        "Largest error",
        "Times smaller",
        "Times the noise",
    ]
    note = f"Relative to the largest |output − offset| measured.{more} {in_print(sentence(found['noise']['words']))}"
    return Table("Errors before and after", header, rows, note)


def step_by_step(folder: Path, found: Mapping[str, Any], units: Units, *, name: str = "waterfall") -> Picture:
    """The error from the bare model, or from no memory at all, via each adopted effect to the noise."""
    return waterfall(folder, bars_from(found), units=units, name=name)


def bars_from(found: Mapping[str, Any]) -> list[Bar]:
    """What `waterfall` draws; where the law was sought, beginning with the polynomial that every law must beat."""
    before, after = ((found[stage]["held_out"] or {}).get("rmse") for stage in ("before", "after"))
    bars = bars_of([(step["system"], step["rmse"]) for step in found["waterfall"]], (before, after))
    laws = (found.get("laws") or {"laws": []})["laws"]
    without = [Bar(BASELINE, law["fitted"], WITHOUT, law["held_out"]) for law in laws if law["law"] == BASELINE]
    return [*without, *bars]


def record_blocks(folder: Path, place: str, rows: pd.DataFrame, *, noise: float, units: Units) -> list[Block]:
    """Heading, loops and residuals of one record; place : what the figures' names have before the record's."""
    record, role = rows["record"].iloc[0], rows["role"].iloc[0]
    heading, name = f"{record} ({role})", f"{place}-{record}"
    drawn = loops(folder, f"loop-{name}", rows, units=units, caption=f"{heading}.")
    left = residuals(folder, f"residual-{name}", rows, noise=noise, units=units, caption=f"{heading}.")
    return [Heading(heading), Figures([*drawn, *left], "small" if len(drawn) == 1 else "")]


def ties_in_words(ties: Sequence[Mapping[str, Any]]) -> list[str]:
    """One sentence a pair."""
    return [f"{tie['effect']} and {tie['rival']}: {tie['reason']}." for tie in ties]


def besides_ties(warnings: Sequence[str], ties: Sequence[Mapping[str, Any]]) -> list[str]:
    """Warnings without those that only say what a list of ties says."""
    listed = tuple(f"{tie['effect']} and {tie['rival']} cannot" for tie in ties)
    return [warning for warning in warnings if not (listed and warning.startswith(listed))]


def _ratio(above: float | None, below: float | None) -> float | None:
    if above is None or below is None:
        return None
    return above / below if below > 0 else float("inf")
