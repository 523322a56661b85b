"""A diagnosis as files: diagnosis.json, schema 1, and the model.json that `predict` reads."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest
from hysteresis_bench.diagnosis.findings.candidates import Candidate
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import Stage
from hysteresis_bench.fit.model_file import write_model

SCHEMA = 1


def write_diagnosis(folder: Path, diagnosis: Diagnosis, files: Sequence[Path] = ()) -> Path:
    """Write diagnosis.json and model.json; files : the data, named in both with their SHA-256."""
    folder.mkdir(parents=True, exist_ok=True)
    data = {
        "files": [file.name for file in files],
        "sha256": [hashlib.sha256(file.read_bytes()).hexdigest() for file in files],
        **diagnosis.model.data,
    }
    write_model(folder / "model.json", replace(diagnosis.model, data=data))
    path = folder / "diagnosis.json"
    content = _plain({**as_dict(diagnosis), "data": data})
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    return path


def as_dict(diagnosis: Diagnosis) -> dict[str, Any]:
    """The content of diagnosis.json."""
    return {
        "schema": SCHEMA,
        "model": diagnosis.model_name,
        "verdict": diagnosis.verdict,
        "headline": diagnosis.headline,
        "effects": list(diagnosis.effects),
        "offset": diagnosis.offset or None,
        "before": _errors(diagnosis.before),
        "after": _errors(diagnosis.after),
        "noise_rms": diagnosis.noise.floor,
        "noise": {**asdict(diagnosis.noise), "words": diagnosis.noise.words},
        "residual": {"before": _tests(diagnosis.before.tests), "after": _tests(diagnosis.after.tests)},
        "waterfall": [{"system": label, "rmse": rmse} for label, rmse in diagnosis.waterfall],
        "candidates": [_candidate(candidate) for candidate in diagnosis.candidates],
        "ties": [asdict(tie) for tie in diagnosis.ties],
        "hysteresis": {
            "needed": diagnosis.memory.needed,
            "p_value": diagnosis.memory.p,
            "ambiguous": diagnosis.memory.ambiguous,
            "words": diagnosis.memory.words,
        },
        "unexplained": None if diagnosis.equation is None else str(diagnosis.equation),
        "split": dict(diagnosis.split),
        "advice": diagnosis.advice.words if diagnosis.advice else None,
        "warnings": list(diagnosis.warnings),
    }


def _errors(stage: Stage) -> dict[str, Any]:
    return {
        "fitted": stage.fitted.as_dict(),
        "held_out": stage.held_out.as_dict() if stage.held_out else None,
    }


def _tests(tests: Sequence[ResidualTest]) -> list[dict[str, Any]]:
    return [
        {
            "record": test.record,
            "test": test.name,
            "statistic": test.statistic,
            "p_value": test.corrected_p,
            "share": test.share,
            "significant": test.significant,
            "words": test.words,
        }
        for test in tests
    ]


def _candidate(candidate: Candidate) -> dict[str, Any]:
    return {
        "effect": candidate.effect,
        "applicable": candidate.applicable,
        "reason": candidate.reason or None,
        "adopted": candidate.adopted,
        "rmse": candidate.rmse,
        "cv_rmse": candidate.cv_rmse,
        "p_value": candidate.p,
        "advantage": candidate.advantage,
        "share": candidate.share,
        "parameters": dict(candidate.parameters or {}),
        "at_bound": list(candidate.at_bound),
        "tied_with": list(candidate.tied_with),
    }


def _plain(value: Any) -> Any:
    """What JSON can hold: numbers that are not finite are absent."""
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value.item() if hasattr(value, "item") else value
