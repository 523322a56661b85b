"""A diagnosis as files: diagnosis.json, schema 1, the model.json that `predict` reads, and responses.csv.

They hold all that a page tells. Keys were added to the schema since; what an older file lacks is filled in when it
is read, as far as it follows from the rest.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest
from hysteresis_bench.diagnosis.families import FamilyFinding
from hysteresis_bench.diagnosis.findings.advice import Advice
from hysteresis_bench.diagnosis.findings.candidates import Candidate
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import Stage
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.search.selection import LEVEL
from hysteresis_bench.diagnosis.structure.curves import write_curves
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import write_model
from hysteresis_bench.fit.unseen.advantage import CLEAR
from hysteresis_bench.registry import DESCRIPTION

SCHEMA = 1
DIAGNOSIS, MODEL, RESPONSES = "diagnosis.json", "model.json", "responses.csv"

DRAWN = 3000
"""Samples of a record in responses.csv: as many as a figure can show."""

ADOPTED, STAND_IN, TIED = "adopted", "stands in for the law", "tied"
PARTIAL, NEEDLESS = "too small a part", "not needed"
"""What became of a candidate."""


@dataclass(frozen=True, eq=False)
class KeptDiagnosis:
    """A diagnosis as its files hold it.

    diagnosis : the content of diagnosis.json, with every key of today;  model : of model.json
    responses : record, role, time, input, output, before, after over the scored samples, thinned to DRAWN a record
    """

    diagnosis: Mapping[str, Any]
    model: Mapping[str, Any]
    responses: pd.DataFrame


def write_diagnosis(folder: Path, diagnosis: Diagnosis, files: Sequence[Path] = ()) -> Path:
    """Write diagnosis.json, model.json and responses.csv; returns the first of them.

    files : the data, named in both with their SHA-256
    """
    folder.mkdir(parents=True, exist_ok=True)
    data = {
        "files": [file.name for file in files],
        "sha256": [hashlib.sha256(file.read_bytes()).hexdigest() for file in files],
        **diagnosis.model.data,
    }
    write_model(folder / MODEL, replace(diagnosis.model, data=data))
    parts = [_thinned(rows) for _, rows in diagnosis.responses.groupby("record", sort=False)]
    write_table(folder / RESPONSES, pd.concat(parts), digits=7)
    if diagnosis.laws is not None and diagnosis.laws.structure is not None:
        write_curves(folder, diagnosis.laws.structure.findings)
    path = folder / DIAGNOSIS
    content = _plain({**as_dict(diagnosis), "data": data})
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    return path


def read_diagnosis(folder: Path) -> KeptDiagnosis:
    """What write_diagnosis wrote. Raises UserError where the folder holds no diagnosis."""
    if not (folder / DIAGNOSIS).is_file():
        raise UserError(str(folder), f"holds no diagnosis: there is no {DIAGNOSIS} in it.")
    responses = folder / RESPONSES
    return KeptDiagnosis(
        complete(json.loads((folder / DIAGNOSIS).read_text(encoding="utf-8"))),
        json.loads((folder / MODEL).read_text(encoding="utf-8")),
        pd.read_csv(responses, dtype={"record": str, "role": str}) if responses.is_file() else pd.DataFrame(),
    )


def complete(content: Mapping[str, Any]) -> dict[str, Any]:
    """The content of a diagnosis.json, with the keys that older ones lack."""
    floor = content.get("floor", content["noise_rms"])
    offset = content["offset"]
    unexplained = content["unexplained"]
    left = None if unexplained in (None, str(Equation((), 0.0))) else {"text": unexplained}
    added = {
        "floor": floor,
        "doubtful": content["after"]["fitted"]["rmse"] > WRONG * floor,
        "described": [],
        "offset_of_both": offset if offset and list(content["effects"]) != [offset] else None,
        "equation": left,
        "families": [],
        "experiment": None,
        "measured": None,
        "unseen": None,
        "laws": None,
        "stand_ins": [],
        "carrying": [],
        "certainty": {},
        "better_law": None,
        "agreement": None,
        "ceiling": None,
    }
    candidates = [
        {"judgement": _judgement(c["adopted"], c["tied_with"], c["p_value"], c["advantage"]), **c}
        for c in content["candidates"]
    ]
    return {**added, **content, "candidates": candidates}


def as_dict(diagnosis: Diagnosis) -> dict[str, Any]:
    """The content of diagnosis.json.

    noise_rms : of the noise;  floor : RMS from which anything is judged, a little above it
    doubtful : is so much left that the names may stand in for something else, or do they not help on what is held out?
    described : those of the effects that describe what was left, and explain nothing
    certainty : of each claimed effect, the probability that it, or one tied with it, is there (null where too much is
    left to tell one), and what that rests on
    stand_ins : in the final model beside the effects, and not named: a law that does better, or as well, does not
    need them, or it is an offset beside something that is not explained
    carrying : of these, what carries the loop alone, beside which the law has next to none
    measured : the experiment that an earlier diagnosis advised and that is fitted here, and what it settled
    offset_of_both : the offset, where the system before has it as the one after has
    """
    offset = diagnosis.offset
    return {
        "schema": SCHEMA,
        "model": diagnosis.model_name,
        "verdict": diagnosis.verdict,
        "headline": diagnosis.headline,
        "effects": list(diagnosis.effects),
        "stand_ins": list(diagnosis.stand_ins),
        "carrying": list(diagnosis.carrying),
        "certainty": {
            name: {"probability": one.probability, **asdict(one)} for name, one in diagnosis.certainty.items()
        },
        "better_law": None if diagnosis.better_law is None else asdict(diagnosis.better_law),
        "agreement": None if diagnosis.agreement is None else asdict(diagnosis.agreement),
        "described": [name for name in diagnosis.effects if name == DESCRIPTION],
        "offset": offset or None,
        "offset_of_both": offset if offset in diagnosis.before.names else None,
        "before": _errors(diagnosis.before),
        "after": _errors(diagnosis.after),
        "noise_rms": diagnosis.noise.floor,
        "noise": {**asdict(diagnosis.noise), "words": diagnosis.noise.words},
        "floor": diagnosis.floor,
        "doubtful": diagnosis.doubtful,
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
        "equation": _equation(diagnosis.equation),
        "families": [_family(one) for one in diagnosis.families],
        "given_up": None if diagnosis.given_up is None else asdict(diagnosis.given_up),
        "unseen": diagnosis.unseen,
        "ceiling": None if diagnosis.ceiling is None else diagnosis.ceiling.as_dict(),
        "laws": None if diagnosis.laws is None else diagnosis.laws.as_dict(),
        "split": dict(diagnosis.split),
        "advice": diagnosis.advice.words if diagnosis.advice else None,
        "experiment": _experiment(diagnosis.advice),
        "measured": None if diagnosis.measured is None else diagnosis.measured.as_dict(),
        "warnings": list(diagnosis.warnings),
    }


def _equation(equation: Equation | None) -> dict[str, Any] | None:
    """What describes the remaining residual; None where nothing does."""
    if equation is None or not equation.terms:
        return None
    terms = [
        {
            "term": part.term.symbol,
            "coefficient": part.coefficient,
            "standard_error": part.standard_error,
            "unit": part.unit,
            "p_value": part.p,
        }
        for part in equation.terms
    ]
    return {"text": str(equation), "share": equation.share, "terms": terms}


def _family(found: FamilyFinding) -> dict[str, Any]:
    """What none of its formulas fits, with its curve."""
    curve = {**asdict(found.curve), "x": found.curve.x.tolist(), "y": found.curve.y.tolist()}
    return {"effect": found.effect, "family": found.family, "words": found.sentence, "curve": curve}


def _experiment(advice: Advice | None) -> dict[str, Any] | None:
    """What to measure next, in numbers; None where no feasible signal helps."""
    if advice is None or not advice.experiment:
        return None
    told = {"signal": advice.experiment, "separation": advice.separation, "noise": advice.noise}
    return {**told, "probabilities": dict(advice.probabilities)}


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
        "judgement": STAND_IN
        if candidate.stand_in
        else _judgement(candidate.adopted, candidate.tied_with, candidate.p, candidate.advantage),
        "rmse": candidate.rmse,
        "cv_rmse": candidate.cv_rmse,
        "p_value": candidate.p,
        "advantage": candidate.advantage,
        "share": candidate.share,
        "parameters": dict(candidate.parameters or {}),
        "at_bound": list(candidate.at_bound),
        "tied_with": list(candidate.tied_with),
    }


def _judgement(adopted: bool, tied_with: Sequence[str], p: float | None, advantage: float | None) -> str:
    if adopted:
        return ADOPTED
    if tied_with:
        return TIED
    clear = p is not None and advantage is not None and p < LEVEL and advantage > CLEAR
    return PARTIAL if clear else NEEDLESS


def _thinned(rows: pd.DataFrame) -> pd.DataFrame:
    """Evenly spread rows, at most DRAWN."""
    return rows.iloc[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), DRAWN)).astype(int))]


def _plain(value: Any) -> Any:
    """What JSON can hold: numbers that are not finite are absent."""
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value.item() if hasattr(value, "item") else value
