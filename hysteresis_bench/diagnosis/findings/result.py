"""The result of a diagnosis: everything that a table, a file or a page tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from typing import Any, Literal

import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.memory import Memory
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest
from hysteresis_bench.diagnosis.findings.advice import Advice
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.fit.accuracy import Accuracy
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.objective import Problem

Verdict = Literal["effect-found", "no-effect-needed", "unexplained-residual"]


@dataclass(frozen=True, eq=False)
class Stage:
    """A system with its parameters, and how far it is from the measurements.

    values : (dimension,), in units;  names : of its effects
    """

    names: tuple[str, ...]
    problem: Problem
    values: Array
    fitted: Accuracy
    held_out: Accuracy | None
    tests: tuple[ResidualTest, ...]


@dataclass(frozen=True, eq=False)
class Candidate:
    """An effect that was considered, on top of the final system; an adopted one, against the system without it.

    p : of the nested-model test, not corrected;  advantage : standard errors by which it won on blocks left out
    share : of the mean square left over the noise without it, what it explains
    cv_rmse : NaN where it is not applicable, for the `reason`;  parameters : its own, in units
    """

    effect: str
    applicable: bool
    reason: str = ""
    adopted: bool = False
    rmse: float = float("nan")
    cv_rmse: float = float("nan")
    p: float = float("nan")
    advantage: float = float("nan")
    parameters: Mapping[str, float] | None = None
    at_bound: tuple[str, ...] = ()
    tied_with: tuple[str, ...] = ()
    share: float = float("nan")


@dataclass(frozen=True)
class Step:
    """One step of the search: what was there, what each candidate made of it, what was taken.

    cv_rmse : by candidate
    """

    names: tuple[str, ...]
    rmse: float
    cv_rmse: Mapping[str, float]
    p: Mapping[str, float]
    chosen: str


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What was found.

    headline : the verdict as a sentence
    effects : adopted, the largest first;  waterfall : label and RMSE on the fitted records, from the bare model
    to the noise;  responses : record, role, time, input, output, before, after over the scored samples
    offset : "", "bias" or "record-offset", as both before and after have it
    equation : what describes the residual that remains;  model : ready to predict and to be written
    """

    model_name: str
    verdict: Verdict
    headline: str
    effects: tuple[str, ...]
    offset: str
    before: Stage
    after: Stage
    noise: Noise
    floor: float
    candidates: tuple[Candidate, ...]
    steps: tuple[Step, ...]
    waterfall: tuple[tuple[str, float], ...]
    ties: tuple[Tie, ...]
    advice: Advice | None
    memory: Memory
    equation: Equation | None
    model: FittedModel
    responses: pd.DataFrame
    split: Mapping[str, Any]
    warnings: tuple[str, ...]
    units: Mapping[str, str]

    def _repr_html_(self) -> str:
        """For a notebook: the headline, the errors before and after, the candidates, the warnings."""
        stages = {"before": self.before, "after": self.after}
        errors = pd.DataFrame(
            {
                name: {"fitted": stage.fitted.rmse, "held out": stage.held_out.rmse if stage.held_out else None}
                for name, stage in stages.items()
            }
        )
        shown = [
            {"effect": each.effect, "adopted": each.adopted, "RMSE": each.rmse, "left out": each.cv_rmse, "p": each.p}
            for each in self.candidates
            if each.applicable
        ]
        tables = (errors.to_html(float_format="%.4g"), pd.DataFrame(shown).to_html(index=False, float_format="%.4g"))
        sentences = "".join(f"<p>{escape(warning)}</p>" for warning in self.warnings)
        return f"<p>{escape(self.headline)}</p>{''.join(tables)}{sentences}"
