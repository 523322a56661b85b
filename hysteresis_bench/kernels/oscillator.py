"""A mass on a hysteretic spring, driven by a force: hysteresis in feedback, for a swarm.

    mass x'' + damping x' + z = F,    z = law[x]

by Newmark's rule of average acceleration [1], A-stable and of second order; the law makes its own step from the
displacement before to the displacement sought, which is found by a secant iteration whose first slope is the last
one's. The input comes in as many steps as the integration is to make.

[1] N. M. Newmark, J. Engineering Mechanics Division 85 (1959) 67.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen_generalized import strained
from hysteresis_bench.kernels.bouc_wen_step import moved
from hysteresis_bench.kernels.dahl import slipped
from hysteresis_bench.kernels.play import played

CLOSE = 1e-12
"""Change of a step's displacement, as a share of the largest so far, at which it counts as found."""
MOST = 40
"""Iterations of a step."""
RUNAWAY = 1e6
"""Displacements are cut at this many times what the force moves the free mass by in the whole time."""


# A law's step: (state before, state after, x before, x, parameters) -> z. It writes only the state after.


@njit(cache=True, error_model="numpy")
def _bouc_wen(before, after, old, x, p):  # type: ignore[no-untyped-def]
    """p : alpha, beta, gamma, d, n, bound of h"""
    after[0] = moved(before[0], x - old, p[0] * p[3], p[1], p[2], p[4], p[5])
    return p[3] * x - after[0]


@njit(cache=True, error_model="numpy")
def _generalized(before, after, old, x, p):  # type: ignore[no-untyped-def]
    """p : as in `bouc_wen_generalized`, then slope, F_y"""
    after[0], after[1] = strained(before[0], before[1], x - old, p)
    return p[10] * x + p[11] * after[0]


@njit(cache=True, error_model="numpy")
def _dahl(before, after, old, x, p):  # type: ignore[no-untyped-def]
    """p : distance, exponent, gap, slope, F_C"""
    after[0], after[1] = slipped(before[0], before[1], x - old, p[0], p[1], p[2])
    return p[3] * x + p[4] * after[0]


@njit(cache=True, error_model="numpy")
def _plays(before, after, old, x, p):  # type: ignore[no-untyped-def]
    """p : the radius of every play, then its coefficients, ascending powers from 1, play by play"""
    count = before.size
    powers = p.size // count - 1
    z = 0.0
    for k in range(count):
        after[k] = played(x, p[k], before[k])
        value = 0.0
        for m in range(powers, 0, -1):
            value = after[k] * (p[count + k * powers + m - 1] + value)
        z += value
    return z


@njit(cache=True, error_model="numpy")
def _stops(before, after, old, x, p):  # type: ignore[no-untyped-def]
    """p : slope, gap, then the limit of every element, then its stiffness"""
    count = before.size
    gap = p[1]
    z = p[0] * x
    for k in range(count):
        after[k] = played(x, p[2 + k] + gap, before[k])
        e = x - after[k]
        z += p[2 + count + k] * (max(e - gap, 0.0) + min(e + gap, 0.0))
    return z


@njit(inline="always", error_model="numpy")
def _driven(law, states, force, width, every, mass, damping, parameters):  # type: ignore[no-untyped-def]
    steps, columns = force.shape
    swarm = mass.size
    out = np.zeros(((steps - 1) // every + 1, swarm))
    duration = np.sum(width)
    for j in range(swarm):
        column = j if columns > 1 else 0
        p = parameters[:, j].copy()
        state = np.zeros(states)
        trial = np.zeros(states)
        x = v = 0.0
        a = force[0, column] / mass[j]
        z = law(state, trial, 0.0, 0.0, p)
        largest = 0.0
        for i in range(steps):
            largest = max(largest, abs(force[i, column]))
        bound = RUNAWAY * largest * duration * duration / mass[j]
        stiffness = 0.0
        reached = 0.0
        for i in range(1, steps):
            t = width[i - 1]
            inertia = 4.0 * mass[j] / (t * t) + 2.0 * damping[j] / t
            pull = mass[j] * (4.0 * v / t + a) + damping[j] * v + force[i, column]  # of inertia (x - old) + z
            old, before = x, z
            change = (pull - before) / (inertia + max(stiffness, 0.0))
            for _ in range(MOST):
                x = old + change
                z = law(state, trial, old, x, p)
                excess = inertia * change + z - pull
                if change != 0.0:
                    stiffness = (z - before) / change
                correction = excess / (inertia + max(stiffness, 0.0))
                change -= correction
                if abs(correction) <= CLOSE * reached:
                    break
            x = old + change
            if not abs(x) <= bound:  # NaN, too
                x = bound if x > 0.0 else -bound
                v = a = 0.0
                z = law(state, trial, old, x, p)
            else:
                z = law(state, trial, old, x, p)
                faster = 2.0 * (x - old) / t - v
                a = 2.0 * (faster - v) / t - a
                v = faster
            for k in range(states):
                state[k] = trial[k]
            reached = max(reached, abs(x))
            if i % every == 0:
                out[i // every, j] = x
    return out


# One for each law, so that its step is compiled into the loop.


@njit(cache=True, error_model="numpy")
def bouc_wen_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array
) -> Array:
    """The displacement of a mass on a spring with this law; the others alike.

    force : float64[steps, 1] or float64[steps, swarm]    F at the ends of the integration's steps
    width : float64[steps - 1]         of the steps, unit of time
    every : steps an output sample
    mass, damping : float64[swarm]     > 0; >= 0
    parameters : float64[any, swarm]   as the law's step has them
    -> float64[samples, swarm]         x; it begins at rest at 0, the law in its rest state
    """
    return _driven(_bouc_wen, 1, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def generalized_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array
) -> Array:
    return _driven(_generalized, 2, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def dahl_oscillator(force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array) -> Array:
    return _driven(_dahl, 2, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def plays_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array, plays: int
) -> Array:
    return _driven(_plays, plays, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def stops_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array, elements: int
) -> Array:
    return _driven(_stops, elements, force, width, every, mass, damping, parameters)
