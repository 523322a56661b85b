"""Is an output that passes modes named, or told with its gain, and followed?

    python benchmarks/modes.py [--laws bouc-wen] [--effects two,antiresonance] [--seed 5] [--jobs 1]

Loops of a law that is given, by code of their own, whose output passes masses on springs before it is measured, by
Tustin's rule: records, noise, and what is told as of undeclared_effects.py.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.polynomial import Polynomial
from numpy.random import Generator
from scipy.signal import bilinear, lfilter, lfilter_zi
from undeclared_effects import STEP, Form, Made, ask, none

from hysteresis_bench.arrays import Array

UNIT = Polynomial([1.0])


def _mode(frequency: float, damping: float) -> Polynomial:
    omega = 2.0 * np.pi * frequency
    return Polynomial([1.0, 2.0 * damping / omega, 1.0 / omega**2])


def _through(x: Array, above: Polynomial, below: Polynomial) -> Array:
    """A ratio of polynomials in s, from equilibrium with the first sample."""
    b, a = bilinear(above.coef[::-1], below.coef[::-1], 1.0 / STEP)
    passed: Array = lfilter(b, a, x, zi=lfilter_zi(b, a) * x[0])[0]
    return passed


def _sum(y: Array, *modes: tuple[float, float, float]) -> Array:
    """Frequency, damping ratio and weight of each."""
    return sum((weight * _through(y, UNIT, _mode(f, zeta)) for f, zeta, weight in modes), np.zeros_like(y))


def _one(one: Made, rng: Generator) -> Array:
    return _sum(one.y, (7.0, 0.1, 1.0))


def _two(one: Made, rng: Generator) -> Array:
    return _sum(one.y, (7.0, 0.1, 0.8), (17.0, 0.1, 0.2))


def _opposed(one: Made, rng: Generator) -> Array:
    """The second mode moves against the first, as of a sensor that is not where the force acts."""
    return _sum(one.y, (6.0, 0.15, 1.3), (14.0, 0.1, -0.3))


def _beside(one: Made, rng: Generator) -> Array:
    """A fifth of the motion in a mode of the frame, the rest follows at once."""
    return 0.8 * one.y + _sum(one.y, (5.0, 0.05, 0.2))


def _antiresonance(one: Made, rng: Generator) -> Array:
    """A mass that absorbs one frequency."""
    return _through(one.y, _mode(6.0, 0.05), _mode(7.5, 0.1))


def _mount(one: Made, rng: Generator) -> Array:
    """A sensor on a soft mount, whose damper acts on it as well."""
    return _through(one.y, Polynomial([1.0, 0.4 / (2.0 * np.pi * 6.0)]), _mode(6.0, 0.2))


def _series(one: Made, rng: Generator) -> Array:
    """A device with a mode, and an amplifier's filter of second order behind it."""
    passed = _through(one.y, UNIT, _mode(8.0, 0.15))
    return _through(passed, UNIT, _mode(12.0, 0.7))


def _lag_behind(one: Made, rng: Generator) -> Array:
    """A mode, and a sensor's first-order lag."""
    return _through(one.y, UNIT, _mode(7.0, 0.1) * Polynomial([1.0, 0.02]))


def _three(one: Made, rng: Generator) -> Array:
    return _sum(one.y, (6.0, 0.1, 0.7), (13.0, 0.08, 0.2), (25.0, 0.06, 0.1))


def _hardening(one: Made, rng: Generator) -> Array:
    """A spring that stiffens with the deflection, semi-implicit Euler in twenty parts of a step."""
    omega, zeta, stiffer = 2.0 * np.pi * 7.0, 0.15, 0.5 / (0.5 * one.span) ** 2
    place, speed, part, out = float(one.y[0]), 0.0, STEP / 20.0, one.y.copy()
    for k in range(1, out.size):
        for j in range(20):
            away = one.y[k - 1] + (one.y[k] - one.y[k - 1]) * (j + 0.5) / 20.0 - place
            speed += part * (omega**2 * away * (1.0 + stiffer * away**2) - 2.0 * zeta * omega * speed)
            place += part * speed
        out[k] = place
    return out


def _teeth(one: Made, rng: Generator) -> Array:
    """A motor's cogging, passed by two modes."""
    cogging = 0.02 * one.span * np.sin(2.0 * np.pi * one.u / 0.23)
    return _two(replace(one, y=one.y + cogging), rng)


def _overshooting(one: Made, rng: Generator) -> Array:
    """A position loop before the law."""
    return one.law(_through(one.u, UNIT, _mode(7.0, 0.3)))


def _two_before(one: Made, rng: Generator) -> Array:
    """A drive train of two modes before the law."""
    return one.law(_sum(one.u, (7.0, 0.1, 0.8), (17.0, 0.1, 0.2)))


EFFECTS: dict[str, Form] = {
    "none": none,
    "one": _one,
    "two": _two,
    "opposed": _opposed,
    "beside": _beside,
    "antiresonance": _antiresonance,
    "mount": _mount,
    "series": _series,
    "lag behind": _lag_behind,
    "three": _three,
    "hardening": _hardening,
    "teeth": _teeth,
    "overshooting": _overshooting,
    "two before": _two_before,
}

if __name__ == "__main__":
    ask(__doc__.partition("\n")[0], EFFECTS)
