"""Homogenized free-energy magnetization, eqs. (1)-(3) of the magnetostrictive actuator's paper.

Chang G., Zhang Y., Parameter Identification of GMA Nonlinear Dynamics Model Based on ICPSO; the model is
R. C. Smith's, Smart Material Systems: Model Development, SIAM 2005.

| symbol | name  | meaning                                                        |
|--------|-------|----------------------------------------------------------------|
| M_R    | M_R   | magnetization at which a kernel's free energy is least         |
| η      | eta   | slope of a kernel: dH/dM                                       |
| H̄_c    | H_c   | mean coercive field                                            |
| b      | b     | width of the interaction field's density                       |
| c      | c     | width of the coercive field's density, in ln H_c               |
| α      | alpha | scale of the densities                                         |

Only α M_R, M_R η, H̄_c, b and c act on the output.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import largest_output
from hysteresis_plugins.models._eddy_current import OFFERS, with_eddy_current


@dataclass(frozen=True)
class FreeEnergy(Model):
    """Homogenized free-energy hysteresis: a field to a magnetization, demagnetized at the first sample.

    Any input and output will do; the field's names are kept. The box is ours (the paper prints none), for a
    field and a magnetization of the order of 1; `box` scales it to the data. Kernel (2) is read as
    H_e / eta + M_R after +H_c and H_e / eta - M_R after -H_c, H_e = H + H_I; the paper prints "max tau" for
    the field at that time.

    rule, nodes, span : quadrature over ln H_c. The integrand has a kink wherever a play has stopped, so a
    plain trapezoid beats the Gauss rules: relative RMS error 2.6e-3, 1.0e-3 and 2.6e-4 with 32, 48 and 64
    nodes on +-3, against 5.3e-3, 4.4e-3 and 3.2e-3 by Gauss-Hermite (a decaying sine of peak 4 H_c, c = 0.25).

    Raises ValueError where H_c, b, c or eta is not above 0.
    """

    parameters = (
        Parameter("M_R", 0.01, 10.0, "{output}", "log", meaning="remanence of a kernel"),
        Parameter("eta", 0.1, 1000.0, "{input}/{output}", "log", meaning="slope of a kernel, dH/dM", positive=True),
        Parameter("H_c", 0.001, 2.0, "{input}", "log", meaning="mean coercive field", positive=True),
        Parameter("b", 0.01, 5.0, "{input}", "log", meaning="width of the interaction field's density", positive=True),
        Parameter(
            "c", 0.02, 1.5, "1", "log", meaning="width of the coercive field's density, in ln H_c", positive=True
        ),
        Parameter("alpha", 0.01, 1000.0, "1/{input}^2", "log", meaning="scale of the densities"),
    )
    linear = ("M_R",)
    properties = ("rate-independent", "odd", "return-point", "congruent")
    senses = (1,)
    offers = OFFERS
    example = Example(4.0, {"M_R": 1.0, "eta": 4.0, "H_c": 1.1, "b": 1.0, "c": 0.35, "alpha": 0.6}, stream=1)

    rule: Literal["trapezoid", "gauss-legendre", "gauss-hermite"] = "trapezoid"
    nodes: int = 64
    span: float = 3.0

    def __post_init__(self) -> None:
        if self.nodes < 2:
            raise ValueError(f"nodes = {self.nodes} must be at least 2")
        if self.span <= 0.0:
            raise ValueError(f"span = {self.span} must be above 0")

    @cached_property
    def _quadrature(self) -> tuple[Array, Array]:
        from hysteresis_bench.kernels.free_energy import quadrature

        return quadrature(self.rule, self.nodes, self.span)

    def simulate(self, signal: Signal, p: Any) -> Array:
        for name in ("H_c", "b", "c", "eta"):
            least = np.min(getattr(p, name))
            if not least > 0.0:
                raise ValueError(f"free-energy: {name} must be above 0, not {least:g}")
        return with_eddy_current(self._plain, self._dragged, signal, p)

    def _plain(self, H: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.free_energy import magnetization

        return magnetization(H, *self._law(p))

    def _dragged(self, time: Array, H: Array, coefficient: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.eddy_free_energy import eddy_magnetization

        return eddy_magnetization(time, H, coefficient, *self._law(p))

    def _law(self, p: Any) -> tuple[Array, ...]:
        """What the kernel takes after the field."""
        # (1): alpha times the integrals of both densities, with dH_c = 2 c H_c dx and H_c = mean exp(2 c x)
        mass = p.alpha * (np.sqrt(2 * np.pi) * p.b) * (2 * np.sqrt(np.pi) * p.c * p.H_c * np.exp(p.c**2))
        return mass / p.eta, mass * p.M_R, p.H_c, p.c, p.b, *self._quadrature

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The box of fields and magnetizations of the order of 1, scaled to the ranges of the records."""
        field = max(float(np.max(np.abs(record.input))) for record in records) or 1.0
        output = largest_output(records) or 1.0
        scales = {"M_R": output, "eta": field / output, "H_c": field, "b": field, "c": 1.0, "alpha": field**-2}
        return tuple(q.within(q.lower * scales[q.name], q.upper * scales[q.name]) for q in self.parameters)

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return tuple(sentence for record in records for sentence in unswitched(record.name, record.input))


def unswitched(name: str, field: Array) -> tuple[str, ...]:
    """Sentences on why a field over time cannot tell the widths of the densities; none where it can."""
    if np.ptp(field) == 0.0:
        return (f"record {name}: the field never changes; there is nothing to identify",)
    from hysteresis_bench.kernels.play import play

    # a play of 2 % of the range either way does not follow the noise of a measured input
    steps = np.diff(play(field[:, None], np.array([0.02 * np.ptp(field)]))[:, 0])
    turns = np.count_nonzero(np.diff(np.sign(steps[steps != 0.0])))
    if turns == 0:
        return (f"record {name}: the field never turns; without a loop H_c and c cannot be told",)
    if turns == 1:
        return (f"record {name}: the field turns only once, less than a period; no loop closes",)
    return ()
