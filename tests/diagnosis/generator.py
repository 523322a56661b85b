"""Data with hidden effects, made without the effects' own code: other formulas, other discretisations, and
samples FINER times closer than those that are handed out.

What is hidden is drawn from a seed; strengths are such that an effect left out about doubles the error, or more, at a
noise of half a percent of the range, although the model is fitted again without it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator, default_rng
from scipy.signal import bilinear, lfilter, lfilter_zi

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Dataset, Record, Signal

FINER = 10
SAMPLES = 400
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
    rng = default_rng([seed, sorted(MODELS).index(model)])
    if hidden is None:
        hidden = tuple(sorted(str(one) for one in rng.choice(EFFECTS, rng.integers(0, 4), replace=False)))
    share = rng.uniform(0.002, 0.01) if noise is None else noise
    amplitude, centre = MODELS[model]
    values = {name: value * rng.uniform(0.85, 1.15) for name, value in centre.items()}
    strengths = {name: rng.uniform(0.0, 1.0, 3) for name in EFFECTS}
    tone = rng.uniform(0.9, 1.1)
    names = ["fit-1", "fit-2", "fit-3", "fit-4", *HELD_OUT, "unseen"]
    frequencies = tone * np.array([1.0, 3.0, 0.5, 6.0, 2.0, 4.0, 1.5])
    clean = [
        _response(model, values, amplitude, float(f), number, set(hidden), strengths, rng)
        for number, f in enumerate(frequencies)
    ]
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
    hidden: set[str],
    strengths: dict[str, Array],
    rng: Generator,
) -> tuple[Array, Array, Array, Array]:
    cycles, fastest, slowest = 5.0, 6.0, 0.5
    time = np.linspace(0.0, cycles / frequency, (SAMPLES - 1) * FINER + 1)
    drive = amplitude * _drive(time * frequency, number)
    s = strengths
    u = drive
    if "input-lag" in hidden:
        u = _first_order(time, u, (0.1 + 0.25 * s["input-lag"][0]) / (2 * np.pi * fastest))
    if "asymmetry" in hidden:
        bend = (0.1 + 0.2 * s["asymmetry"][0]) * (1 if s["asymmetry"][1] > 0.5 else -1)
        u = u * (1.0 + bend * u / amplitude)
    if "backlash" in hidden:
        u = _clearance(u, (0.3 + 0.15 * s["backlash"][0]) * amplitude)
    plugin = registry.build("models", model)
    named = type("Values", (), {key: np.array([value]) for key, value in values.items()})()
    y = plugin.simulate(Signal(time, np.ascontiguousarray(u[:, None])), named)[:, 0]
    largest = _largest(model, values, amplitude)
    if "saturation" in hidden:
        level = largest * (0.35 + 0.2 * s["saturation"][0])
        y = level * np.tanh(y / level)
    if "fatigue" in hidden:
        path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(drive)))]) / (20.0 * amplitude)
        y = y * np.exp2(-(0.3 + 0.5 * s["fatigue"][0]) * path)
    temperature = 25.0 + 10.0 * np.sin(2 * np.pi * (0.13 * number + 0.31 * time * frequency + 0.2))
    if "temperature-sensitivity" in hidden:
        y = y * (1.0 + (0.01 + 0.005 * s["temperature-sensitivity"][0]) * (temperature - 20.0))
    if "creep" in hidden:
        late = (0.12 + 0.2 * s["creep"][0]) * y / 3.0
        mean = 0.1 * 10.0 ** s["creep"][1]
        y = y + sum(_first_order(time, late, mean * 10.0**decade) - late for decade in (-0.6, 0.0, 0.6))
    if "output-lag" in hidden:
        y = _first_order(time, y, (0.1 + 0.25 * s["output-lag"][0]) / (2 * np.pi * fastest))
    if "resonance" in hidden:
        natural = 2 * np.pi * fastest * (3.0 + 3.0 * s["resonance"][0])
        y = _second_order(time, y, natural, 0.05 + 0.25 * s["resonance"][1])
    if "transport-delay" in hidden:
        delay = (0.1 + 0.25 * s["transport-delay"][0]) / (2 * np.pi * fastest)
        y = np.interp(time - delay, time, y)
    if "periodic-disturbance" in hidden:
        hum = 7.3 + 9.0 * s["periodic-disturbance"][0]
        swing = 0.06 + 0.06 * s["periodic-disturbance"][1]
        y = y + swing * largest * np.cos(2 * np.pi * (hum * time - s["periodic-disturbance"][2]))
    if "drift" in hidden:
        y = y + (0.15 + 0.2 * s["drift"][0]) * largest * time * slowest / cycles
    handed = slice(None, None, FINER)
    return time[handed], drive[handed], y[handed], temperature[handed]


def _largest(model: str, values: dict[str, float], amplitude: float) -> float:
    """The response to the full input, without any effect."""
    named = type("Values", (), {key: np.array([value]) for key, value in values.items()})()
    rise = np.linspace(0.0, amplitude, 500)
    plugin = registry.build("models", model)
    return float(plugin.simulate(Signal(rise, np.ascontiguousarray(rise[:, None])), named)[-1, 0])


def _first_order(time: Array, x: Array, constant: float) -> Array:
    """Tustin's rule on the fine grid."""
    step = time[1] - time[0]
    b, a = bilinear([1.0], [constant, 1.0], 1.0 / step)
    return lfilter(b, a, x, zi=lfilter_zi(b, a) * x[0])[0]


def _second_order(time: Array, x: Array, natural: float, damping: float) -> Array:
    step = time[1] - time[0]
    b, a = bilinear([natural**2], [1.0, 2.0 * damping * natural, natural**2], 1.0 / step)
    return lfilter(b, a, x, zi=lfilter_zi(b, a) * x[0])[0]


def _clearance(u: Array, half: float) -> Array:
    """A body between two walls that move with the input."""
    body, out = float(u[0]), np.empty_like(u)
    for place, wall in enumerate(u.tolist()):
        if wall - half > body:
            body = wall - half
        elif wall + half < body:
            body = wall + half
        out[place] = body
    return out
