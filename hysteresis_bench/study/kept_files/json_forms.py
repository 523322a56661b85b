"""What JSON files of a results folder must look like to be what was written there: a wrong form is damage."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def check_provenance(content: Mapping[str, Any]) -> None:
    """Raises ValueError where provenance.json is not what `describe` writes."""
    for key in ("versions", "machine", "optimizers", "data", "units"):
        if not isinstance(content.get(key, {}), dict):
            raise ValueError(f"{key} is no object")
    for label, made in content.get("optimizers", {}).items():
        if not (isinstance(made, dict) and {"plugin", "settings", "budget"} <= made.keys()):
            raise ValueError(f"optimizer {label} is not described")
        if not isinstance(made["settings"], dict):
            raise ValueError(f"the settings of optimizer {label} are no object")
        if type(made.get("evaluations_per_iteration")) not in (int, type(None)):
            raise ValueError(f"the evaluations an iteration of optimizer {label} are no number")
    if not all(isinstance(units, dict) for units in content.get("units", {}).values()):
        raise ValueError("units are no object")
    notes = content.get("notes", [])
    if not (isinstance(notes, list) and all(isinstance(note, str) for note in notes)):
        raise ValueError("notes are no sentences")
