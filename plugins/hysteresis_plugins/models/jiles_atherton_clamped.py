"""Jiles-Atherton with the usual correction on reversal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from hysteresis_bench.contracts import Example
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.models.jiles_atherton import JilesAtherton


@dataclass(frozen=True)
class JilesAthertonClamped(JilesAtherton):
    """Jiles-Atherton hysteresis with M_irr held on reversal until M_an has come back to it.

    dM_irr/dH = 0 while (M_an - M_irr) delta < 0. Ours: past the pole of (5), where
    alpha (M_an - M_irr) delta > k, M_irr jumps to M_an. Otherwise as `jiles-atherton`. Where c <= 1 a
    closed loop dissipates.
    """

    clamped: ClassVar[bool] = True
    senses: ClassVar[tuple[int, ...]] = (1,)
    example = Example(5000.0, {"alpha": 3e-4, "a": 1100.0, "k": 900.0, "M_s": 1.3e6, "c": 0.2}, stream=3)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """That of `jiles-atherton`, but that alpha is linear and of either sign: a demagnetizing field, of an open or
        gapped magnetic circuit, takes its factor off alpha."""
        alpha, *others = super().box(records)
        return (alpha.within(-alpha.upper, alpha.upper, scaling="linear"), *others)
