"""The sliding-mode law of the PEA paper, on the linear section.

[1] The PEA paper, equation (15):

    u = [epsilon sgn(s) + rho s + C (x' - x2) + x'' + (k/m) x1 + (c/m) x2] / b,    s = C (x - x1) + (x' - x2)

Legend: x reference, x1 measured position, x2 its velocity, s the sliding function, C how fast the error decays on
s = 0, epsilon and rho the reaching law s' = -epsilon sgn(s) - rho s. The u of (15) is the input v of the linear
section; the inverse hysteresis turns it into a voltage.

The paper does not say where x1 and x2 come from. As printed, we take the reading and its difference; ours is an
observer, see `observer`. The law is evaluated at every sample and held.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.closed_loop import Target
from hysteresis_bench.control.feed_forward import LinearSection
from hysteresis_bench.control.observer import Differences, Observer


@dataclass(frozen=True, eq=False)
class SlidingMode:
    """Equation (15).

    convergence : C, 1/s;  epsilon : um/s² for an output in um;  rho : 1/s
    layer : half width of the boundary layer in which s / layer takes the place of sgn(s); 0 is (15) as printed
    """

    linear: LinearSection
    observer: Observer | Differences
    convergence: float
    epsilon: float
    rho: float
    layer: float = 0.0

    def nominal(self, wanted: Target) -> Any:
        return self.linear.driven(*wanted)

    def start(self) -> Array:
        return np.zeros(3)

    def command(self, state: Array, target: Target, measured: float) -> tuple[float, Array]:
        """v, and the corrected estimate."""
        estimate = self.observer.corrected(state, measured)
        x1, x2 = float(estimate[0]), float(estimate[1])
        off, slower = target.position - x1, target.velocity - x2
        s = self.convergence * off + slower
        v = (
            self.epsilon * self._sign(s)
            + self.rho * s
            + self.convergence * slower
            + target.acceleration
            + self.linear.stiffness * x1
            + self.linear.damping * x2
        ) / self.linear.b  # [1] (15)
        return v, estimate

    def applied(self, state: Array, v: float, cut: bool) -> Array:
        """The prediction of the next sample, from the v that really went out."""
        return self.observer.predicted(state, v)

    def _sign(self, s: float) -> float:
        if self.layer > 0.0:
            return min(max(s / self.layer, -1.0), 1.0)
        return math.copysign(1.0, s) if s != 0.0 else 0.0
