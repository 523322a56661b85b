"""Are cyclic errors named, whatever their waveform, and followed?

    python benchmarks/cyclic_errors.py [--laws bouc-wen] [--effects fringes,teeth] [--seed 5] [--jobs 1]

Loops of a law that is given, by code of their own, with an error that repeats itself along the input or the output:
records, noise, and what is told as of undeclared_effects.py.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from undeclared_effects import Form, Made, ask, none

from hysteresis_bench.arrays import Array


def _wave(course: Array, period: float) -> Array:
    return np.sin(2 * np.pi * course / period + 0.7)


def _fringes(one: Made, rng: Generator) -> Array:
    """An interferometer's error, once a fringe of the output."""
    return one.y + 0.02 * one.span * _wave(one.y, 0.08 * one.span)


def _quadrature(one: Made, rng: Generator) -> Array:
    """Of one whose two signals have offsets and unequal gains, and are not at right angles."""
    turn = 2 * np.pi * one.y / (0.16 * one.span) + 1.0
    signal = np.cos(turn) + 0.25 + 1j * (0.8 * np.sin(turn + 0.3) - 0.1)
    return one.y + 0.16 * one.span / (2 * np.pi) * np.angle(signal * np.exp(-1j * turn))


def _teeth(one: Made, rng: Generator) -> Array:
    """Of a motor or a gear, once a tooth of the input."""
    return one.y + 0.02 * one.span * _wave(one.u, 0.15)


def _fine_teeth(one: Made, rng: Generator) -> Array:
    return one.y + 0.01 * one.span * _wave(one.u, 0.06)


def _two_teeth(one: Made, rng: Generator) -> Array:
    """Of two wheels."""
    return one.y + 0.01 * one.span * (_wave(one.u, 0.15) + _wave(one.u, 0.107))


def _bumps(one: Made, rng: Generator) -> Array:
    return one.y + 0.03 * one.span * np.abs(_wave(one.u, 0.4))


def _saw(one: Made, rng: Generator) -> Array:
    """Falls off at once behind every tooth."""
    return one.y + 0.03 * one.span * ((one.u / 0.21 + 0.3) % 1.0)


def _third_harmonic(one: Made, rng: Generator) -> Array:
    return one.y + 0.012 * one.span * (_wave(one.u, 0.22 / 3) + 0.3 * _wave(one.u, 0.22))


def _encoder(one: Made, rng: Generator) -> Array:
    """Of the input: what acts is not what was read."""
    return one.law(one.u + 0.015 * _wave(one.u, 0.15))


EFFECTS: dict[str, Form] = {
    "none": none,
    "fringes": _fringes,
    "quadrature": _quadrature,
    "teeth": _teeth,
    "fine teeth": _fine_teeth,
    "two teeth": _two_teeth,
    "bumps": _bumps,
    "saw": _saw,
    "third harmonic": _third_harmonic,
    "encoder": _encoder,
}

if __name__ == "__main__":
    ask(__doc__.partition("\n")[0], EFFECTS)
