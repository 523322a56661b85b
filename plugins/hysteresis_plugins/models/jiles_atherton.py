"""Jiles-Atherton, as printed in the SMA paper, equations (1) to (12)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, Example, Model, Property
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import falling, largest_output
from hysteresis_plugins.models._eddy_current import OFFERS, with_eddy_current

FIELD_PER_MAGNETIZATION = "{input} mu0/{output}"
"""Unit of H over unit of M: mu0 M is in the unit of the output, as a number."""

SATURATES = 0.5
"""Average slope at an end of the input range over the slope in its middle, below which it counts as flat."""
OFF_CENTRE = 0.25
"""Distance of the input's centre from 0 in spans beyond which a loop about 0 cannot follow."""


@dataclass(frozen=True)
class JilesAtherton(Model):
    """Jiles-Atherton hysteresis as the SMA paper prints it, equations (1) to (12).

    The output is B = mu0 (H + M), mu0 = 4e-7 pi as a number whatever the units: H is the input in
    {input}, B the output in {output}. The default box is the paper's Table 1, linear. In most of that
    box c alpha M_s > 3 a or alpha M_s > k: M has several branches or (5) a pole; there the simulation is
    finite and follows the branch from the sample before. Equation (5) has no clamp on reversal:
    while (M_an - M_irr) delta < 0 the irreversible susceptibility is negative.
    """

    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("alpha", 1e-14, 1e-2, FIELD_PER_MAGNETIZATION, meaning="interaction between domains"),
        Parameter("a", 1e-2, 1e4, "{input}", meaning="form factor of the anhysteretic curve"),
        Parameter("k", 1e-2, 1e4, "{input}", meaning="hysteresis loss, pinning"),
        Parameter("M_s", 1e5, 3e7, "{output}/mu0", meaning="saturation magnetization"),
        Parameter("c", 1e-2, 3.0, "1", meaning="reversibility of wall motion"),
    )
    offers: ClassVar[Mapping[str, Effect]] = OFFERS
    properties: ClassVar[tuple[Property, ...]] = ("rate-independent", "odd")
    # with these values the law falls right after a reversal, where eddy currents have no solution
    example = Example(
        5000.0,
        {"alpha": 3e-4, "a": 1100.0, "k": 900.0, "M_s": 1.3e6, "c": 0.2},
        stream=2,
        without=("eddy-current",),
    )
    clamped: ClassVar[bool] = False

    def simulate(self, signal: Signal, p: Any) -> Array:
        return with_eddy_current(self._plain, self._dragged, signal, p)

    def _plain(self, H: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.jiles_atherton import jiles_atherton

        return jiles_atherton(H, p.alpha, p.a, p.k, p.M_s, p.c, self.clamped)

    def _dragged(self, time: Array, H: Array, coefficient: Array, p: Any) -> Array:
        from hysteresis_bench.kernels.eddy_jiles_atherton import eddy_jiles_atherton

        return eddy_jiles_atherton(time, H, coefficient, p.alpha, p.a, p.k, p.M_s, p.c, self.clamped)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Log-scaled, from the largest |input| and |output|, or the output's span where that is less; c is held to its
        physical range, up to 1.

        alpha M_s, the field of the magnetization itself, reaches the applied field at the largest M.
        """
        H = max(float(np.max(np.abs(record.input))) for record in records) or 1.0
        M = largest_output(records) / (4e-7 * np.pi) or 1.0
        bounds = {
            "alpha": (1e-4 * H / M, H / M),
            "a": (1e-2 * H, 1e1 * H),
            "k": (1e-3 * H, 1e1 * H),
            "M_s": (0.5 * M, 2e1 * M),
            "c": (1e-2, 1.0),
        }
        return tuple(p.within(*bounds[p.name], scaling="log") for p in self.parameters)

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        u = np.concatenate([record.input[record.scored] for record in records])
        y = np.concatenate([record.measured for record in records])
        found = [*falling(records, "Jiles-Atherton only rises")]
        if 0.0 < np.ptp(y) < 4e-7 * np.pi * np.ptp(u):
            found.append(
                "The output, mu0 (H + M), moves by less than mu0 H alone, 1.26e-6 of the input as a number. Give it "
                "in a smaller unit, or the input in a larger one."
            )
        low, span = u.min(), np.ptp(u)
        if span > 0.0 and abs(low + span / 2) > OFF_CENTRE * span and self._saturates(u, y):
            found.append(
                f"The output levels off at both ends, but the input's centre {low + span / 2:.4g} is far from 0, "
                "where Jiles-Atherton has its own centre. Use --input-offset."
            )
        return tuple(found)

    @staticmethod
    def _saturates(u: Array, y: Array) -> bool:
        """Does the mean output over the input range flatten at both ends?"""
        fifth = np.minimum((5 * (u - u.min()) / np.ptp(u)).astype(int), 4)
        if np.unique(fifth).size < 5:
            return False
        level = np.array([y[fifth == i].mean() for i in range(5)])
        rise = np.abs(np.diff(level))
        return bool(max(rise[0], rise[3]) < SATURATES * (rise[1] + rise[2]) / 2)
