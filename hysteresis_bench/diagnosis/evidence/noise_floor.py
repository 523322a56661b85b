"""The RMS error below which nothing is judged, and the noise that is left when a hum is taken out of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.diagnosis.evidence.noise import Noise, unresolved
from hysteresis_bench.diagnosis.search.hypotheses import Bench, Trial
from hysteresis_bench.signals import Record

FINEST = 5e-4
"""Share of the output's range below which an error is rounding and numerics, whatever the noise."""


def floor_of(records: Sequence[Record], noise: Noise) -> float:
    """RMS below which nothing is judged: noise, what lies between the samples, rounding."""
    span = max(float(np.ptp(record.measured)) for record in records)
    return max(float(np.hypot(noise.floor, unresolved(records))), FINEST * span)


def without_hum(bench: Bench, trial: Trial) -> tuple[Record, ...]:
    """The records without the disturbances that were found."""
    found = {name: bench.stack.effect(name) for name in trial.names}
    hums = {name: effect for name, effect in found.items() if effect.family == "added disturbance"}
    if not hums:
        return bench.stack.records
    silent = {f"{name}.{p.name}": p.null for name, one in hums.items() for p in one.parameters if p.null is not None}
    system, loud = bench.fitted(trial)
    _, still = bench.fitted(replace(trial, values={**trial.values, **silent}))
    both = np.column_stack([loud, still])
    quiet = []
    for record in bench.stack.records:
        heard, unheard = system.simulate(record.signal, both).T
        quiet.append(replace(record, output=record.output - (heard - unheard)))
    return tuple(quiet)
