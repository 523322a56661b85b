"""Which experiment would tell two fitted systems apart? Both are simulated over signals that the rig can play."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from hysteresis_bench.diagnosis.experiments.catalogue import catalogue, sampled
from hysteresis_bench.diagnosis.experiments.power import Fitted, Left, told_apart
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.preparation import AS_IT_IS, Preparation
from hysteresis_bench.signals import Record, Signal

SAME = 1e-3
"""Times the noise below which two fitted systems are the same, whatever is measured."""

ROUNDING = 1e-9
"""Of what is to be seen: records without any noise leave that much."""

LIKELY = 0.8
"""Probability from which one record of the experiment is expected to settle the question."""

HIDDEN = 0.3
"""Separation over noise below which no number of repeats that anyone makes is enough."""


@dataclass(frozen=True, eq=False)
class Advice:
    """experiment : in words, empty where none helps
    separation : RMS by which the closest of the tied systems differ there, unit of the output
    noise : RMS of the noise, for comparison
    probabilities : by rival, that one record of the experiment tells it from the adopted effect (see `power`)
    drive : the experiment as the device's input, without an output, sampled as the records are; None where none helps
    """

    experiment: str
    separation: float
    noise: float
    words: str
    probabilities: Mapping[str, float] = field(default_factory=dict)
    drive: Record | None = None


def advise(
    tied: Mapping[str, Fitted],
    records: tuple[Record, ...],
    noise: float,
    *,
    left: Left | None = None,
    preparation: Preparation = AS_IT_IS,
) -> Advice | None:
    """The experiment in which the least different of the rivals differs most.

    tied : fitted systems by their effects' names, ours first;  records : as a model sees them, by this preparation
    left : by ours, where that is not white noise
    """
    first, *rivals = tied
    experiments = list(catalogue(records, preparation))
    try:
        apart = np.array([[_apart(tied[first], tied[name], one.signal) for name in rivals] for one in experiments])
    except ValueError:  # an effect that needs a column, such as the temperature, has no say in a new signal
        return None
    apart = np.where(np.isfinite(apart), apart, 0.0)
    different = np.max(apart, axis=0) > SAME * noise
    others = np.array(rivals)
    alike = f"No feasible signal tells {listed([first, *others[~different]])} apart: for this model they are the same."
    if not different.any():
        return Advice("", float(apart.max()), noise, alike)
    least = np.min(apart[:, different], axis=1)
    best, experiment = float(least.max()), experiments[int(np.argmax(least))]
    record, heard = sampled(experiment, records), left or Left(noise)
    heard = replace(heard, rms=max(heard.rms, ROUNDING * best))
    probabilities = {
        str(name): told_apart(tied[first], tied[name], record, heard) for name in others[different].tolist()
    }
    device = np.array([preparation.measured_input(seen) for seen in record.input.tolist()])
    unit = records[0].units.get("output", "1")
    ratio = best / noise if noise > 0 else np.inf
    words = (
        f"To tell {listed([first, *others[different]])} apart, measure {experiment.words}: the fitted models differ "
        f"there by {best:.3g}{'' if unit == '1' else ' ' + unit} RMS, {ratio:.{0 if ratio >= 10.0 else 1}f} times the "
        f"noise; {_hope(min(probabilities.values()), ratio)}."
    )
    drive = replace(record, input=device, output=None)
    return Advice(experiment.words, best, noise, words if different.all() else f"{words} {alike}", probabilities, drive)


def _hope(probability: float, ratio: float) -> str:
    """How likely one record of it settles the question."""
    told = "more than 99%" if probability > 0.99 else "less than 1%" if probability < 0.01 else f"{probability:.0%}"
    settles = f"one record of it settles that with an expected probability of {told}"
    if probability >= LIKELY:
        return settles
    more = "average over repeats" if ratio > HIDDEN else "a faster or more precise rig is needed"
    return f"{settles}: {more}"


def _apart(ours: Fitted, rival: Fitted, signal: Signal) -> float:
    outputs = [one.problem.system.simulate(signal, one.values[:, None])[:, 0] for one in (ours, rival)]
    return float(np.std(outputs[0] - outputs[1]))
