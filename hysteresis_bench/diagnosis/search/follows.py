"""Does the output answer to the input at all? Before any effect is named, the response must explain it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis

EXPLAINED = 0.5
"""Share of the output's variance that the response to the input must explain before any effect is named."""


def follows(fitter: Fitter, hypothesis: Hypothesis) -> bool:
    """Does the response to the input, without what is merely added to it, explain the output?"""
    stack = fitter.stack
    added = {name for name in hypothesis.names if stack.effect(name).acts == "added"} - {registry.RECORD_OFFSET}
    answering, own = fitter.fitted(replace(hypothesis, names=hypothesis.names - added))
    whole, every = fitter.fitted(hypothesis)
    left = explained = 0.0
    for record in stack.records:
        response = answering.respond(record, own[:, None])[record.scored, 0]
        error = record.measured - whole.respond(record, every[:, None])[record.scored, 0]
        left += float(error @ error)
        explained += float(np.sum((response - response.mean()) ** 2))
    return explained > EXPLAINED / (1.0 - EXPLAINED) * left
