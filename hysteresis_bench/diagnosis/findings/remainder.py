"""What the final system leaves: does it matter, and which terms describe it?"""

from __future__ import annotations

from hysteresis_bench.diagnosis.evidence.evidence import Evidence
from hysteresis_bench.diagnosis.evidence.residual_tests import OVERALL
from hysteresis_bench.diagnosis.findings.stages import Stage, left_by
from hysteresis_bench.diagnosis.findings.terms import Equation, find_terms

REMAINS = 1.1
"""RMSE over noise from which what is left matters."""

TELLING = 0.03
"""Share of the residual's variance from which a dependence matters."""


def remainder(stage: Stage, evidence: Evidence) -> tuple[Equation | None, bool]:
    """What describes the remaining residual, and whether it matters."""
    views, floor = evidence.views, evidence.floor
    scope = OVERALL if len(views) > 1 else views[0].record.name
    tests = [test for test in stage.tests if test.record == scope and test.significant]
    loud = stage.fitted.rmse > REMAINS * floor and any(test.name == "noise-floor" for test in tests)
    telling = [
        t for t in tests if t.share > TELLING and t.name not in ("noise-floor", "offset") and "scatter" not in t.name
    ]
    if stage.fitted.rmse <= floor or not (loud or telling):
        return None, False
    residuals, simulated = left_by(stage, views)
    return find_terms([view.record for view in views], residuals, simulated), True
