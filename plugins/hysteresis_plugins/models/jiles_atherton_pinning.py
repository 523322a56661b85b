"""Jiles-Atherton with pinning that depends on the magnetization."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, Example
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models.jiles_atherton import JilesAtherton
from hysteresis_plugins.models.jiles_atherton_clamped import JilesAthertonClamped


@dataclass(frozen=True)
class JilesAthertonPinning(JilesAtherton):
    """Jiles-Atherton hysteresis, clamped, with pinning that is stronger, or weaker, at small magnetization.

    k (1 + kappa (1 - (M/M_s)²)) in place of k [1]: narrow loops near saturation beside wide ones in the middle, as in
    grain-oriented steel. kappa = 0 is `jiles-atherton-clamped`. No room for eddy currents inside.

    [1] D. C. Jiles, J. B. Thoelke, M. K. Devine, IEEE Trans. Magnetics 28 (1992) 27.
    """

    parameters = (
        *JilesAtherton.parameters,
        Parameter("kappa", -0.9, 20.0, meaning="pinning at M = 0 over that at saturation, less 1"),
    )
    offers: ClassVar[Mapping[str, Effect]] = MappingProxyType({})
    example = Example(5000.0, {"alpha": 3e-4, "a": 1100.0, "k": 600.0, "M_s": 1.3e6, "c": 0.2, "kappa": 1.5}, stream=12)
    clamped: ClassVar[bool] = True
    senses: ClassVar[tuple[int, ...]] = (1,)

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.jiles_atherton_pinning import jiles_atherton_pinning

        return jiles_atherton_pinning(signal.input, p.alpha, p.a, p.k, p.M_s, p.c, p.kappa)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """That of `jiles-atherton-clamped`; kappa as it is."""
        return (*JilesAthertonClamped().box(records), self.parameters[-1])
