"""What the diagnosis at the end of a study leaves in the results folder, as it is read."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.csv_files import read_table

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
    responses : record, role, time, input, output, before, after of the records held out, thinned
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


def read_closing(results: Path) -> Closing | None:
    """Of a results folder; None where no diagnosis was tried."""
    folder = results / CLOSING
    if not (folder / OUTCOME).is_file():
        return None
    responses = folder / RESPONSES
    return Closing(
        _json(folder / OUTCOME),
        _json(folder / DIAGNOSIS),
        _json(folder / MODEL).get("units", {}),
        read_table(responses) if responses.is_file() else pd.DataFrame(),
        f"{CLOSING}/{PAGE}" if (folder / PAGE).is_file() else None,
    )


def _json(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
