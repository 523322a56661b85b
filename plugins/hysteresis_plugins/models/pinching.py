"""Pinching: loops of joints that slip in holes they have worn and remember how far they went, round at every corner.

[1] B. Folz, A. Filiatrault, J. Structural Engineering 127 (2001) 1361: envelope, pinched line, way back.
[2] W.-C. Pang, D. V. Rosowsky, S. Pei, J. W. van de Lindt, J. Structural Engineering 133 (2007) 1118: curved ways of
    shear walls, exponential ones in place of lines.

Legend: u displacement, F force, x = u / u_y, X the largest displacement of a reversal on the side to which it goes over
u_y, M that of both sides; M^gamma and rho M grow from M = 1 on.
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
from hysteresis_plugins.models._data import falling, input_span, offset, output_span

STRONGEST = 5.0
"""Largest strength, in ranges of the output."""


@dataclass(frozen=True)
class Pinching(Model):
    """Pinching: joints and walls that slip in holes they have worn, with loops that are round at every corner.

    The envelope is F / F_0 = (1 + r_1 x) (1 - exp(-x)) [1]. After a reversal the force leads along a pinched line
    f_I M^gamma + r_4 x / (1 + beta M), round a corner, and along the slope at rest to the envelope at beta X; it comes
    from where it was to this way exponentially, over a displacement of rho M u_y, after [2]. Rate-independent and
    linear in F_0; its loop runs clockwise, force over displacement.

    Ours: the corner is a hyperbola of the size corner M^gamma; what slips grows with M, and so does what unloading
    takes; the pinched line is lowered where it would end above the envelope. The envelope has no peak, so that failure
    is outside the law. Unloaded at the first sample, from which displacements count. The constant is the effect bias,
    or record-offset.
    """

    parameters = (
        Parameter("u_y", 1e-2, 2.0, "{input}", "log", meaning="strength over stiffness at rest", positive=True),
        Parameter("r_1", 0.0, 0.5, meaning="slope of the envelope in the end, of that at rest"),
        Parameter("f_I", 0.0, 0.5, meaning="force of the pinched line at 0, of F_0"),
        Parameter("gamma", 0.0, 1.2, meaning="how it and the corner grow with the largest displacement"),
        Parameter("r_4", 0.0, 1.0, meaning="rise of the pinched line up to the largest displacement, of F_0"),
        Parameter("beta", 1.0, 1.5, meaning="where the way back ends, of the largest displacement"),
        Parameter("rho", 0.005, 0.2, scaling="log", meaning="unloading, of the largest displacement", positive=True),
        Parameter("corner", 0.0, 1.0, meaning="size of the corner, of F_0"),
        Parameter("F_0", 0.0, 5.0, "{output}", meaning="strength"),
    )
    linear = ("F_0",)
    properties = ("rate-independent", "odd")
    senses = (-1,)
    example = Example(
        4.0,
        {
            "u_y": 0.6,
            "r_1": 0.08,
            "f_I": 0.05,
            "gamma": 0.4,
            "r_4": 0.7,
            "beta": 1.05,
            "rho": 0.08,
            "corner": 0.3,
            "F_0": 1.5,
        },
        stream=21,
        without=("input-bias",),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.pinching import pinching

        force = pinching(signal.input, np.stack(p[:8]))
        force *= p.F_0
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """u_y from a thousandth of the span of the input to all of it; the strength up to five times the range of the
        output."""
        yielding, *shares, strength = self.parameters
        span = input_span(records)
        return (
            yielding.within(1e-3 * span, span),
            *shares,
            strength.within(0.0, STRONGEST * output_span(records)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "the force of this law rises with the displacement") or offset(records)
