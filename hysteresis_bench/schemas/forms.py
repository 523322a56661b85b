"""The forms of the files, from which their schemas are generated."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict

NAMES = ("study", "model", "diagnosis")
FOLDER = Path(__file__).parent


class Form(BaseModel):
    """A table whose further keys are allowed: a later release may add some."""

    model_config = ConfigDict(extra="allow")


class Estimate(Form):
    """A parameter with its standard error, null where the data cannot tell."""

    value: float
    standard_error: float | None
    unit: str


class EffectFile(Form):
    """An effect around the model."""

    effect: str
    settings: dict[str, Any] = {}
    parameters: dict[str, Estimate]


class Errors(Form):
    """RMSE in the unit of the output, the others as shares of its largest |output - offset|."""

    rmse: float
    relative_rms: float
    max_error: float


class Stage(Form):
    """Errors on what was fitted, and on what was held out."""

    fitted: Errors
    held_out: Errors | None = None


class IntervalFile(Form):
    """How far predictions may be off: half-widths by percent of a record's samples, in the unit of the output."""

    half_widths: dict[str, float]
    records: int
    speeds: list[float]
    duration: float | None = None
    rest: float | None = None


class ModelFile(Form):
    """A fitted model: model.json."""

    model_config = ConfigDict(extra="allow", title="hysteresis-bench model.json")

    schema_number: int
    model: str
    settings: dict[str, Any] = {}
    units: dict[str, str]
    parameters: dict[str, Estimate]
    effects: list[EffectFile]
    fixed: dict[str, float] = {}
    preparation: dict[str, Any] = {}
    data: dict[str, Any] = {}
    error: dict[str, Errors | None] = {}
    interval: IntervalFile | None = None
    created_by: dict[str, str] = {}


class CandidateFile(Form):
    """An effect that was tried, or why it could not be."""

    effect: str
    applicable: bool
    reason: str | None
    adopted: bool
    rmse: float | None
    cv_rmse: float | None
    p_value: float | None
    parameters: dict[str, Any]
    tied_with: list[str]


class DiagnosisFile(Form):
    """A diagnosis: diagnosis.json."""

    model_config = ConfigDict(extra="allow", title="hysteresis-bench diagnosis.json")

    schema_number: int
    model: str
    verdict: Literal["effect-found", "no-effect-needed", "unexplained-residual"]
    effects: list[str]
    before: Stage
    after: Stage
    noise_rms: float
    candidates: list[CandidateFile]
    warnings: list[str]


def schema(name: str) -> dict[str, Any]:
    """The schema of a kind of file, as it is shipped."""
    found: dict[str, Any] = json.loads((FOLDER / f"{name}.schema.json").read_text(encoding="utf-8"))
    return found


def generated(name: str) -> dict[str, Any]:
    """The schema of a kind of file, from its form."""
    from hysteresis_bench.study.study_file import Study

    forms: dict[str, type[BaseModel]] = {"study": Study, "model": ModelFile, "diagnosis": DiagnosisFile}
    form = forms[name]
    made = form.model_json_schema()
    if "schema_number" in made["properties"]:  # the key is `schema`, which a pydantic model cannot have
        made["properties"] = {"schema": made["properties"].pop("schema_number"), **made["properties"]}
        made["required"] = ["schema", *made["required"][1:]]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made}


def write_schemas() -> None:
    """Write the shipped files anew; a test tells where this is due."""
    for name in NAMES:
        text = json.dumps(generated(name), indent=1, ensure_ascii=False) + "\n"
        (FOLDER / f"{name}.schema.json").write_text(text, encoding="utf-8")
