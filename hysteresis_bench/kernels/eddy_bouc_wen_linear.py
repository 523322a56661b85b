"""Bouc-Wen hysteresis with eddy currents inside, n = 1: `eddy_current` has the equation, `bouc_wen_step` the law.

On an increment of width w, with g and its rate as in `bouc_wen_step`,

    g(w) = g + (A - rate g) (1 - e^(-rate w)) / rate,    dg/dw = (A - rate g) e^(-rate w),    d^2g/dw^2 = -rate dg/dw,

from g = 0 and with the other rate past the crossing of 0, which a logarithm of g gives beforehand. So the equation's
left side and its first two derivatives cost one exponential, and Halley's method [1] finds the root in about two
trials; a bracket keeps it from going astray.

Where v falls while the input rises, the equation may have several roots; which one is found is not said.

[1] J. F. Traub, Iterative Methods for the Solution of Equations, Prentice-Hall (1964), ch. 5.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.bouc_wen import paths
from hysteresis_bench.kernels.bouc_wen_step import RUNAWAY
from hysteresis_bench.kernels.eddy_current import MOST, TOLERANCE, USUAL, end_weight
from hysteresis_bench.kernels.elementary import exponential_less_1, logarithm
from hysteresis_bench.kernels.lanes import GROUPS, LANES

SLIGHT = 1e-200
"""A rate of 0 is as good as this one, by which one can divide; a drive below it is 0."""

TOGETHER = GROUPS * LANES

# Rows of a group: parameters; the state, with the width until g crosses 0; inputs and what they make; the step and its
# equation; the bracket, the trial and what g has grown by there.
COEFFICIENT, DRIVE, INVERSE_DRIVE, MIRROR, ALONG, AGAINST, BOUND, SLOPE = (row * LANES for row in range(8))
Z, H, UNTIL, V, U, NEW, NEXT, RATE = (row * LANES for row in range(8, 16))
FORWARD, G, DRAG, THETA, BEFORE, WIDEST, LOW, HIGH, WAY, GROWTH = (row * LANES for row in range(16, 26))
GROUP = 26 * LANES


@njit(cache=True, error_model="numpy")
def _prepared(s: Array, o: int, alpha: float, beta: float, gamma: float, d: float, length: float) -> None:
    """A lane's parameters, h = 0; length : of the input's path."""
    loop = alpha * d
    mirror = 1.0 if loop >= 0.0 else -1.0
    along, against = beta + mirror * gamma, beta - mirror * gamma
    s[o + DRIVE] = abs(loop)
    s[o + INVERSE_DRIVE] = 1.0 / abs(loop) if abs(loop) > SLIGHT else 0.0
    s[o + MIRROR] = mirror
    s[o + ALONG] = along if abs(along) > SLIGHT else SLIGHT
    s[o + AGAINST] = against if abs(against) > SLIGHT else SLIGHT
    s[o + BOUND] = abs(loop) * RUNAWAY * length
    s[o + SLOPE] = d


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _until(h, inverse_drive, against):  # type: ignore[no-untyped-def]
    """The width of the increment that takes g from -|h| to 0: ln(1 + against |h| / drive) / against."""
    free = abs(h) * inverse_drive
    more = 1.0 + against * free
    slower = logarithm(more) / (more - 1.0)  # of what `more` was rounded to
    until = free * slower if more != 1.0 else free
    return until if more > 0.0 else np.inf


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _growth(g, until, drive, along, against, bound, way):  # type: ignore[no-untyped-def]
    """What an increment adds to g; dg/dw and the rate at its end."""
    behind = g < 0.0
    past = behind & (way > until)
    rate = against if behind & (not past) else along
    start = 0.0 if past else g
    faded = exponential_less_1(-rate * (way - until if past else way))
    pull = drive - rate * start
    growth = (start - g) - pull * faded / rate
    return min(max(growth, -bound - g), bound - g), pull + pull * faded, rate


@njit(forceinline=True, error_model="numpy", fastmath={"contract"})
def _back(value, slope, bend):  # type: ignore[no-untyped-def]
    """How far back the root is, by Halley's method."""
    return 2.0 * value * slope / (2.0 * slope * slope - value * bend)


@njit(cache=True, error_model="numpy")
def _driven(s: Array, groups: int, u: Array, first: int) -> None:
    """The next input; u has one for all particles, or one each."""
    shared, last = u.size == 1, u.size - 1
    for g in range(groups):
        for j in range(LANES):
            s[g * GROUP + NEXT + j] = u[0] if shared else u[min(first + g * LANES + j, last)]


