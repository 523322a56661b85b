"""The result of a diagnosis: everything that a table, a file or a page tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any, Literal

import pandas as pd

from hysteresis_bench.diagnosis.ceiling.ceiling import Ceiling
from hysteresis_bench.diagnosis.doubt.agreement import Agreement
from hysteresis_bench.diagnosis.doubt.cause import Cause
from hysteresis_bench.diagnosis.evidence.memory import Memory
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.experiments.settled import Measured
from hysteresis_bench.diagnosis.families import FamilyFinding
from hysteresis_bench.diagnosis.findings.advice import Advice
from hysteresis_bench.diagnosis.findings.candidates import Candidate, Step
from hysteresis_bench.diagnosis.findings.stages import Stage
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis.laws.comparison import Comparison
from hysteresis_bench.diagnosis.search.certainty import Certainty
from hysteresis_bench.diagnosis.search.fallback import Fallback
from hysteresis_bench.fit.model_file import FittedModel

Verdict = Literal["effect-found", "no-effect-needed", "unexplained-residual"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Diagnosis:
    """What was found.

    headline : the verdict as a sentence
    better_law : one that does clearly better than the law that was asked about, or as well with less around it
    agreement : of the laws on what is needed, where this one does not follow the data and none does clearly better
    carrying : of the stand-ins, what carries the loop alone: another law
    stand_ins : adopted, and in the final model, but not named: not needed around a law that does better, or as well,
    or an offset beside something that is not explained
    effects : adopted and named, the largest first;  waterfall : label and RMSE on the fitted records, from the bare
    model to the noise;  responses : record, role, time, input, output, before, after over the scored samples
    offset : "" or an effect's name, as both before and after have it;  floor : RMS below which nothing is judged
    given_up : effects that had been selected but predicted excitations left out worse, or that one loop cannot test
    unseen : RMSE of the final system on excitations left out of its fit, thinned; of a lone record, on blocks of it
    doubtful : so much is left that the names may stand in for something else, or they do not help on what is held out
    certainty : of each claimed effect
    ceiling : what the final system and the best black box reach on excitations left out
    families : what none of its formulas fits, each with its curve
    laws : all laws, where no model was asked about;  equation : what describes the residual that remains
    measured : the advised experiment of an earlier diagnosis, which is among the fitted records here
    model : ready to predict and to be written
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
    given_up: Fallback | None
    unseen: float
    stand_ins: tuple[str, ...] = ()
    carrying: tuple[str, ...] = ()
    better_law: Cause | None = None
    agreement: Agreement | None = None
    doubtful: bool = False
    families: tuple[FamilyFinding, ...] = ()
    certainty: Mapping[str, Certainty] = field(default_factory=dict)
    laws: Comparison | None = None
    ceiling: Ceiling | None = None
    measured: Measured | None = None

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
