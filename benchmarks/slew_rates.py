"""Are limits of the rate before the law named, whatever their formula, and followed?

    python benchmarks/slew_rates.py [--laws bouc-wen] [--effects servo,valve] [--seed 5] [--jobs 1]

Loops of a law that is given, by code of their own, driven by what follows the measured input no faster than something
allows: records, noise, and what is told as of undeclared_effects.py.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from foreign_laws import lagging
from numpy.random import Generator
from undeclared_effects import STEP, Form, Made, ask, none

from hysteresis_bench.arrays import Array

PARTS = 8
"""Steps from one sample to the next."""


def _followed(u: Array, rate: Callable[[float, float], float]) -> Array:
    """rate : of what follows, by where it is and by how far it is behind"""
    state, out = float(u[0]), np.empty_like(u)
    for i, now in enumerate(u):
        for part in range(PARTS):
            goal = now + (u[max(i - 1, 0)] - now) * (PARTS - 1 - part) / PARTS
            state += rate(state, (goal - state) * PARTS / STEP) * STEP / PARTS
        out[i] = state
    return out


def _limited(low: float, high: float) -> Callable[[float, float], float]:
    return lambda state, asked: min(max(asked, -low), high)


def _amplifier(one: Made, rng: Generator) -> Array:
    """A current that ends at the same height on both sides."""
    return one.law(_followed(one.u, _limited(4.0, 4.0)))


def _hard(one: Made, rng: Generator) -> Array:
    """The slow records feel it as well."""
    return one.law(_followed(one.u, _limited(2.5, 2.5)))


def _slight(one: Made, rng: Generator) -> Array:
    """Of the fastest record the steepest parts only."""
    return one.law(_followed(one.u, _limited(6.5, 6.5)))


def _cylinder(one: Made, rng: Generator) -> Array:
    """A rod on one side: faster in than out."""
    return one.law(_followed(one.u, _limited(3.5, 6.0)))


def _servo(one: Made, rng: Generator) -> Array:
    """A loop around it with a gain, whose rate is limited."""
    return one.law(_followed(one.u, lambda state, asked: min(max(asked * STEP / PARTS / 0.02, -4.0), 4.0)))


def _valve(one: Made, rng: Generator) -> Array:
    """A servo whose rate saturates smoothly."""
    return one.law(_followed(one.u, lambda state, asked: 5.0 * np.tanh(asked * STEP / PARTS / 0.15)))


def _loaded(one: Made, rng: Generator) -> Array:
    """Slower the further out, as against a spring."""

    def rate(state: float, asked: float) -> float:
        top = 5.0 * (1.0 - 0.4 * abs(state))
        return min(max(asked, -top), top)

    return one.law(_followed(one.u, rate))


def _after_a_lag(one: Made, rng: Generator) -> Array:
    return one.law(_followed(lagging(one.u, STEP, 0.01), _limited(4.0, 4.0)))


EFFECTS: dict[str, Form] = {
    "none": none,
    "amplifier": _amplifier,
    "hard": _hard,
    "slight": _slight,
    "cylinder": _cylinder,
    "servo": _servo,
    "valve": _valve,
    "loaded": _loaded,
    "after a lag": _after_a_lag,
}

if __name__ == "__main__":
    ask(__doc__.partition("\n")[0], EFFECTS)
