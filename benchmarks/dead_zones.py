"""Are dead zones of the input and of the output named, whatever their formula, and followed?

    python benchmarks/dead_zones.py [--laws bouc-wen] [--effects overlap,deaf] [--seed 5] [--jobs 1]

Loops of a law that is given, by code of their own, with a range of the input or of the output in which little or
nothing moves: records, noise, and what is told as of undeclared_effects.py.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from undeclared_effects import Form, Made, ask, none

from hysteresis_bench.arrays import Array


def _beyond(x: Array, low: float, high: float) -> Array:
    return np.maximum(x - high, 0.0) + np.minimum(x - low, 0.0)


def _overlap(one: Made, rng: Generator) -> Array:
    """A valve's spool overlaps its ports."""
    return one.law(_beyond(one.u, -0.08, 0.08))


def _one_sided(one: Made, rng: Generator) -> Array:
    return one.law(_beyond(one.u, 0.0, 0.12))


def _unequal(one: Made, rng: Generator) -> Array:
    """Wider on one side, and steeper there."""
    beyond = _beyond(one.u, -0.05, 0.12)
    return one.law(np.where(one.u < 0.0, 1.3 * beyond, beyond))


def _leaking(one: Made, rng: Generator) -> Array:
    """A tenth passes within it."""
    return one.law(0.1 * one.u + 0.9 * _beyond(one.u, -0.1, 0.1))


def _rounded(one: Made, rng: Generator) -> Array:
    """Edges worn round: soft thresholds, 0.025 wide."""
    return one.law(0.025 * (np.logaddexp(0.0, (one.u - 0.1) / 0.025) - np.logaddexp(0.0, -(one.u + 0.1) / 0.025)))


def _deaf(one: Made, rng: Generator) -> Array:
    """A sensor that does not answer to little."""
    return _beyond(one.y, -0.04 * one.span, 0.04 * one.span)


def _deaf_aside(one: Made, rng: Generator) -> Array:
    """A worn spot of a potentiometer."""
    return one.y - np.clip(one.y - 0.06 * one.span, 0.0, 0.08 * one.span)


EFFECTS: dict[str, Form] = {
    "none": none,
    "overlap": _overlap,
    "one-sided": _one_sided,
    "unequal": _unequal,
    "leaking": _leaking,
    "rounded": _rounded,
    "deaf": _deaf,
    "deaf aside": _deaf_aside,
}

if __name__ == "__main__":
    ask(__doc__.partition("\n")[0], EFFECTS)
