"""Dahl's friction of a swarm, with a clearance in series: exact on every increment of the displacement.

With w = |du| along an increment, s its direction, z the force as a share of Coulomb's and Q = 1 - s z, equation (3)
of [1], dF/dx = sigma |1 - s F / F_C|^i, is dQ/dw = -Q^i / distance with distance = F_C / sigma, whence

    Q^(1-i) falls by (1 - i) w / distance,    or Q = Q0 exp(-w / distance) for i = 1.

On its way from one sign to the other the force stays 0 while the clearance is crossed.

`slipped` is that for one particle. A swarm goes by the way x, in distances, that lies behind the force 0, negative
before it, and by the room that is to be crossed there: both change the force's sign with the direction, and between
two reversals an increment only adds to x. The force is

    1 - Q,    Q^(1-i) = 1 - (1 - i) t,  or ln Q = -t for i = 1,    t = x below 0, 0 in the room, x - room beyond.

[1] P. R. Dahl, A solid friction model, Aerospace Corporation, TOR-158(3107-18) (1968).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.columns import given_out, taken_in
from hysteresis_bench.kernels.elementary import TO_BASE_2, base_2_logarithm, power_of_2
from hysteresis_bench.kernels.lanes import LANES

EVEN = 1e-6
"""Distance of the exponent from 1 within which it counts as 1."""
LEAST = 1e-300
"""Least power of Q: below it the force is Coulomb's to the last bit."""

# Rows of a group: 1 over the distance, 1 - i and 1 over it, both 0 for i = 1, where there is then log_2 e, the
# clearance in distances; the state; the input.
INVERSE, POWER, ROOT, EVENLY, CLEARANCE = (row * LANES for row in range(5))
DIRECTION, X, ROOM, Z, NOW, NEXT = (row * LANES for row in range(5, 11))
ROWS = 11


@njit(cache=True, error_model="numpy")
def _left(Q: float, width: float, exponent: float) -> float:
    """Q after an increment of this width, in distances."""
    if abs(exponent - 1.0) < EVEN:
        return Q * math.exp(-width)
    power = 1.0 - exponent
    if Q <= 0.0:
        return 0.0
    base = Q**power - power * width
    return base ** (1.0 / power) if base > 0.0 else 0.0


@njit(cache=True, error_model="numpy")
def _width_to_0(Q: float, exponent: float) -> float:
    """The increment, in distances, after which a force against the motion is gone: Q falls to 1."""
    if abs(exponent - 1.0) < EVEN:
        return math.log(Q)
    return (Q ** (1.0 - exponent) - 1.0) / (1.0 - exponent)


@njit(cache=True, error_model="numpy")
def slipped(z: float, place: float, step: float, distance: float, exponent: float, gap: float) -> tuple[float, float]:
    """Force and place in the clearance after the displacement has gone on by `step`.

    z : force over Coulomb's, -1 to 1;  place : -gap to gap, at the edge of its sign where z is not 0
    """
    if step == 0.0:
        return z, place
    s = math.copysign(1.0, step)
    width = abs(step)
    g = s * z
    if g < 0.0:
        until = _width_to_0(1.0 - g, exponent) * distance
        if width < until:
            return s * min(1.0 - _left(1.0 - g, width / distance, exponent), 0.0), place
        width -= until
        g = 0.0
        place = -s * gap
    if g == 0.0:
        room = gap - s * place
        if width <= room:
            return 0.0, place + s * width
        width -= room
    return s * (1.0 - _left(1.0 - g, width / distance, exponent)), s * gap


@njit(forceinline=True, error_model="numpy")
def _turning(s):  # type: ignore[no-untyped-def]
    """How many lanes turn."""
    turning = 0
    for j in range(min(LANES, s.size & -LANES)):
        turning += 1 if (s[NEXT + j] - s[NOW + j]) * s[DIRECTION + j] < 0.0 else 0
    return turning


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _turned(s):  # type: ignore[no-untyped-def]
    """x and the room of lanes that turn, seen in the other direction."""
    for j in range(min(LANES, s.size & -LANES)):
        direction, x, room, clearance = s[DIRECTION + j], s[X + j], s[ROOM + j], s[CLEARANCE + j]
        turns = (s[NEXT + j] - s[NOW + j]) * direction < 0.0
        logarithm = base_2_logarithm(max(1.0 + direction * s[Z + j], LEAST))
        evenly = 1.0 / TO_BASE_2 if s[POWER + j] == 0.0 else 0.0
        way = (1.0 - power_of_2(s[POWER + j] * logarithm)) * s[ROOT + j] - logarithm * evenly
        slack = (x >= 0.0) & (x <= room)
        other_x = 0.0 if slack else way
        other_room = clearance - room if slack else (0.0 if x < 0.0 else clearance)
        s[X + j] = other_x if turns else x
        s[ROOM + j] = other_room + (x if slack else 0.0) if turns else room
        s[DIRECTION + j] = -direction if turns else direction


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _gone_on(s):  # type: ignore[no-untyped-def]
    """x, the force and the input of every lane after the increment."""
    for j in range(min(LANES, s.size & -LANES)):
        x = s[X + j] + abs(s[NEXT + j] - s[NOW + j]) * s[INVERSE + j]
        t = min(x, max(x - s[ROOM + j], 0.0))
        logarithm = base_2_logarithm(max(1.0 - s[POWER + j] * t, LEAST))  # of Q^(1-i)
        Q = power_of_2(logarithm * s[ROOT + j] - t * s[EVENLY + j])
        s[X + j], s[Z + j], s[NOW + j] = x, s[DIRECTION + j] * (1.0 - Q), s[NEXT + j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def slipped_together(s: Array) -> None:
    """The force of a group after its input has come to s[NEXT:]."""
    if _turning(s) > 0:
        _turned(s)
    _gone_on(s)


@njit(cache=True, error_model="numpy")
def dahl(u: Array, distance: Array, exponent: Array, gap: Array) -> Array:
    """Dahl's friction as a share of Coulomb's.

    u : float64[samples, 1] or float64[samples, swarm]    displacement, any unit
    distance : float64[swarm]     over which the force builds up, F_C / sigma, unit of u, > 0
    exponent : float64[swarm]     i >= 0; below 1 the force gets to Coulomb's after a finite way
    gap : float64[swarm]          half the clearance, unit of u, >= 0
    -> float64[samples, swarm]    -1 to 1, 0 at the first sample, in the middle of the clearance
    """
    samples, swarm = u.shape[0], distance.size
    out = np.empty((samples, swarm))
    for first in range(0, swarm, LANES):
        used = min(LANES, swarm - first)
        s = np.zeros(ROWS * LANES)
        for j in range(LANES):
            one = first + min(j, used - 1)
            power = 1.0 - exponent[one]
            even = abs(power) < EVEN
            s[INVERSE + j], s[CLEARANCE + j] = 1.0 / distance[one], 2.0 * gap[one] / distance[one]
            s[POWER + j], s[ROOT + j] = 0.0 if even else power, 0.0 if even else 1.0 / power
            s[EVENLY + j] = TO_BASE_2 if even else 0.0
            s[DIRECTION + j], s[ROOM + j] = 1.0, gap[one] / distance[one]
        taken_in(s, NOW, u, 0, first, used)
        for i in range(samples):
            taken_in(s, NEXT, u, i, first, used)
            slipped_together(s)
            given_out(s, Z, out, i, first, used)
    return out
