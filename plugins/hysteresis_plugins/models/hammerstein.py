"""The Hammerstein model of the PEA paper: Bouc-Wen hysteresis, then a mass, a spring and a damper.

[1] The PEA paper, equations (1) to (5): G(s) = b / (s² + (c/m) s + k/m) acts on the output v of Bouc-Wen.

Legend: m mass, c damping, k stiffness, b the gain of the force; alpha, beta, gamma, d as in `bouc_wen`.
Only the product d b is seen in data: fix d, or b, to identify the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects.resonance import fastest_period
from hysteresis_plugins.models.bouc_wen import BoucWen


@dataclass(frozen=True)
class Hammerstein(Model):
    """Bouc-Wen hysteresis followed by a second-order linear stage.

    n : smoothness of the loop, as in `bouc-wen`

    The stage is exact for a v that is linear between its samples. Ours: it starts in static equilibrium with
    the first sample; where time is only an index it is its static gain b / (k/m). The paper gives no search
    box; ours surrounds its Table 3, and keeps the stage stable.
    """

    parameters = (
        *BoucWen.parameters,
        Parameter("b", 1e4, 1e6, unit="1/{time}^2", scaling="log", meaning="gain of the linear stage"),
        Parameter("c_over_m", 10.0, 1e4, unit="1/{time}", scaling="log", meaning="damping over mass"),
        Parameter("k_over_m", 1e4, 1e6, unit="1/{time}^2", scaling="log", meaning="stiffness over mass"),
    )

    linear = ("b",)
    properties = ("odd",)

    n: float = 1.0

    def __post_init__(self) -> None:
        BoucWen(self.n)

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.second_order import second_order

        v = BoucWen(self.n).simulate(signal, p)
        if signal.timed:
            v = second_order(signal.time, v, p.c_over_m, p.k_over_m)
        v *= p.b / p.k_over_m  # [1] (5): the static gain
        return v

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Bouc-Wen's box; natural frequencies from half the fastest record's to a tenth of the sampling rate,
        at least a decade; b as k/m, a static gain near 1; damping ratios from 0.02 to 2 at either end."""
        b, c_over_m, k_over_m = self.parameters[4:]
        step = min(float(np.median(np.diff(record.time))) for record in records)
        slow = np.pi / fastest_period(records)
        fast = max(0.2 * np.pi / step, 10.0 * slow)
        return (
            *BoucWen(self.n).box(records),
            b.within(0.1 * slow**2, 10.0 * fast**2),
            c_over_m.within(0.04 * slow, 4.0 * fast),
            k_over_m.within(slow**2, fast**2),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        said = BoucWen(self.n).advice(records)
        if not all(record.timed for record in records):
            said += ("Time is only an index here: the linear stage is its static gain; use bouc-wen.",)
        return said
