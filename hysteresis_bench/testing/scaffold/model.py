"""Dahl's model of friction, driven by a displacement.

[1] P. R. Dahl, A solid friction model, The Aerospace Corporation, report TOR-0158(3107-18)-1 (1968).
[2] C. Canudas de Wit et al., A new model for control of systems with friction, IEEE Transactions on Automatic Control
    40 (1995) 419-425, equation (1).

Legend: x displacement, the input; F friction force, the output; F_c its ceiling; sigma the stiffness at F = 0.
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


@dataclass(frozen=True)
class Example(Model):
    """Dahl's friction [1]: a force that goes to its ceiling along the path of the input, and turns with it.

    dF/dx = sigma (1 - F/F_c sgn(dx/dt)) [2] (1), exact for an input that is linear between its samples. Ours: F = 0 at
    the first sample. Rate-independent: the order of samples matters, their times do not.
    """

    parameters = (
        Parameter("sigma", 1e-3, 1e3, "{output}/{input}", "log", positive=True, meaning="stiffness at rest"),
        Parameter("F_c", 1e-3, 1e3, "{output}", "log", positive=True, meaning="ceiling of the force"),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        samples, swarm = signal.input.shape[0], p.sigma.size
        force = np.zeros((samples, swarm))
        moved = np.diff(signal.input, axis=0)
        towards = np.sign(moved) * p.F_c
        kept = np.exp(-np.abs(moved) * p.sigma / p.F_c)
        for k in range(1, samples):
            force[k] = towards[k - 1] + (force[k - 1] - towards[k - 1]) * kept[k - 1]  # [2] (1), integrated
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Ceilings from a hundredth of the output's range to ten ranges; the ceiling is reached, at this stiffness,
        within a thousandth of the input's range to ten ranges."""
        sigma, ceiling = self.parameters
        span_in = max(float(np.ptp(record.input)) for record in records) or 1.0
        span_out = max((float(np.ptp(one.measured)) for one in records if one.output is not None), default=0.0) or 1.0
        slope = span_out / span_in
        return sigma.within(1e-3 * slope, 1e4 * slope), ceiling.within(0.01 * span_out, 10.0 * span_out)
