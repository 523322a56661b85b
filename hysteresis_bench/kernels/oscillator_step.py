"""The motion of a mass on a hysteretic spring that a force drives, for a swarm.

    mass x'' + damping x' + z = F,    z = law[x]

by Newmark's rule of average acceleration [1], A-stable and of second order; the law makes its own step from the
displacement before to the displacement sought, which is found by a secant iteration whose first slope is the last
one's. The input comes in as many steps as the integration is to make. Particles are solved for in groups of `lanes`.

[1] N. M. Newmark, J. Engineering Mechanics Division 85 (1959) 67.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.lanes import GROUPS, LANES, OPEN, OUT, SOLVER, TRIAL, Y, Z

CLOSE = 1e-12
"""Change of a step's displacement, as a share of the largest so far, at which it counts as found."""
MOST = 40
"""Iterations of a step."""
RUNAWAY = 1e6
"""Displacements are cut at this many times what the force moves the free mass by in the whole time."""

# Rows of a group's work: whether a lane is no copy, the force on it, its mass and motion; the equation of a step,
# inertia (x - Z) + z = pull; the spring's slope; the change of x that is tried, the way to it from the trial before,
# whose z was LAST; the largest |x| so far, and where it is cut.
OWN, PUSHED, MASS, DAMPING, V, A, INERTIA = ((SOLVER + row) * LANES for row in range(7))
PULL, STIFFNESS, CHANGE, WAY, LAST, REACHED, LIMIT = ((SOLVER + row) * LANES for row in range(7, 14))

# Loops run over min(LANES, s.size): one over a constant number is unrolled when it is short, and then not vectorised.


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _driven(s: Array, t: float) -> None:
    """The equation of a step of duration t, and the displacement that the last slope leads to."""
    twice = 2.0 / t
    for j in range(min(LANES, s.size)):
        mass, damping, v, slope = s[MASS + j], s[DAMPING + j], s[V + j], s[STIFFNESS + j]
        inertia = twice * (twice * mass + damping)
        pull = mass * (2.0 * twice * v + s[A + j]) + damping * v + s[PUSHED + j]
        change = (pull - s[Y + j]) / (inertia + (slope if slope > 0.0 else 0.0))
        s[INERTIA + j] = inertia
        s[PULL + j] = pull
        s[CHANGE + j] = change
        s[WAY + j] = change
        s[LAST + j] = s[Y + j]
        s[TRIAL + j] = s[Z + j] + change
        s[OPEN + j] = s[OWN + j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _corrected(s: Array) -> int:
    """The next displacement, by the slope of the law along the last way -> lanes that have not found theirs."""
    left = 0
    for j in range(min(LANES, s.size)):
        change, way, out, before, was_open = s[CHANGE + j], s[WAY + j], s[OUT + j], s[STIFFNESS + j], s[OPEN + j]
        slope = (out - s[LAST + j]) / way
        slope = slope if way != 0.0 else before
        way = (s[PULL + j] - out - s[INERTIA + j] * change) / (s[INERTIA + j] + (slope if slope > 0.0 else 0.0))
        way = way if was_open > 0.0 else 0.0
        found = abs(way) <= CLOSE * s[REACHED + j]
        change += way
        s[STIFFNESS + j] = slope if was_open > 0.0 else before
        s[WAY + j] = way
        s[LAST + j] = out
        s[CHANGE + j] = change
        s[TRIAL + j] = s[Z + j] + change
        s[OUT + j] = out + slope * way if found else out  # the last way is too short for a trial
        s[OPEN + j] = 0.0 if found else was_open
        left += 0 if found else 1
    return left


@njit(cache=True, error_model="numpy")
def _cut(s: Array) -> int:
    """How many lanes have run away, or are NaN: they are stopped at the edge, which is the trial."""
    cut = 0
    for j in range(min(LANES, s.size)):
        x, limit = s[TRIAL + j], s[LIMIT + j]
        inside = abs(x) <= limit
        edge = limit if x > 0.0 else -limit
        s[OPEN + j] = 0.0 if inside else 1.0
        s[TRIAL + j] = x if inside else edge
        cut += 0 if inside else 1
    return cut


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _arrived(s: Array, t: float) -> None:
    """The trial is where the step ends."""
    twice = 2.0 / t
    for j in range(min(LANES, s.size)):
        x, v, a, old, cut, most = s[TRIAL + j], s[V + j], s[A + j], s[Z + j], s[OPEN + j] > 0.0, s[REACHED + j]
        faster = twice * (x - old) - v
        a = twice * (faster - v) - a
        s[A + j] = 0.0 if cut else a
        s[V + j] = 0.0 if cut else faster
        s[Z + j] = x
        s[Y + j] = s[OUT + j]
        s[REACHED + j] = abs(x) if abs(x) > most else most


# Inlined, as `simulated` of `eddy_current`: a kernel that passed its law to a function of its own could not be cached.
@njit(inline="always", error_model="numpy")
def simulated(law, keep, prepare, of, rows, force, width, every, mass, damping, parameters):  # type: ignore[no-untyped-def]
    """law(of, s), keep(of, s) : as in `lanes`, z = 0 at rest;  prepare(s, j, p) : a lane's parameters"""
    steps, columns = force.shape
    swarm = mass.size
    out = np.zeros(((steps - 1) // every + 1, swarm))
    duration = np.sum(width)
    for first in range(0, swarm, GROUPS * LANES):
        groups = min(GROUPS, (swarm - first + LANES - 1) // LANES)
        work = np.zeros((groups, rows * LANES))
        left = np.zeros(groups, dtype=np.int64)
        for g in range(groups):
            for j in range(LANES):
                p = min(first + g * LANES + j, swarm - 1)
                column = p if columns > 1 else 0
                work[g, OWN + j] = 1.0 if first + g * LANES + j < swarm else 0.0
                work[g, MASS + j] = mass[p]
                work[g, DAMPING + j] = damping[p]
                work[g, A + j] = force[0, column] / mass[p]
                work[g, LIMIT + j] = RUNAWAY * np.max(np.abs(force[:, column])) * duration * duration / mass[p]
                prepare(work[g], j, parameters[:, p])
        for i in range(1, steps):
            t = width[i - 1]
            for g in range(groups):
                for j in range(LANES):
                    work[g, PUSHED + j] = force[i, min(first + g * LANES + j, swarm - 1) if columns > 1 else 0]
                _driven(work[g], t)
            left[:] = 1
            trial = 0
            while left.any() and trial < MOST:
                for g in range(groups):
                    if left[g] > 0:
                        law(of, work[g])
                for g in range(groups):
                    if left[g] > 0:
                        left[g] = _corrected(work[g])
                trial += 1
            for g in range(groups):
                if left[g] > 0:  # not found: the law where the last correction leads
                    law(of, work[g])
                if _cut(work[g]) > 0:
                    law(of, work[g])
            for g in range(groups):
                keep(of, work[g])
                _arrived(work[g], t)
            if i % every == 0:
                for g in range(groups):
                    start = first + g * LANES
                    for j in range(min(LANES, swarm - start)):
                        out[i // every, start + j] = work[g, Z + j]
    return out
