"""Bouc-Wen hysteresis in the form that the piezo literature uses.

[1] The PEA paper, equation (1):  v = d u - h,  dh/dt = alpha d u' - beta |u'| |h|^(n-1) h - gamma u' |h|^n.

Legend: u input, v output, h hysteresis, d the linear response, alpha how much of it is lost just after h = 0,
beta and gamma the shape of the loop, n its smoothness. The loop's half height is alpha d / (beta + gamma).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import falling, input_span, offset, output_span, sense
from hysteresis_plugins.models._eddy_current import OFFERS, with_eddy_current

ANTICLOCKWISE, CLOCKWISE = 2.0, -200.0
"""Largest alpha of either sense in the box that data give. A lagging response of alpha above 1 falls after a reversal;
what sticks is stiffer than the linear response by -alpha."""


@dataclass(frozen=True)
class BoucWen(Model):
    """Bouc-Wen: a linear response less a hysteresis that relaxes along the input's path.

    n : smoothness of the loop, at least 1; 1 is exact and fastest, others are integrated to 1e-8 or better

    Ours: h = 0 at the first sample, so v(0) = d u(0). The paper gives no search box; ours for its data
    (volts, micrometres) is 0 to 5 for every parameter.
    """

    parameters = (
        Parameter(
            "alpha", 0.0, 5.0, null=0.0, meaning="share of the linear response that the hysteresis takes at h = 0"
        ),
        Parameter("beta", 0.0, 5.0, unit="1/{input}", meaning="shape of the loop: relaxation on any movement"),
        Parameter("gamma", 0.0, 5.0, unit="1/{input}", meaning="shape of the loop: relaxation by direction"),
        Parameter("d", 0.0, 5.0, unit="{output}/{input}", meaning="linear response"),
    )
    linear = ("d",)
    properties = ("rate-independent", "odd")
    offers = OFFERS
    example = Example(4.0, {"alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2}, stream=0, without=("input-bias",))

    n: float = 1.0

    def __post_init__(self) -> None:
        if not 1.0 <= self.n < np.inf:
            raise ValueError(f"n = {self.n} must be a finite number of at least 1.")
        object.__setattr__(self, "linear", ("d",) if self.n == 1.0 else ())  # |h|^n does not scale with h

    def simulate(self, signal: Signal, p: Any) -> Array:
        return with_eddy_current(self._plain, self._dragged, signal, p)

    def _plain(self, u: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.bouc_wen import bouc_wen

        if self.n == 1.0:
            return bouc_wen(u, p.alpha, p.beta, p.gamma, p.d)
        from hysteresis_bench.kernels.bouc_wen_power import bouc_wen_power

        return bouc_wen_power(u, p.alpha, p.beta, p.gamma, p.d, float(self.n))

    def _dragged(self, time: Array, u: Array, coefficient: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.eddy_bouc_wen import eddy_bouc_wen

        return eddy_bouc_wen(time, u, coefficient, p.alpha, p.beta, p.gamma, p.d, float(self.n))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From the spans of the data: d up to four times their ratio; the loop relaxes over a thousandth of
        the input's span to thirty spans (for n other than 1, beta and gamma scale with the output too). Alpha is on
        the side of the loops' sense, positive for loops that run anticlockwise; on both where the data do not say."""
        alpha, beta, gamma, d = self.parameters
        span, side = input_span(records), sense(records)
        ratio = output_span(records) / span
        try:
            unit = 1.0 / (span * output_span(records) ** (self.n - 1.0))
        except ArithmeticError:  # a box that is told not to be finite
            unit = np.inf
        return (
            alpha.within(CLOCKWISE if side <= 0 else 0.0, ANTICLOCKWISE if side >= 0 else 0.0),
            beta.within(0.03 * unit, 1000.0 * unit, "log"),
            gamma.within(-100.0 * unit, 100.0 * unit),
            d.within(0.0, 4.0 * ratio),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "d is positive in this box") or offset(records)
