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
from hysteresis_plugins.models._eddy_current import OFFERS, with_eddy_current

OFFSET_SHARE = 0.02
"""Share of the output's span from which a record's offset is worth a word."""


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
    offers = OFFERS
    example = Example(4.0, {"alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2}, stream=0)

    n: float = 1.0

    def __post_init__(self) -> None:
        if not 1.0 <= self.n < np.inf:
            raise ValueError(f"n = {self.n} must be a finite number of at least 1.")

    def simulate(self, signal: Signal, p: Any) -> Array:
        return with_eddy_current(self._plain, self._dragged, signal, p)

    def _plain(self, u: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.bouc_wen import bouc_wen
        from hysteresis_bench.kernels.bouc_wen_power import bouc_wen_power

        if self.n == 1.0:
            return bouc_wen(u, p.alpha, p.beta, p.gamma, p.d)
        return bouc_wen_power(u, p.alpha, p.beta, p.gamma, p.d, float(self.n))

    def _dragged(self, time: Array, u: Array, coefficient: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.eddy_bouc_wen import eddy_bouc_wen

        return eddy_bouc_wen(time, u, coefficient, p.alpha, p.beta, p.gamma, p.d, float(self.n))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From the spans of the data: d up to four times their ratio; the loop relaxes over a thousandth of
        the input's span to thirty spans (for n other than 1, beta and gamma scale with the output too)."""
        alpha, beta, gamma, d = self.parameters
        span = input_span(records)
        ratio = output_span(records) / span
        try:
            unit = 1.0 / (span * output_span(records) ** (self.n - 1.0))
        except ArithmeticError:  # a box that is told not to be finite
            unit = np.inf
        return (
            alpha.within(0.0, 2.0),
            beta.within(0.03 * unit, 1000.0 * unit, "log"),
            gamma.within(-100.0 * unit, 100.0 * unit),
            d.within(0.0, 4.0 * ratio),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        measured = [record for record in records if record.output is not None]
        falling = [record.name for record in measured if _slope(record) < 0.0]
        offset = [record.name for record in measured if _offset(record) > OFFSET_SHARE]
        said = []
        if falling:
            said.append(
                f"The output falls as the input rises in {', '.join(falling)}; d is positive in this box. "
                "Turn the output's sign with --flip."
            )
        if offset and not falling:
            said.append(
                f"The output does not start at d times the input in {', '.join(offset)}, and the model has no offset. "
                "Add the effect bias, or record-offset where it differs from record to record."
            )
        return tuple(said)


def input_span(records: Sequence[Record]) -> float:
    """Largest span of the input in one record, 1 where it never moves."""
    return max(float(np.ptp(record.input)) for record in records) or 1.0


def output_span(records: Sequence[Record]) -> float:
    """Largest span of the output in one record, 1 where there is none."""
    return max((float(np.ptp(record.measured)) for record in records if record.output is not None), default=0.0) or 1.0


def _slope(record: Record) -> float:
    """Covariance of input and output: its sign is the response's."""
    driven = record.input[record.scored] - np.mean(record.input[record.scored])
    return float(driven @ record.measured)


def _offset(record: Record) -> float:
    """|output - slope * input| of the middle of the loop, as a share of the output's span."""
    driven, measured = record.input[record.scored], record.measured
    centre_in, centre_out = (0.5 * (values.min() + values.max()) for values in (driven, measured))
    span_in, span_out = float(np.ptp(driven)), float(np.ptp(measured))
    if span_in == 0.0 or span_out == 0.0:
        return 0.0
    # a loop that starts at rest may sit half its own height off the line, so that much is no offset
    slope = span_out / span_in
    height = float(np.ptp(measured - slope * driven))
    return float(max(abs(centre_out - slope * centre_in) - height, 0.0) / span_out)
