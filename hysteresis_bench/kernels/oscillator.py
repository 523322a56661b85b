"""A mass on a hysteretic spring, driven by a force: hysteresis in feedback, for a swarm, with any law that it has.

`oscillator_step` has the motion. Each law has a kernel of its own, so that its step is compiled into the loop.
"""

from __future__ import annotations

from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels import bouc_wen_generalized as generalized
from hysteresis_bench.kernels import bouc_wen_tried as bouc_wen
from hysteresis_bench.kernels.dahl import slipped
from hysteresis_bench.kernels.lanes import LANES, LAW, OPEN, OUT, TRIAL, Z
from hysteresis_bench.kernels.oscillator_step import simulated
from hysteresis_bench.kernels.play import played

# Bouc-Wen has its trial in `bouc_wen_tried`; a particle's parameters here: alpha, beta, gamma, d, bound of h.


@njit(cache=True, error_model="numpy")
def _bouc_wen(s: Array, j: int, p: Array) -> None:
    bouc_wen.prepared(s, j, p[0], p[1], p[2], p[3], 1.0)
    s[bouc_wen.BOUND + j] = p[4]


# The generalized one: the rows of `bouc_wen_generalized`, then slope, F_y, and the state before the trial.
G_SLOPE, G_STRENGTH, G_STATE, G_ENERGY = ((generalized.ROWS + row) * LANES for row in range(4))


@njit(cache=True, error_model="numpy")
def _generalized(s: Array, j: int, p: Array) -> None:
    own = s[LAW * LANES :]
    for row in range(10):
        own[row * LANES + j] = p[row]
    own[G_SLOPE + j] = p[10]
    own[G_STRENGTH + j] = p[11]


@njit(cache=True, error_model="numpy")
def _generalized_tried(of: int, s: Array) -> None:
    own = s[LAW * LANES :]
    for j in range(LANES):
        open_ = s[OPEN + j] > 0.0
        if open_:
            own[generalized.STATE + j] = own[G_STATE + j]
            own[generalized.ENERGY + j] = own[G_ENERGY + j]
        own[generalized.STEP + j] = s[TRIAL + j] - s[Z + j] if open_ else 0.0
    generalized.strained_together(own)
    for j in range(LANES):
        if s[OPEN + j] > 0.0:
            s[OUT + j] = own[G_SLOPE + j] * s[TRIAL + j] + own[G_STRENGTH + j] * own[generalized.STATE + j]


@njit(cache=True, error_model="numpy")
def _generalized_kept(of: int, s: Array) -> None:
    own = s[LAW * LANES :]
    for j in range(LANES):
        own[G_STATE + j] = own[generalized.STATE + j]
        own[G_ENERGY + j] = own[generalized.ENERGY + j]


# The others particle by particle, law(state before, state after, x before, x, p) -> z, of which they write the state
# after. Rows: every state before, every state after, the parameters.


@njit(inline="always", error_model="numpy")
def _one_by_one(law, states, s):  # type: ignore[no-untyped-def]
    rows = s[LAW * LANES :].reshape(-1, LANES)
    for j in range(LANES):
        if s[OPEN + j] > 0.0:
            before, after, p = rows[:states, j], rows[states : 2 * states, j], rows[2 * states :, j]
            s[OUT + j] = law(before, after, s[Z + j], s[TRIAL + j], p)


@njit(cache=True, error_model="numpy")
def _kept(states: int, s: Array) -> None:
    own = s[LAW * LANES :]
    for place in range(states * LANES):
        own[place] = own[states * LANES + place]


@njit(cache=True, error_model="numpy")
def _parameters(s: Array, j: int, p: Array) -> None:
    """They are the last rows."""
    for row in range(p.size):
        s[s.size - (p.size - row) * LANES + j] = p[row]


@njit(cache=True, error_model="numpy")
def _dahl(before: Array, after: Array, old: float, x: float, p: Array) -> float:
    """p : distance, exponent, gap, slope, F_C"""
    after[0], after[1] = slipped(before[0], before[1], x - old, p[0], p[1], p[2])
    return p[3] * x + p[4] * after[0]


@njit(cache=True, error_model="numpy")
def _dahl_tried(states: int, s: Array) -> None:
    _one_by_one(_dahl, states, s)


@njit(cache=True, error_model="numpy")
def _plays(before: Array, after: Array, old: float, x: float, p: Array) -> float:
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
def _plays_tried(states: int, s: Array) -> None:
    _one_by_one(_plays, states, s)


@njit(cache=True, error_model="numpy")
def _stops(before: Array, after: Array, old: float, x: float, p: Array) -> float:
    """p : slope, gap, then the limit of every element, then its stiffness"""
    count = before.size
    gap = p[1]
    z = p[0] * x
    for k in range(count):
        after[k] = played(x, p[2 + k] + gap, before[k])
        e = x - after[k]
        z += p[2 + count + k] * (max(e - gap, 0.0) + min(e + gap, 0.0))
    return z


@njit(cache=True, error_model="numpy")
def _stops_tried(states: int, s: Array) -> None:
    _one_by_one(_stops, states, s)


@njit(cache=True, error_model="numpy")
def bouc_wen_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array
) -> Array:
    """The displacement of a mass on a spring with this law; the others alike.

    force : float64[steps, 1] or float64[steps, swarm]    F at the ends of the integration's steps
    width : float64[steps - 1]         of the steps, unit of time
    every : steps an output sample
    mass, damping : float64[swarm]     > 0; >= 0
    parameters : float64[any, swarm]   as the law has them
    -> float64[samples, swarm]         x; it begins at rest at 0, the law in its rest state
    """
    return simulated(
        bouc_wen.tried, bouc_wen.kept, _bouc_wen, 1.0, bouc_wen.ROWS, force, width, every, mass, damping, parameters
    )


@njit(cache=True, error_model="numpy")
def generalized_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array
) -> Array:
    rows = LAW + generalized.ROWS + 4
    return simulated(
        _generalized_tried, _generalized_kept, _generalized, 0, rows, force, width, every, mass, damping, parameters
    )


@njit(cache=True, error_model="numpy")
def dahl_oscillator(force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array) -> Array:
    rows = LAW + 4 + parameters.shape[0]
    return simulated(_dahl_tried, _kept, _parameters, 2, rows, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def plays_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array, plays: int
) -> Array:
    rows = LAW + 2 * plays + parameters.shape[0]
    return simulated(_plays_tried, _kept, _parameters, plays, rows, force, width, every, mass, damping, parameters)


@njit(cache=True, error_model="numpy")
def stops_oscillator(
    force: Array, width: Array, every: int, mass: Array, damping: Array, parameters: Array, elements: int
) -> Array:
    rows = LAW + 2 * elements + parameters.shape[0]
    return simulated(_stops_tried, _kept, _parameters, elements, rows, force, width, every, mass, damping, parameters)
