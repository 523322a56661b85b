"""How the controllers get their numbers: from the identified model alone, by rules that give the same every time.

One requirement for all: the modulus margin. The largest amplification of a disturbance by the loop, the maximum of
|1 / (1 + L)|, stays below PEAK, with the loop L computed for the sampled law, the voltage held between samples, and
SPARE_SAMPLES more of lag, for what the model lacks. Within that, feedback is as strong as it goes [1].

Sliding mode: C and the total slope of the reaching law are both a bandwidth lambda (the error decays with two equal
poles), the observer's three poles lie there too, and lambda is the largest that keeps the margin,
and is no faster than the sampling. Half of the slope
is rho; the boundary layer is as wide as makes epsilon / layer the other half. epsilon exceeds the force that the
model's own error on its fitted records is worth, (k/m) ERRORS RMSE.
PI: the strongest integral that keeps the margin, over all proportional gains.

[1] Åström, Panagopoulos, Hägglund, Automatica 34 (1998) 585-597: maximal integral gain under a bound on this maximum.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.feed_forward import LinearSection
from hysteresis_bench.control.observer import observer

PEAK = 2.0
"""Largest amplification of a disturbance by the loop: its Nyquist curve stays half a unit away from -1."""
SPARE_SAMPLES = 2.0
"""Lag that the loop bears beside its own."""
ERRORS = 3.0
"""RMSE of the model that a sliding mode's switching exceeds."""
CAUTIOUS_INTEGRAL = 2.0 * np.pi * 5.0
"""1/s; of a PI on a model without a linear section, which does not know where the actuator resonates."""


@dataclass(frozen=True)
class SlidingModeTuning:
    """Settings of equation (15), and of its boundary layer and observer; rates 1/s, epsilon output/s²."""

    convergence: float
    epsilon: float
    rho: float
    layer: float
    observer_bandwidth: float


@dataclass(frozen=True)
class PiTuning:
    """Gains on the error, in the unit of v a unit of output, and the same a second."""

    proportional: float
    integral: float


def tune_sliding_mode(linear: LinearSection, interval: float, model_error: float) -> SlidingModeTuning:
    """model_error : RMSE of the model on its fitted records, output unit.

    Raises ValueError where the sampling is too slow for any bandwidth from the natural frequency on.
    """
    natural = np.sqrt(linear.stiffness)
    found = None
    for bandwidth in natural * np.geomspace(1.0, 50.0, 200):
        if bandwidth * interval > 1.0 or _peak(sliding_mode_loop(linear, bandwidth, interval)) > PEAK:
            break
        found = float(bandwidth)
    if found is None:
        raise ValueError(
            f"sampling every {interval:g} s is too slow for a sliding mode on a stage of "
            f"{natural / (2 * np.pi):.3g} Hz; sample faster."
        )
    epsilon = linear.stiffness * ERRORS * model_error
    return SlidingModeTuning(found, epsilon, 0.5 * found, 2.0 * epsilon / found, found)


def tune_pi(linear: LinearSection | None, interval: float) -> PiTuning:
    """The strongest integral under the margin; without a linear section a cautious one."""
    if linear is None:
        return PiTuning(0.0, CAUTIOUS_INTEGRAL)
    z = _circle(interval)
    plant = _plant(linear, interval)
    summed = interval / (z - 1.0)
    best = PiTuning(0.0, 0.0)
    for proportional in np.arange(0.0, 10.0, 0.05) / linear.gain:
        if _peak(proportional * plant) > PEAK:
            break
        for integral in np.geomspace(1.0, np.pi / interval, 200) / linear.gain:
            if _peak((proportional + integral * summed) * plant) > PEAK:
                break
            if integral > best.integral:
                best = PiTuning(float(proportional), float(integral))
    return best


def sliding_mode_loop(linear: LinearSection, bandwidth: float, interval: float) -> Array:
    """Loop transfer of (15) inside its boundary layer, C and slope both `bandwidth`, opened at v."""
    watching = observer(linear, bandwidth, interval)
    feedback = np.array([bandwidth**2 - linear.stiffness, 2.0 * bandwidth - linear.damping, 0.0]) / linear.b
    closed = watching.transition - np.outer(watching.drive, feedback)
    unseen = np.eye(3)
    unseen[:, 0] -= watching.correction
    carried = closed @ unseen
    entered = closed @ watching.correction
    z = _circle(interval)
    inner = np.linalg.solve(z[:, None, None] * np.eye(3) - carried, np.broadcast_to(entered[:, None], (z.size, 3, 1)))
    law = inner[:, :, 0] @ (feedback @ unseen) + feedback @ watching.correction
    return law * _plant(linear, interval)


def _frequencies(interval: float) -> Array:
    """rad/s, up to half the sampling rate."""
    return np.geomspace(1e-4, 1.0, 600) * np.pi / interval


def _circle(interval: float) -> Array:
    return np.exp(1j * _frequencies(interval) * interval)


def _plant(linear: LinearSection, interval: float) -> Array:
    """The linear section behind a hold and the spare lag."""
    s = 1j * _frequencies(interval)
    hold = np.exp(-0.5 * s * interval) * np.sinc(np.imag(s) * interval / (2.0 * np.pi))
    lag = np.exp(-SPARE_SAMPLES * s * interval)
    return linear.b / (s**2 + linear.damping * s + linear.stiffness) * hold * lag


def _peak(loop: Array) -> float:
    return float(np.max(1.0 / np.abs(1.0 + loop)))
