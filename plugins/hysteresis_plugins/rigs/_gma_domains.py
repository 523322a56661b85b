"""Domains of a magnetostrictive rod: each turns to the nearest minimum of its energy, and jumps where that is gone."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

STEP = 0.1  # rad; longest of an iteration: none leaps over a minimum
FLAT = 1e-9  # of the cubic anisotropy: a torque that is none


@njit(cache=True, error_model="numpy")
def directions(field: Array, easy: Array, cubic: float, stress: Array) -> Array:
    """The angle of every class of domains from the rod's axis, in the plane of the axis and the easy directions.

    e = cubic / 8 sin²(2 (theta - easy)) + stress / 2 cos²(theta) - h cos(theta), in A/m: four easy directions, of
    which a compression along the rod makes those across it the better ones, and the field those along it.

    field : float64[samples]   A/m
    easy, stress : float64[classes]   rad and A/m;  cubic : A/m
    -> float64[samples, classes]   rad; begins at the easy direction next to across the rod
    """
    angles = np.empty((field.size, easy.size))
    for j in range(easy.size):
        theta = easy[j] + 0.5 * math.pi * round((0.5 * math.pi - easy[j]) / (0.5 * math.pi))
        for k in range(field.size):
            theta = _settled(theta, field[k], easy[j], cubic, stress[j])
            angles[k, j] = theta
    return angles


@njit(cache=True, error_model="numpy")
def _settled(theta: float, h: float, easy: float, cubic: float, stress: float) -> float:
    """Newton where the energy is convex, down the slope where it is not."""
    for _ in range(400):
        slope = 0.25 * cubic * math.sin(4.0 * (theta - easy)) - 0.5 * stress * math.sin(2.0 * theta)
        slope += h * math.sin(theta)
        bend = cubic * math.cos(4.0 * (theta - easy)) - stress * math.cos(2.0 * theta) + h * math.cos(theta)
        if bend > 0.0 and abs(slope) < FLAT * cubic:
            break
        move = -slope / bend if bend > 0.0 else -math.copysign(STEP, slope)
        theta += min(max(move, -STEP), STEP)
    return theta
