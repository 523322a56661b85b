"""Data with hidden effects, made without the effects' own code: by the last formula that each declares for this, with
samples FINER times closer than those that are handed out. The virtual rig takes the first.

What is hidden is drawn from a seed; strengths are such that an effect left out about doubles the error, or more, at a
noise of half a percent of the range, although the model is fitted again without it.
"""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator, default_rng

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Hiding
from hysteresis_bench.diagnosis_study.hidden_effects import hiding
from hysteresis_bench.signals import Dataset, Record, Signal

FINER = 10
SAMPLES = 400
CYCLES, SLOWEST, FASTEST = 5.0, 0.5, 6.0
HELD_OUT = ("held-1", "held-2")

MODELS = {
    "bouc-wen": (5.0, {"alpha": 0.3, "beta": 0.6, "gamma": 0.2, "d": 1.0}),
    "jiles-atherton": (4000.0, {"alpha": 4e-4, "a": 900.0, "k": 700.0, "M_s": 1.2e6, "c": 0.15}),
    "free-energy": (4.0, {"M_R": 1.0, "eta": 5.0, "H_c": 1.0, "b": 1.0, "c": 0.4, "alpha": 0.6}),
}
"""Amplitude of the input, and the parameters about which those of a case are drawn."""

EFFECTS = (
    "asymmetry",
    "backlash",
    "creep",
    "drift",
    "fatigue",
    "input-lag",
    "output-lag",
    "periodic-disturbance",
    "resonance",
    "saturation",
    "temperature-sensitivity",
    "transport-delay",
)


@dataclass(frozen=True, eq=False)
class Case:
    """dataset : fitted and held-out records;  unseen : neither;  noise : RMS that was added."""

    model: str
    hidden: tuple[str, ...]
    dataset: Dataset
    unseen: tuple[Record, ...]
    noise: float


def make(seed: int, model: str, hidden: Sequence[str] | None = None, noise: float | None = None) -> Case:
    """One case. hidden : by name; None draws none to three;  noise : share of the range; None draws it."""
    key = [seed, sorted(MODELS).index(model)]
    rng = default_rng(key)
    if hidden is None:
        hidden = tuple(sorted(str(one) for one in rng.choice(EFFECTS, rng.integers(0, 4), replace=False)))
    share = rng.uniform(0.002, 0.01) if noise is None else noise
    amplitude, centre = MODELS[model]
    values = {name: value * rng.uniform(0.85, 1.15) for name, value in centre.items()}
    drawn = _drawn(rng, key, hidden)
    tone = rng.uniform(0.9, 1.1)
    names = ["fit-1", "fit-2", "fit-3", "fit-4", *HELD_OUT, "unseen"]
    frequencies = tone * np.array([1.0, 3.0, 0.5, 6.0, 2.0, 4.0, 1.5])
    clean = [_response(model, values, amplitude, float(f), number, drawn) for number, f in enumerate(frequencies)]
    span = max(float(np.ptp(output)) for _, _, output, _ in clean)
    records = []
    for name, (time, drive, output, temperature) in zip(names, clean, strict=True):
        measured = output + share * span * rng.standard_normal(time.size)
        columns = {"temperature": temperature} if "temperature-sensitivity" in hidden else {}
        records.append(Record(time, drive, measured, name, columns=columns))
    return Case(model, tuple(hidden), Dataset(tuple(records[:-1]), HELD_OUT), tuple(records[-1:]), share * span)


def _drive(phase: Array, number: int) -> Array:
    """Between -1 and 1, from 0: decaying loops, minor loops, an amplitude that swells, a triangle that shrinks."""
    kind = number % 4
    if kind == 0:
        return np.sin(2 * np.pi * phase) * (1.0 - 0.13 * phase)
    if kind == 1:
        return 0.75 * np.sin(2 * np.pi * phase) + 0.25 * np.sin(2 * np.pi * 3.3 * phase)
    if kind == 2:
        return np.sin(2 * np.pi * phase) * (0.35 + 0.12 * phase)
    return 2.0 / np.pi * np.arcsin(0.999 * np.sin(2 * np.pi * phase)) * (1.0 - 0.1 * phase)


def _response(
    model: str,
    values: dict[str, float],
    amplitude: float,
    frequency: float,
    number: int,
    drawn: dict[str, list[float]],
) -> tuple[Array, Array, Array, Array]:
    """drawn : a strength and two more numbers for every hidden effect"""
    time = np.linspace(0.0, CYCLES / frequency, (SAMPLES - 1) * FINER + 1)
    drive = amplitude * _drive(time * frequency, number)
    temperature = 25.0 + 10.0 * np.sin(2 * np.pi * (0.13 * number + 0.31 * time * frequency + 0.2))
    plugin, named = registry.build("models", model), _named(values)
    top, step = _largest(model, values, amplitude), float(time[1] - time[0])
    hidden = {}
    for name, (strength, *free) in drawn.items():
        given = Hiding(
            strength, (*free, strength), time, drive, temperature, step, CYCLES / SLOWEST, FASTEST, amplitude, top
        )
        hidden[name] = (registry.effect(name).hidden_forms[-1], given)

    def bare(u: Array) -> Array:
        return plugin.simulate(Signal(time, np.ascontiguousarray(u[:, None])), named)[:, 0]

    y = hiding(bare, hidden)(drive)
    handed = slice(None, None, FINER)
    return time[handed], drive[handed], y[handed], temperature[handed]


def _drawn(rng: Generator, key: list[int], hidden: Sequence[str]) -> dict[str, list[float]]:
    """Strength and two more numbers for every hidden effect."""
    drawn = {name: rng.uniform(0.0, 1.0, 3).tolist() for name in EFFECTS}
    drawn |= {name: default_rng([*key, *name.encode()]).random(3).tolist() for name in hidden if name not in EFFECTS}
    # what these three drew first is not their strength: kept, so that the cases stay what they are
    for name in ("resonance", "saturation"):
        drawn[name][0] = 1.0 - drawn[name][0]
    frequency, *swing_and_phase = drawn["periodic-disturbance"]
    drawn["periodic-disturbance"] = [*swing_and_phase, frequency]
    return {name: drawn[name] for name in hidden}


def _named(values: dict[str, float]) -> Any:
    return namedtuple("Values", values)(*(np.array([value]) for value in values.values()))


def _largest(model: str, values: dict[str, float], amplitude: float) -> float:
    """The response to the full input, without any effect."""
    rise = np.linspace(0.0, amplitude, 500)
    plugin = registry.build("models", model)
    return float(plugin.simulate(Signal(rise, np.ascontiguousarray(rise[:, None])), _named(values))[-1, 0])
