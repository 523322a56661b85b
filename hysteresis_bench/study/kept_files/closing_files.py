"""What the diagnosis at the end of a study leaves in the results folder, as it is read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import pandas as pd

from hysteresis_bench.study.kept_files.reader import Reader

CLOSING, OUTCOME = "closing", "closing.json"
DIAGNOSIS, MODEL, RESPONSES, PAGE = "diagnosis.json", "model.json", "responses.csv", "diagnosis.html"
DONE = "done"


@dataclass(frozen=True, eq=False)
class Closing:
    """A finished diagnosis, or why there is none. All of it is read, nothing computed.

    outcome : the content of closing.json: asked (specification, rig, seed), hidden (what the rig is built with,
        by name), status, reason, seconds
    diagnosis : the content of diagnosis.json, empty where the status is not "done"
    units : of time, input and output
    responses : record, role, time, input, output, before, after, thinned; of older files the records held out only
    page : of the whole diagnosis, relative to the results folder; None without
    """

    outcome: Mapping[str, Any]
    diagnosis: Mapping[str, Any]
    units: Mapping[str, str]
    responses: pd.DataFrame
    page: str | None

    @property
    def finished(self) -> bool:
        return bool(self.diagnosis) and self.outcome.get("status") == DONE


COLUMNS = ("record", "role", "time", "input", "output", "before", "after")


def read_closing(reader: Reader) -> Closing | None:
    """Of a results folder; None where no diagnosis was tried, or what it came to cannot be read."""
    outcome = reader.json(f"{CLOSING}/{OUTCOME}")
    if "status" not in outcome:
        return None
    diagnosis = reader.json(f"{CLOSING}/{DIAGNOSIS}")
    responses = reader.csv(f"{CLOSING}/{RESPONSES}", COLUMNS)
    if diagnosis and responses.empty:
        reader.said(f"{CLOSING}/{RESPONSES}", "it is missing or has no samples; without it nothing is drawn")
    return Closing(
        outcome,
        diagnosis,
        reader.json(f"{CLOSING}/{MODEL}").get("units", {}),
        responses,
        f"{CLOSING}/{PAGE}" if (reader.folder / CLOSING / PAGE).is_file() else None,
    )
