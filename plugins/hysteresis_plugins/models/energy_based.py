"""Energy-based hysteresis: cells with dry friction in the field, and a mean field.

[1] A. Bergqvist, Physica B 233 (1997) 342.
[2] F. Henrotte, A. Nicolet, K. Hameyer, COMPEL 25 (2006) 71.

Legend: u field, y flux density or magnetization, L the Langevin function, P_k the play of half-width k, m the mean
magnetization over saturation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, falling, input_span, offset, output_span, steepness
from hysteresis_plugins.models._plays import at_least

TALLEST = 10.0
"""Largest saturation in the box, in ranges of the output."""


@dataclass(frozen=True)
class EnergyBased(Model):
    """Energy-based hysteresis: a sum of Langevin curves of play operators, with mean field.

    y = slope u + M_s m, m = reversible L(h/a) + (1 - reversible) * mean over cells of L(P_k[h]/a),
    h = u + 3 a coupling m [1, 2]. The pinning k of the cells is log-normal, of median pinning and width spread in ln k.
    Rate-independent, and passive: energy is stored in the curves and lost by the plays. Runs anticlockwise only.
    Linear in slope and M_s.

    cells : that are pinned, one a quantile, 1 to 60

    Ours: the mean field is told by its coupling, alpha M_s / 3a of the literature, below 1, where the anhysteretic
    curve would stand upright; the density of the pinning has two parameters; the first sample lies on the anhysteretic
    curve. Eddy currents have no room inside.
    """

    parameters = (
        Parameter("a", 0.01, 2.0, "{input}", "log", meaning="form factor of the anhysteretic curve", positive=True),
        Parameter("coupling", 0.0, 0.98, meaning="mean field over what makes the curve upright"),
        Parameter("pinning", 1e-3, 0.5, "{input}", "log", meaning="median of the cells'", positive=True),
        Parameter("spread", 0.02, 2.0, scaling="log", meaning="width of their density, in ln k", positive=True),
        Parameter("reversible", 0.0, 0.95, meaning="share that is not pinned"),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the part that does not saturate"),
        Parameter("M_s", 0.0, 5.0, "{output}", meaning="saturation"),
    )
    linear = ("slope", "M_s")
    properties = ("rate-independent", "odd", "return-point")
    senses = (1,)
    example = Example(
        4.0,
        {
            "a": 0.8,
            "coupling": 0.5,
            "pinning": 0.6,
            "spread": 0.4,
            "reversible": 0.2,
            "slope": 0.05,
            "M_s": 1.5,
        },
        stream=14,
    )

    cells: int = 10

    def __post_init__(self) -> None:
        at_least("cells", self.cells, 1, 60)

    @cached_property
    def _quantiles(self) -> Array:
        """Of the standard normal density, in the middle of equal shares, (cells,)."""
        from scipy.special import ndtri

        return np.asarray(ndtri((np.arange(self.cells) + 0.5) / self.cells))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.energy_based import energy_based

        pinned = p.pinning * np.exp(p.spread * self._quantiles[:, None])
        pinning = np.concatenate([np.zeros((1, p.a.size)), pinned])
        shares = np.empty(pinning.shape)
        shares[0], shares[1:] = p.reversible, (1.0 - p.reversible) / self.cells
        magnetized = energy_based(signal.input, p.a, p.coupling, pinning, shares)
        magnetized *= p.M_s
        magnetized += p.slope * signal.input
        return magnetized

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The form factor from two thousandths of the span of the input to twice of it, the pinning from a thousandth
        to half of it; the saturation up to ten times the range of the output."""
        a, coupling, pinning, spread, reversible, slope, saturation = self.parameters
        span, most = input_span(records), STEEPEST * steepness(records)
        return (
            a.within(2e-3 * span, 2.0 * span),
            coupling,
            pinning.within(1e-3 * span, 0.5 * span),
            spread,
            reversible,
            slope.within(-most, most),
            saturation.within(0.0, TALLEST * output_span(records)),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return falling(records, "this law's rises") or offset(records)
