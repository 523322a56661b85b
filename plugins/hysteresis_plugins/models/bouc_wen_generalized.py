"""Generalized Bouc-Wen: asymmetric, with degrading strength and stiffness, and with pinching.

[1] C.-H. Wang, Y.-K. Wen, Structural Safety 22 (2000) 29: the asymmetric shape.
[2] T. T. Baber, M. N. Noori, J. Engineering Mechanics 111 (1985) 1010: degradation and pinching.
[3] G. C. Foliente, J. Structural Engineering 121 (1995) 1013.

Legend: u displacement, F force, z hysteresis as a share of its bound, E = integral of z du.
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
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, output_span, path, sense, sided, steepness

STRONGEST = 5.0
"""Largest hysteresis, in ranges of the output."""


@dataclass(frozen=True)
class BoucWenGeneralized(Model):
    """Generalized Bouc-Wen: asymmetric loops of any smoothness that degrade and pinch.

    F = slope u + F_y z, dz/du = h (1 - nu |z|^n (beta sgn(u'z) + 1 - beta + phi (sgn u' + sgn z))) / (eta u_y) [1],
    nu = 1 + delta_nu E, eta = 1 + delta_eta E, h = 1 - zeta (1 - exp(-p E)) exp(-((z sgn u' - q z_u) / width)²) [2, 3],
    z_u the bound of z. Rate-independent; linear in slope and F_y. With F_y >= 0 the loop runs clockwise, force over
    displacement, with F_y <= 0 anticlockwise; the box takes the side on which the records' loops run. Bouc-Wen is
    phi = delta_nu = delta_eta = zeta = 0.

    Ours: z is bounded by 1 where nothing degrades; of [2] A does not degrade and the width of the pinching is
    constant; degradations of the other sign, hardening, are in the box. The constant is the effect bias, or
    record-offset.
    """

    parameters = (
        Parameter("u_y", 1e-2, 2.0, "{input}", "log", meaning="displacement of yielding, F_y over k", positive=True),
        Parameter("n", 1.0, 8.0, scaling="log", meaning="smoothness of yielding", positive=True),
        Parameter("beta", 0.0, 1.0, meaning="shape of unloading; 0.5 is straight"),
        Parameter("phi", -0.4, 0.4, meaning="asymmetry of strength"),
        Parameter("delta_nu", -0.1, 1.0, "1/{input}", meaning="loss of strength with E"),
        Parameter("delta_eta", -0.1, 1.0, "1/{input}", meaning="loss of stiffness with E"),
        Parameter("zeta", 0.0, 0.98, meaning="depth of the pinching in the end"),
        Parameter("p", 1e-2, 10.0, "1/{input}", "log", meaning="growth of the pinching with E", positive=True),
        Parameter("q", -0.5, 0.9, meaning="where it pinches, as a share of the bound of z"),
        Parameter("width", 0.03, 1.0, scaling="log", meaning="of the pinching, in z", positive=True),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part without hysteresis"),
        Parameter("F_y", 0.0, 5.0, "{output}", meaning="strength"),
    )
    linear = ("slope", "F_y")
    properties = ("rate-independent",)
    example = Example(
        4.0,
        {
            "u_y": 0.8,
            "n": 1.5,
            "beta": 0.6,
            "phi": 0.05,
            "delta_nu": 2e-3,
            "delta_eta": 2e-3,
            "zeta": 0.3,
            "p": 0.1,
            "q": 0.1,
            "width": 0.3,
            "slope": 0.4,
            "F_y": 1.5,
        },
        stream=11,
        without=("input-bias",),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.bouc_wen_generalized import bouc_wen_generalized

        force = bouc_wen_generalized(signal.input, np.stack(p[:10]))
        force *= p.F_y
        force += p.slope * signal.input
        return force

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The displacement of yielding from a thousandth of the span of the input to all of it; over the longest path
        degradation of the strength up to an eleventh (n = 1), of the stiffness up to a fiftieth, and hardening by ten
        times; forces up to five times the range of the output, on the side of the loops' sense, on both where the data
        do not say."""
        boxes = {q.name: q for q in self.parameters}
        span, longest = input_span(records), path(records)
        most = STEEPEST * steepness(records)
        inside = {
            "u_y": boxes["u_y"].within(1e-3 * span, span),
            "delta_nu": boxes["delta_nu"].within(-0.9 / longest, 10.0 / longest),
            "delta_eta": boxes["delta_eta"].within(-0.9 / longest, 50.0 / longest),
            "p": boxes["p"].within(0.1 / longest, 1e3 / longest),
            "slope": boxes["slope"].within(-most, most),
            "F_y": sided(boxes["F_y"], STRONGEST * output_span(records), -sense(records)),
        }
        return tuple(inside.get(name, box) for name, box in boxes.items())

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)
