"""Folz and Filiatrault's law of timber connections and shear walls: pinched loops that remember how far they went.

[1] B. Folz, A. Filiatrault, J. Structural Engineering 127 (2001) 1361, known as CASHEW or SAWS.

Legend: u displacement, F force, u_y = F_0 / S with the stiffness S at rest, X the largest displacement of a reversal
over u_y.
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
class FolzFiliatrault(Model):
    """Folz-Filiatrault: timber joints, which pinch and go back to their envelope the softer the further they went.

    The envelope is F = (F_0 + r_1 S u)(1 - exp(-S u / F_0)). From a reversal the force goes along r_3 S to a pinched
    line through f_I F_0 of slope r_4 K, then along a line of slope K that ends on the envelope at beta u_y X, where
    K = S X^-alpha [1]. Rate-independent and linear in F_0; its loop runs clockwise, force over displacement.

    Ours: the envelope has no peak, so that failure is outside the law; the pinched line softens as the way back does;
    X is the largest displacement, not the last one. Unloaded at the first sample, from which displacements count. The
    constant is the effect bias, or record-offset.
    """

    parameters = (
        Parameter("u_y", 1e-2, 2.0, "{input}", "log", meaning="strength over stiffness at rest", positive=True),
        Parameter("r_1", 0.0, 0.5, meaning="slope of the envelope in the end, of S"),
        Parameter("r_3", 0.3, 30.0, scaling="log", meaning="slope of unloading, of S", positive=True),
        Parameter("f_I", 0.0, 1.0, meaning="force of the pinched line at 0, of F_0"),
        Parameter("r_4", 0.0, 1.0, meaning="slope of the pinched line, of K"),
        Parameter("alpha", 0.0, 1.5, meaning="how K falls with the largest displacement"),
        Parameter("beta", 1.0, 1.5, meaning="where the way back ends, of the largest displacement"),
        Parameter("F_0", 0.0, 5.0, "{output}", meaning="strength"),
    )
    linear = ("F_0",)
    properties = ("rate-independent", "odd")
    senses = (-1,)
    example = Example(
        4.0,
        {"u_y": 0.6, "r_1": 0.05, "r_3": 1.2, "f_I": 0.1, "r_4": 0.3, "alpha": 0.6, "beta": 1.05, "F_0": 1.5},
        stream=20,
        without=("input-bias",),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.timber import timber

        force = timber(signal.input, np.stack(p[:7]))
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
