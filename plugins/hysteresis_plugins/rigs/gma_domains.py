"""A magnetostrictive actuator of another physics: domains that turn and jump, not plays under a sigmoid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Range
from hysteresis_plugins.rigs._gma_bench import BENCH_RANGES, GmaBench

TEXTURE = 0.5
"""rad; grains lie within this of the rod's axis, either side: ours, a directionally solidified rod."""
GRAINS = 24
LEVELS = (-1.28, -0.67, -0.31, 0.0, 0.31, 0.67, 1.28)
"""Of the logarithm of the preload, in standard deviations: sevenths of a normal distribution."""


@dataclass(frozen=True)
class GmaDomainsRig(GmaBench):
    """Giant magnetostrictive actuator whose domains turn, and jump between easy directions under load and field.

    Every grain has four easy directions in a plane with the rod's axis; the preload makes those across the rod the
    better ones, and the field those along it. A domain stays in its minimum until that vanishes, then it jumps, as
    in the models of Stoner and Wohlfarth [SW] and of Jiles and Thoelke [JT]. The strain follows the directions of
    the domains, not the magnetization: there is no play, no relay density and no sigmoid, and half of the stroke is
    jumps. Drive, bias, mechanics and sensor are those of `GmaBench`. Eddy currents are a first-order lag of the field.

    The cubic anisotropy and the preload are ours, so that the loop is as wide as measured ones of a preloaded rod.

    cubic : anisotropy field, A/m;  preload : anisotropy field of the compression, A/m;  spread : of its logarithm
    field_lag : s

    [SW] Stoner and Wohlfarth, Phil. Trans. R. Soc. A 240 (1948) 599
    [JT] Jiles and Thoelke, J. Magn. Magn. Mater. 134 (1994) 143: domains in highly magnetostrictive rods
    """

    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType(
        BENCH_RANGES
        | {
            "cubic": Range(34e3, 46e3, "A/m; composition and temperature"),
            "preload": Range(42e3, 58e3, "A/m; the spring is set by hand"),
            "spread": Range(0.4, 0.6, "of grains, by maker"),
            "field_lag": Range(1e-4, 3e-4, "s; eddy currents in a rod of 10 mm"),
        }
    )

    cubic: float = 40e3
    preload: float = 50e3
    spread: float = 0.5
    field_lag: float = 2e-4

    def __post_init__(self) -> None:
        super().__post_init__()
        if min(self.cubic, self.preload) <= 0.0 or self.spread < 0.0 or self.field_lag < 0.0:
            raise ValueError("cubic and preload must be above 0, spread and field_lag at least 0")

    @property
    def truths(self) -> Mapping[str, Any]:
        return {"magnetization": "domains that turn and jump", "field_lag": self.field_lag}

    def rod_strain(self, time: Array, surface: Array) -> Array:
        """By how much the domains lie along the rod, against the demagnetized rod."""
        from hysteresis_bench.kernels.lag import lag
        from hysteresis_plugins.rigs._gma_domains import directions

        field = lag(time, surface[:, None], np.array([self.field_lag]))[:, 0] if self.field_lag > 0.0 else surface
        grains = TEXTURE * (2.0 * (np.arange(GRAINS) + 0.5) / GRAINS - 1.0)
        easy, levels = (each.ravel() for each in np.meshgrid(grains, np.array(LEVELS)))
        stress = self.preload * np.exp(self.spread * levels)
        along = np.cos(directions(np.concatenate([[0.0], field]), easy, self.cubic, stress)) ** 2
        strain: Array = 1.5 * self.striction * (along[1:] - along[0]).mean(axis=1)
        return strain
