"""Laws of the field that are not registered, each in finite steps of the input.

J. Oh, D. S. Bernstein, IEEE Trans. Autom. Control 50 (2005) 631, semilinear Duhem; J. Tellinen, IEEE Trans. Magn. 34
(1998) 2200; F. Preisach, Z. Phys. 94 (1935) 277, relays; M. Al Janaideh, S. Rakheja, C.-Y. Su, IEEE/ASME Trans.
Mechatron. 16 (2011) 734, play behind a curve; J. Song, A. Der Kiureghian, J. Eng. Mech. 132 (2006) 610; E. J. Graesser,
F. A. Cozzarelli, J. Eng. Mech. 117 (1991) 2590, superelastic; P. R. Dahl (1968), with an exponent; D. C. Jiles, D. L.
Atherton, J. Magn. Magn. Mater. 61 (1986) 48, with an arctangent for Langevin's function.
"""

from __future__ import annotations

from collections.abc import Callable
from math import erf
from typing import Any

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array


def _steps(u: Array) -> Any:
    """Middle and increment of every step."""
    return zip(range(1, u.size), 0.5 * (u[1:] + u[:-1]), np.diff(u), strict=True)


def semilinear_duhem(u: Array, rng: Generator) -> Array:
    """Rising and falling it goes with rates of their own towards the same curve."""
    rising, falling = 1 / rng.uniform(0.2, 0.4, 2)
    slope, bend, share = rng.uniform(0.5, 1.5), rng.uniform(0.2, 0.6), rng.uniform(0.2, 0.6)
    y = np.zeros(u.size)
    y[0] = slope * u[0] + bend * u[0] ** 3
    for i, m, d in _steps(u):
        rate = rising if d > 0 else falling
        y[i] = y[i - 1] + rate * abs(d) * (slope * m + bend * m**3 - y[i - 1]) + d * share * slope
    return y


def tellinen(u: Array, rng: Generator) -> Array:
    coercive, width, free = rng.uniform(0.15, 0.4), rng.uniform(0.2, 0.5), rng.uniform(0.05, 0.2)

    def below(h: float) -> float:
        return float(np.tanh((h - coercive) / width))

    def above(h: float) -> float:
        return float(np.tanh((h + coercive) / width))

    b, y = 0.0, np.zeros(u.size)
    for i, m, d in _steps(u):
        gap = max(above(m) - below(m), 1e-9)
        rising = (above(m) - b) / gap * (1 - below(m) ** 2) / width
        falling = (b - below(m)) / gap * (1 - above(m) ** 2) / width
        b = min(max(b + d * (rising if d > 0 else falling), below(u[i])), above(u[i]))
        y[i] = b + free * u[i]
    return y


def relays(u: Array, rng: Generator) -> Array:
    count, spread, coercive = 3600, rng.uniform(0.15, 0.3), rng.uniform(0.15, 0.35)
    half = np.abs(coercive + spread * 0.6 * rng.standard_normal(count))
    middle = spread * rng.standard_normal(count)
    state, y = np.where(middle > 0, -1.0, 1.0), np.zeros(u.size)
    for i, level in enumerate(u):
        state = np.where(level > middle + half, 1.0, np.where(level < middle - half, -1.0, state))
        y[i] = state.mean()
    return y + rng.uniform(0.05, 0.2) * u


def play_behind_a_curve(u: Array, rng: Generator) -> Array:
    steep, _, centre = rng.uniform(0.6, 1.4), rng.uniform(0.8, 2.0), rng.uniform(-0.2, 0.2)
    v = np.tanh(steep * u + centre) + 0.1 * u
    y = 0.6 * v
    for threshold, weight in zip(
        np.linspace(0.05, 0.6, 9), 0.25 * np.exp(-np.arange(9) * rng.uniform(0.1, 0.4)), strict=True
    ):
        z, play = 0.0, np.zeros(u.size)
        for i, level in enumerate(v):
            z = max(level - threshold, min(level + threshold, z))
            play[i] = z
        y = y + weight * play
    return y


def song_der_kiureghian(u: Array, rng: Generator) -> Array:
    boxes = ((1.5, 3), (0.5, 1.5), (-0.5, 0.5), (-0.6, 0.6), (-0.3, 0.3), (-0.2, 0.2))
    b = [rng.uniform(*box) for box in boxes]
    elastic, z, y, sign = rng.uniform(0.1, 0.4), 0.0, np.zeros(u.size), np.sign
    for i, m, d in _steps(u):
        shape = b[0] * sign(d * z) + b[1] * sign(m * d) + b[2] * sign(m * z) + b[3] * sign(d) + b[4] * sign(z)
        z += d * (1.0 - abs(z) * (shape + b[5] * sign(m)))
        y[i] = elastic * u[i] + (1 - elastic) * z
    return y


def graesser_cozzarelli(u: Array, rng: Generator) -> Array:
    yielding, power = rng.uniform(0.12, 0.2), float(rng.choice([1, 3]))
    after, phase = rng.uniform(0.05, 0.2), rng.uniform(0.22, 0.35)
    y = np.zeros(u.size)
    for i, m, d in _steps(u):
        back = after * (m - y[i - 1]) + phase * erf(m / yielding)
        over = (y[i - 1] - back) / yielding
        y[i] = y[i - 1] + d - abs(d) * abs(over) ** power * np.sign(over)
    return y


def dahl_with_exponent(u: Array, rng: Generator) -> Array:
    power, stiff, friction, elastic = (
        rng.choice([0.5, 1.5, 2.0]),
        rng.uniform(4, 10),
        rng.uniform(0.5, 1),
        rng.uniform(0.2, 0.6),
    )
    force, y = 0.0, np.zeros(u.size)
    for i, _, d in _steps(u):
        left = 1 - force / friction * np.sign(d)
        force += stiff * friction * d * abs(left) ** power * np.sign(left)
        y[i] = force + elastic * u[i]
    return y


def jiles_atherton_arctangent(u: Array, rng: Generator) -> Array:
    a, alpha, k, c = rng.uniform(0.15, 0.35), rng.uniform(0, 0.1), rng.uniform(0.15, 0.35), rng.uniform(0.1, 0.4)
    m = pinned = 0.0
    y = np.zeros(u.size)
    for i, _, d in _steps(u):
        free = 2 / np.pi * np.arctan((u[i] + alpha * m) / a)
        if (free - pinned) * d > 0:
            pinned += min(abs(d) / k, 1) * (free - pinned)
        m = c * free + (1 - c) * pinned
        y[i] = m + 0.05 * u[i]
    return y


LAWS: dict[str, Callable[[Array, Generator], Array]] = {
    "semilinear Duhem": semilinear_duhem,
    "Tellinen": tellinen,
    "relays": relays,
    "play behind a curve": play_behind_a_curve,
    "Song-Der Kiureghian": song_der_kiureghian,
    "Graesser-Cozzarelli": graesser_cozzarelli,
    "Dahl with an exponent": dahl_with_exponent,
    "Jiles-Atherton, arctangent": jiles_atherton_arctangent,
}
