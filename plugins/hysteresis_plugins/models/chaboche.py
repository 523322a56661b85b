"""Cyclic plasticity of metals: Chaboche's kinematic and Voce's isotropic hardening, under one strain.

[1] J. Lemaitre, J.-L. Chaboche, Mechanics of Solid Materials, Cambridge University Press (1990), section 5.4.
[2] A. R. Hartloper, A. de Castro e Sousa, D. G. Lignos, J. Structural Engineering 147 (2021) 04021028: the updated
    Voce-Chaboche law, whose D and a tell the drop after a yield plateau.

Legend: u strain, stress the output, u_y the strain of first yield, E Young's modulus, p the plastic path,
X_k backstresses.
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
from hysteresis_plugins.models._data import STEEPEST, falling, input_span, offset, path, steepness

STRESSES = [0, 1, 3, 5, 7]
"""Rows of the kernel's parameters that are stresses over E."""


def over_modulus(u: Array, p: Any) -> Array:
    """Stress over E, (samples, swarm);  u : strain, (samples, 1) or (samples, swarm)"""
    from hysteresis_bench.kernels.metal_plasticity import metal_plasticity

    shares = np.stack([np.ones_like(p.u_y), p.Q, p.b, p.D, p.a, p.S_1, p.gamma_1, p.S_2, p.gamma_2])
    shares[STRESSES] *= p.u_y
    return metal_plasticity(u, shares)


@dataclass(frozen=True)
class Chaboche(Model):
    """Chaboche: elastic strain, then plastic flow with two backstresses and a yield stress that hardens or softens.

    stress = E (u - u_p), |stress - X_1 - X_2| <= E u_y (1 + Q (1 - exp(-b p)) - D (1 - exp(-a p))),
    dX_k = gamma_k (E u_y S_k du_p - X_k dp) [1, 2]. Rate-independent, passive where it does not soften, and linear in
    E; its loop runs clockwise, stress over strain, and hardens or softens along the plastic path.

    Ours: u_y is a strain, and hardening is told as a share of it. All start unstrained at the first sample. The
    constant is the effect bias, or record-offset.
    """

    parameters = (
        Parameter("u_y", 1e-3, 1.0, "{input}", "log", meaning="first yield stress over E", positive=True),
        Parameter("Q", -0.5, 3.0, meaning="isotropic hardening in the end, of the yield stress"),
        Parameter("b", 1e-2, 10.0, "1/{input}", "log", meaning="rate of it along the plastic path", positive=True),
        Parameter("D", 0.0, 0.45, meaning="drop after the first yield in the end, of the yield stress"),
        Parameter("a", 1e-2, 100.0, "1/{input}", "log", meaning="rate of it along the plastic path", positive=True),
        Parameter("S_1", 0.0, 3.0, meaning="first backstress in the end, of the yield stress"),
        Parameter("gamma_1", 0.1, 100.0, "1/{input}", "log", meaning="rate of it along the plastic strain"),
        Parameter("S_2", 0.0, 3.0, meaning="second backstress in the end, of the yield stress"),
        Parameter("gamma_2", 0.1, 100.0, "1/{input}", "log", meaning="rate of it along the plastic strain"),
        Parameter("E", 0.0, 50.0, "{output}/{input}", meaning="Young's modulus"),
    )
    linear = ("E",)
    properties = ("rate-independent", "odd")
    senses = (-1,)
    example = Example(
        4.0,
        {
            "u_y": 0.6,
            "Q": 0.4,
            "b": 0.1,
            "D": 0.1,
            "a": 1.0,
            "S_1": 0.6,
            "gamma_1": 2.0,
            "S_2": 0.8,
            "gamma_2": 0.3,
            "E": 1.2,
        },
        stream=18,
        without=("input-bias",),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        stress = over_modulus(signal.input, p)
        stress *= p.E
        return stress

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The strain of yield from a thousandth of the span of the input to half of it; backstresses that are built up
        over a ten-thousandth of the span to thirty spans, hardening over a thousandth of the span to ten times the
        longest path."""
        boxes = {q.name: q for q in self.parameters}
        span, longest = input_span(records), path(records)
        inside = {
            "u_y": boxes["u_y"].within(1e-3 * span, 0.5 * span),
            "b": boxes["b"].within(0.1 / longest, 1e3 / span),
            "a": boxes["a"].within(0.1 / longest, 1e3 / span),
            "gamma_1": boxes["gamma_1"].within(0.03 / span, 1e4 / span),
            "gamma_2": boxes["gamma_2"].within(0.03 / span, 1e4 / span),
            "E": boxes["E"].within(0.0, STEEPEST * steepness(records)),
        }
        return tuple(inside.get(name, box) for name, box in boxes.items())

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "the stress of this law rises with the strain") or offset(records)
