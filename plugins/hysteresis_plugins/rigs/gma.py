"""The giant magnetostrictive actuator on its test bench."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Range
from hysteresis_plugins.rigs._gma_bench import BENCH_RANGES, GmaBench

if TYPE_CHECKING:
    from hysteresis_plugins.rigs._gma_rod import Material

RADIUS = 5e-3
"""m; the rod is 10 mm by 90 mm, same section."""
RESISTIVITY = 6e-7
"""Ohm m; Terfenol-D (Engdahl, Handbook of Giant Magnetostrictive Materials, 2000)."""
SATURATION = 7.65e5
"""A/m; Terfenol-D, Dapino, Smith, Flatau, IEEE Trans. Magnetics 36 (2000) 545."""
COERCIVE = 5e3
"""A/m, mean of the relays; ours: with it and `softness` the relative permeability is about 12."""
QUARTIC = -0.3
"""Share of the fourth power in the strain, ours: rotation of domains that are nearly aligned strains less."""
SHELLS = 12
CLASSES = 60
"""Into which the domains are sorted by their coercive field."""


@dataclass(frozen=True)
class GmaRig(GmaBench):
    """Giant magnetostrictive actuator: commanded current in A to displacement in micrometres.

    Not the free-energy model: a Preisach magnetization of its own (coercive fields gamma distributed,
    interaction fields logistic and wider in harder material, a reversible part that saturates), strain that
    bends off the quadratic law, eddy currents as diffusion of the field into the rod, the printed mass,
    damping and stiffness. Drive, bias, mechanics and sensor are those of `GmaBench`.

    The paper prints coil, rod, mass, damping and stiffness; the material is Terfenol-D of the literature, its
    coercive fields are ours. It is near the free-energy model: both add up plays under a density of coercive and
    interaction fields. `ranges` says how far each constant differs from one actuator to the next. The rig
    gma-domains is of another physics.

    coercive_field : mean of the relays, A/m, ours;  reversible : share of the magnetization;  softness : of it, A/m
    resistivity : ohm m;  eddy_currents : without them the field is the same all over the rod
    strain_saturation : without it the strain is quadratic in the magnetization
    """

    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType(
        BENCH_RANGES
        | {
            "coercive_field": Range(3.5e3, 6.5e3, "A/m; Terfenol-D by maker and heat treatment"),
            "reversible": Range(0.2, 0.4, "share; rotation of domains against wall motion, by texture and preload"),
            "softness": Range(100e3, 140e3, "A/m; as the share"),
            "resistivity": Range(5.5e-7, 6.5e-7, "ohm m; Terfenol-D, by temperature"),
        }
    )

    coercive_field: float = COERCIVE
    reversible: float = 0.3
    softness: float = 120e3
    resistivity: float = RESISTIVITY
    eddy_currents: bool = True
    strain_saturation: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        if min(self.coercive_field, self.softness, self.resistivity) <= 0.0:
            raise ValueError("coercive_field, softness and resistivity must be above 0")
        if not 0.0 <= self.reversible < 1.0:
            raise ValueError("reversible is a share, at least 0 and below 1")

    @property
    def truths(self) -> Mapping[str, Any]:
        return {
            "magnetization": "Preisach, gamma and logistic densities",
            "eddy_currents": self.eddy_currents,
            "strain_saturation": self.strain_saturation,
        }

    def rod_strain(self, time: Array, surface: Array) -> Array:
        """Over the rod's section, a shell weighed by its volume."""
        from hysteresis_plugins.rigs._gma_rod import diffused, uniform

        if self.eddy_currents:
            step = float(time[1] - time[0])
            _, magnetization = diffused(surface, step, RADIUS, SHELLS, self.resistivity, self.material)
            volumes = np.arange(SHELLS) + 0.5
        else:
            _, magnetization = uniform(surface, self.material)
            volumes = np.ones(1)
        strain: Array = self.strain(magnetization / SATURATION) @ (volumes / volumes.sum())
        return strain

    def strain(self, relative: Array) -> Array:
        """Magnetostriction at M / M_s: the even series of Jiles, J. Phys. D 28 (1995) 1537, to the fourth power."""
        quartic = QUARTIC if self.strain_saturation else 0.0
        return 1.5 * self.striction * (relative**2 + quartic * relative**4)

    @property
    def material(self) -> Material:
        """Terfenol-D of sorts: coercive fields gamma distributed about their mean."""
        from hysteresis_plugins.rigs._gma_rod import Material

        coercive = self.coercive_field * 5.0 * (np.arange(CLASSES) + 0.5) / CLASSES
        share = coercive * np.exp(-2.0 * coercive / self.coercive_field)  # gamma density of shape 2
        return Material(
            coercive=coercive,
            width=50e3 + coercive,
            share=share / share.sum(),
            saturation=SATURATION,
            reversible=self.reversible,
            softness=self.softness,
        )
