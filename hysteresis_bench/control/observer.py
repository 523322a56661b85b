"""Position and velocity of the linear section from a noisy, quantised position.

Differences of a sensor that steps by 3 nm are useless as a velocity: at 10 kHz one step is 30 um/s. The observer runs
the linear section beside the actuator, driven by the same v, and corrects it with every reading. A third state, a
constant unknown force, keeps position and velocity free of bias where the actuator is not the model (creep,
hysteresis left over); the control law does not see it. It is the extended state observer of [1], discretised exactly
for a v that is held, with all poles in one place.

[1] Gao, "Scaling and bandwidth-parameterization based controller tuning", American Control Conference 2003, 4989-4996.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.feed_forward import LinearSection


@dataclass(frozen=True, eq=False)
class Observer:
    """States: position, velocity, unknown force over mass.

    transition : (3, 3), drive : (3,), of one sample with v held;  correction : (3,), times the innovation
    """

    transition: Array
    drive: Array
    correction: Array

    def corrected(self, predicted: Array, measured: float) -> Array:
        """The estimate once the reading is known."""
        estimate: Array = predicted + self.correction * (measured - predicted[0])
        return estimate

    def predicted(self, estimate: Array, v: float) -> Array:
        """The estimate one sample later, v held."""
        later: Array = self.transition @ estimate + self.drive * v
        return later


def observer(linear: LinearSection, bandwidth: float, interval: float) -> Observer:
    """The observer whose three poles lie at -bandwidth; bandwidth rad/s, interval s between samples."""
    from scipy.linalg import expm

    flow = np.zeros((4, 4))  # states, then v
    flow[0, 1] = 1.0
    flow[1] = [-linear.stiffness, -linear.damping, 1.0, linear.b]
    step = expm(flow * interval)
    transition, drive = step[:3, :3], step[:3, 3]
    # Ackermann's formula for the error of the prediction, transition (1 - correction first row)
    shifted = transition - np.exp(-bandwidth * interval) * np.eye(3)
    seen = np.vstack([np.linalg.matrix_power(transition, power)[0] for power in range(3)])
    gain = np.linalg.matrix_power(shifted, 3) @ np.linalg.solve(seen, [0.0, 0.0, 1.0])
    return Observer(transition, drive, np.linalg.solve(transition, gain))


@dataclass(frozen=True)
class Differences:
    """No observer: the reading itself, and the velocity as its difference, noise and rounding included.

    interval : s, between samples
    """

    interval: float

    def corrected(self, predicted: Array, measured: float) -> Array:
        """predicted : the estimate at the sample before"""
        return np.array([measured, (measured - predicted[0]) / self.interval, 0.0])

    def predicted(self, estimate: Array, v: float) -> Array:
        return estimate
