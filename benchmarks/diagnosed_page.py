"""A part of the page on real measurements: what `diagnose` finds of every device, where no law is given."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
from measured_page import noise_cell

from hysteresis_bench.diagnosis.search.fallback import WORSE
from hysteresis_bench.report.shared.blocks import Bullets, Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, listed, number

LONG = 600
"""Seconds of a diagnosis from which its time is told."""
NEXT_TO_NOTHING = 0.001
"""Share of the error below which a constant is none, as where every record's own is estimated."""


def read(path: Path) -> pd.DataFrame:
    """diagnosed.csv"""
    return pd.read_csv(path).fillna({"effects": "", "stand_ins": ""})


def section(rows: pd.DataFrame, laws: pd.DataFrame) -> Section:
    """laws : of laws.csv, for the polynomial's error and the asked one"""
    beside = laws.set_index("device")
    plain, asked = (rows["device"].map(beside[column]) for column in ("polynomial", "asked"))
    missing = [device for device in laws["device"] if device not in {*rows["device"]}]
    said = _answer(rows, plain, missing)
    return Section("found", "Law and effects, with nothing given", [said, _table(rows, plain, asked)])


def _answer(rows: pd.DataFrame, plain: pd.Series, missing: list[str]) -> Bullets:
    named = rows[rows["effects"] != ""]
    limit = rows["before"].clip(lower=rows["floor"]) * WORSE
    worse = rows[rows["after"] > limit]
    names = [row.device for row in worse.itertuples() if row.effects]
    only = [row.device for row in worse.itertuples() if not row.effects]
    told = [
        f"In {len(named)} of {len(rows)} an effect is named, by itself or as its family with a curve; of these, what "
        f"was held out is predicted worse in {listed(names) if names else 'none'}.",
        f"Only what stands in for the law, and is not named, predicts it worse in {listed(only) if only else 'none'}.",
    ]
    over = rows["after"] / plain
    if (over >= 1.0).any():
        told.append(f"Worse than a cubic polynomial: {listed(list(rows['device'][over >= 1.0]))}.")
    if missing:
        told.append(f"Not asked, or not ended in the time that was given: {listed(missing)}.")
    long = [f"{row.device} ({row.seconds / 60:.0f})" for row in rows.itertuples() if row.seconds > LONG]
    if long:
        told.append(f"More than ten minutes were given to these, in minutes, on one processor: {listed(long)}.")
    told.append(
        "The loops of the FeFET were passed as settled, until it was seen that their outputs end 16 % of the range "
        "away from where they began, and what is predicted of the record held out without that. They begin in "
        "mid-loop, after a pulse that was not recorded: of every record what comes before the input has passed both "
        "ends of its range, at most half, is simulated and not scored, before and after, on what was fitted and on "
        "what was held out. The diagnosis reads the S355 coupon so by itself, whose cycles grow."
    )
    return Bullets(told)


def _table(rows: pd.DataFrame, plain: pd.Series, asked: pd.Series) -> Table:
    lines: list[list[str | Cell]] = []
    for row, cubic, wanted in zip(rows.itertuples(), plain, asked, strict=True):
        spare = f"; for the law: {listed(row.stand_ins.split())}" if row.stand_ins else ""
        unit = "" if row.unit == "1" else f", {row.unit}"
        reached = not pd.isna(wanted) and row.after <= wanted
        lines.append(
            [
                Cell(f"{row.device}{unit}", "prose"),
                row.law,
                Cell(f"{listed(row.effects.split()) if row.effects else 'none'}{spare}", "prose"),
                number(row.before, 3),
                Cell(number(row.after, 3), "good" if reached else "", strong=True),
                number(row.constant, 2) if row.constant > NEXT_TO_NOTHING * row.after else "0",
                number(cubic, 3),
                NONE if pd.isna(wanted) else number(wanted, 3),
                noise_cell(row.floor, row.after),
            ]
        )
    header = ["Device", "Law", "Named", "Before", "After", "Constant", "Polynomial", "Asked", "Noise"]
    note = (
        "RMSE on what was held out. Other than in the table above, where one record was fitted the zero of what is "
        "held out is not estimated: the constant is a part of the error. Nothing was given: neither a law, nor effects."
    )
    return Table("Diagnoses without a law", header, lines, note=note)
