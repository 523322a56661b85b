"""The records without a disturbance that was found, such as a hum or fringes: a fast one had passed for noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.signals import Record

DISTURBANCES = ("added disturbance", "cyclic error")
"""Families of effects whose ripple may be heard as noise."""


def undisturbed(fitter: Fitter, hypothesis: Hypothesis) -> tuple[Record, ...]:
    """The fitted records themselves where the hypothesis has no disturbance."""
    stack = fitter.stack
    silent = {
        f"{name}.{p.name}": p.null
        for name in sorted(hypothesis.names)
        if stack.effect(name).family in DISTURBANCES and not stack.effect(name).nuisance
        for p in stack.effect(name).parameters
        if p.null is not None
    }
    if not silent:
        return stack.records
    system, loud = fitter.fitted(hypothesis)
    _, still = fitter.fitted(replace(hypothesis, values={**hypothesis.values, **silent}))
    both = np.column_stack([loud, still])
    quiet = []
    for record in stack.records:
        heard, unheard = record.at_samples(system.simulate(record.signal, both)).T
        assert record.output is not None
        quiet.append(replace(record, output=record.output - (heard - unheard)))
    return tuple(quiet)