# Every loop over the groups does one short thing, so that the processor goes on to the next group while it waits for
# results of this one.
@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _begun(s: Array, groups: int, duration: float) -> None:
    """The equation from the law's output at the new input, and the first trial."""
    for group in range(groups):
        for j in range(LANES):
            o = group * GROUP + j
            drive, mirror, along, against = s[o + DRIVE], s[o + MIRROR], s[o + ALONG], s[o + AGAINST]
            u, new = s[o + NEW], s[o + NEXT]
            rate = s[o + COEFFICIENT] / duration
            lead = new - s[o + Z]
            sign = mirror if lead >= 0.0 else -mirror
            g, way = sign * s[o + H], abs(lead)
            growth, _, _ = _growth(g, s[o + UNTIL], drive, along, against, s[o + BOUND], way)
            s[o + U] = u
            s[o + NEW] = new
            s[o + RATE] = rate
            s[o + DRAG] = rate * (s[o + SLOPE] * lead - sign * growth)
    for group in range(groups):
        for j in range(LANES):
            o = group * GROUP + j
            lead, drag = s[o + NEW] - s[o + Z], s[o + DRAG]
            weight = end_weight(lead / drag)
            s[o + THETA] = weight if lead * drag > 0.0 else 1.0
    for group in range(groups):
        for j in range(LANES):
            o = group * GROUP + j
            drive, mirror, along, against = s[o + DRIVE], s[o + MIRROR], s[o + ALONG], s[o + AGAINST]
            u, new, z, h, rate, d = s[o + U], s[o + NEW], s[o + Z], s[o + H], s[o + RATE], s[o + SLOPE]
            theta = s[o + THETA]
            behind = z - u
            undragged = new - (1.0 - theta) / theta * behind
            undragged = min(max(undragged, min(u, new)), max(u, new))
            forward = undragged > z
            before = -abs(behind - theta * (new - u))
            widest = abs(undragged - z)

            sign = mirror if forward else -mirror
            g = sign * h
            fading = against if g < 0.0 else along
            pull = drive - fading * g
            slope = d - mirror * pull
            rate = rate if slope > 0.0 else 0.0
            way = _back(-before, theta + rate * slope, rate * mirror * fading * pull)
            s[o + FORWARD] = 1.0 if forward else -1.0
            s[o + G] = g
            s[o + BEFORE] = before
            s[o + WIDEST] = widest
            s[o + LOW] = 0.0
            s[o + HIGH] = widest
            s[o + WAY] = way if (way > 0.0) & (way < widest) else widest


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _narrowed(s: Array, left: Array, halved: bool) -> int:
    """g at the trial, which becomes an end of the bracket; the next trial -> how many lanes are still sought.

    left : of every group; those of none are passed over
    """
    total = 0
    for group in range(left.size):
        if left[group] == 0:
            continue
        open_lanes = 0
        for j in range(LANES):
            o = group * GROUP + j
            drive, mirror, along, against = s[o + DRIVE], s[o + MIRROR], s[o + ALONG], s[o + AGAINST]
            bound, d, theta, before, widest = s[o + BOUND], s[o + SLOPE], s[o + THETA], s[o + BEFORE], s[o + WIDEST]
            g, until, way, low, high = s[o + G], s[o + UNTIL], s[o + WAY], s[o + LOW], s[o + HIGH]
            growth, steep, fading = _growth(g, until, drive, along, against, bound, way)
            rise = d * way - mirror * growth
            rate = s[o + RATE] if rise > 0.0 else 0.0  # ours: as in `eddy_current`
            value = before + theta * way + rate * rise
            slope = theta + rate * (d - mirror * steep)
            low, high = way if value < 0.0 else low, high if value < 0.0 else way
            open_ = (abs(value) > TOLERANCE * -before) & (high - low > TOLERANCE * widest)
            new = way - _back(value, slope, rate * mirror * fading * steep)
            new = new if (new > low) & (new < high) & (not halved) else 0.5 * (low + high)
            s[o + LOW] = low
            s[o + HIGH] = high
            s[o + GROWTH] = growth
            s[o + WAY] = new if open_ else way
            open_lanes += 1 if open_ else 0
        left[group] = open_lanes
        total += open_lanes
    return total


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _moved(s: Array, groups: int, v: Array, row: int) -> None:
    """The trial is where the step ends; v from `row` on."""
    for g in range(groups):
        for j in range(LANES):
            o = g * GROUP + j
            z = s[o + Z] + s[o + FORWARD] * s[o + WAY]
            h = s[o + H] + s[o + FORWARD] * s[o + MIRROR] * s[o + GROWTH]
            s[o + Z] = z
            s[o + H] = h
            s[o + UNTIL] = _until(h, s[o + INVERSE_DRIVE], s[o + AGAINST])
            s[o + V] = s[o + SLOPE] * z - h
    for g in range(groups):
        for j in range(LANES):
            v[row + g * LANES + j] = s[g * GROUP + V + j]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def eddy_bouc_wen_linear(
    time: Array, u: Array, coefficient: Array, alpha: Array, beta: Array, gamma: Array, d: Array
) -> Array:
    """As `eddy_bouc_wen`, n = 1."""
    samples, columns = u.shape
    swarm = d.size
    lengths = paths(u)
    # A group is written whole; what it writes past the end of a row, the next row overwrites.
    v = np.empty(samples * swarm + LANES)
    for first in range((swarm - 1) // TOGETHER * TOGETHER, -1, -TOGETHER):  # the last ones first, for their padding
        groups = min(GROUPS, (swarm - first + LANES - 1) // LANES)
        s = np.zeros(groups * GROUP)
        left = np.empty(groups, dtype=np.int64)
        for lane in range(groups * LANES):
            o, p = lane // LANES * GROUP + lane % LANES, min(first + lane, swarm - 1)
            start, length = u[0, p if columns > 1 else 0], lengths[p if columns > 1 else 0]
            _prepared(s, o, alpha[p], beta[p], gamma[p], d[p], length)
            s[o + COEFFICIENT] = coefficient[p]
            s[o + NEW] = s[o + Z] = start
            v[p] = d[p] * start
        for i in range(1, samples):
            _driven(s, groups, u[i], first)
            _begun(s, groups, time[i] - time[i - 1])
            left[:] = LANES
            for trial in range(MOST):
                if _narrowed(s, left, trial >= USUAL and trial % 2 == 0) == 0:
                    break
            _moved(s, groups, v, i * swarm + first)
    return v[: samples * swarm].reshape(samples, swarm)
