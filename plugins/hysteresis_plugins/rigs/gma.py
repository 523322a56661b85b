"""The giant magnetostrictive actuator on its test bench."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Range, Rig
from hysteresis_bench.signals import Dataset, Record

if TYPE_CHECKING:
    from hysteresis_plugins.rigs._gma_rod import Material

PRINTED = {"turns": 14400.0, "area": 7.85e-5, "mass": 0.5, "damping": 4.325e3, "stiffness": 3.375e7}
"""Coil turns a metre, rod's cross-section in m^2, kg, N s/m, N/m: the GMA paper, section IV.B."""
RADIUS = 5e-3
"""m; the rod is 10 mm by 90 mm, same section."""
MODULUS = 30e9
"""Pa; Terfenol-D has 25 to 35 GPa (Engdahl, Handbook of Giant Magnetostrictive Materials, 2000)."""
RESISTIVITY = 6e-7
"""Ohm m; Terfenol-D, same handbook."""
SATURATION = 7.65e5
"""A/m; Terfenol-D, Dapino, Smith, Flatau, IEEE Trans. Magnetics 36 (2000) 545."""
STRICTION = 1.0e-3
"""Saturation magnetostriction of Terfenol-D, same paper."""
COERCIVE = 5e3
"""A/m, mean of the relays; ours: with it and `softness` the relative permeability is about 12."""
QUARTIC = -0.3
"""Share of the fourth power in the strain, ours: rotation of domains that are nearly aligned strains less."""
RIPPLE_FREQUENCY = 300.0
"""Hz; a six-pulse rectifier on 50 Hz mains, ours."""
SHELLS = 12
CLASSES = 60
"""Of coercive field."""

SINES = {f"sine-{f}hz": float(f) for f in (1, 10, 50, 100, 200)}
NESTED = (1.0, 0.8, 0.6, 0.4, 0.2)
"""Amplitudes of the nested loops, as shares of the largest, a period each."""


@dataclass(frozen=True)
class GmaRig(Rig):
    """Giant magnetostrictive actuator: commanded current in A to displacement in micrometres.

    Not the free-energy model: a Preisach magnetization of its own (coercive fields gamma distributed,
    interaction fields logistic and wider in harder material, a reversible part that saturates), strain that
    bends off the quadratic law, eddy currents as diffusion of the field into the rod, the printed mass,
    damping and stiffness.

    The rod is demagnetized, the bias applied, and the current started from 0. Displacement is counted
    from the demagnetized rod. The bias is no secret: it is the column "bias_field" of every record. The
    input is the commanded current; the ripple is hidden in it.

    The paper prints coil, rod, mass, damping and stiffness; the material is Terfenol-D of the literature, its
    coercive fields are ours. It is near the free-energy model: both add up plays under a density of coercive and
    interaction fields. `ranges` says how far each constant differs from one actuator to the next.

    amplitude : of the current, A, ours
    bias_field : of the permanent magnets, A/m, ours
    samples_per_period, periods : of every record; the nested loops have five periods
    eddy_currents : without them the field is the same all over the rod
    coercive_field : mean of the relays, A/m, ours;  reversible : share of the magnetization;  softness : of it, A/m
    striction : of saturation;  modulus : Pa;  resistivity : ohm m;  damping : N s/m, printed
    strain_saturation : without it the strain is quadratic in the magnetization
    ripple : amplitude of the current ripple, A, ours;  noise : rms of the displacement sensor, um, ours
    """

    experiments: ClassVar[dict[str, str]] = {
        **{name: f"sine current at {f:g} Hz from rest" for name, f in SINES.items()},
        "nested-loops": "sine current at 1 Hz whose amplitude falls by a fifth every period",
    }

    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType(
        {
            "amplitude": Range(2.2, 2.8, "A; the drive: the paper prints none"),
            "bias_field": Range(34e3, 46e3, "A/m; magnets within a seventh"),
            "coercive_field": Range(3.5e3, 6.5e3, "A/m; Terfenol-D by maker and heat treatment"),
            "reversible": Range(0.2, 0.4, "share; rotation of domains against wall motion, by texture and preload"),
            "softness": Range(100e3, 140e3, "A/m; as the share"),
            "striction": Range(0.85e-3, 1.15e-3, "by preload and texture"),
            "modulus": Range(25e9, 35e9, "Pa; Terfenol-D has 25 to 35 GPa"),
            "resistivity": Range(5.5e-7, 6.5e-7, "ohm m; Terfenol-D, by temperature"),
            "damping": Range(3.7e3, 5.0e3, "N s/m; within a seventh of what is printed"),
            "ripple": Range(0.01, 0.03, "A; the drive's rectifier"),
            "noise": Range(0.03, 0.07, "um; displacement sensors"),
        }
    )

    amplitude: float = 2.5
    bias_field: float = 40e3
    samples_per_period: int = 500
    periods: int = 2
    coercive_field: float = COERCIVE
    reversible: float = 0.3
    softness: float = 120e3
    striction: float = STRICTION
    modulus: float = MODULUS
    resistivity: float = RESISTIVITY
    damping: float = PRINTED["damping"]
    eddy_currents: bool = True
    strain_saturation: bool = True
    ripple: float = 0.02
    noise: float = 0.05

    def __post_init__(self) -> None:
        if self.amplitude <= 0.0 or self.ripple < 0.0 or self.noise < 0.0:
            raise ValueError("amplitude must be above 0, ripple and noise at least 0")
        if min(self.coercive_field, self.softness, self.striction, self.modulus, self.resistivity, self.damping) <= 0.0:
            raise ValueError("coercive_field, softness, striction, modulus, resistivity and damping must be above 0")
        if not 0.0 <= self.reversible < 1.0:
            raise ValueError("reversible is a share, at least 0 and below 1")
        if self.samples_per_period < 8 or self.periods < 1:
            raise ValueError("samples_per_period must be at least 8 and periods at least 1")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record of the experiment's name. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f"gma has no experiment {experiment!r}; there are: {', '.join(self.experiments)}")
        frequency = SINES.get(experiment, 1.0)
        shares = np.ones(self.periods) if experiment in SINES else np.array(NESTED)
        rate = frequency * self.samples_per_period
        # the ripple wants twelve steps a period, the diffusion four a sample
        finer = max(4, int(np.ceil(12 * RIPPLE_FREQUENCY / rate)))
        steps = np.arange((shares.size * self.samples_per_period - 1) * finer + 1)
        time = steps / (rate * finer)
        share = shares[steps // (self.samples_per_period * finer)]
        commanded = self.amplitude * share * np.sin(2 * np.pi * frequency * time)
        phase = 2 * np.pi * rng.random()
        current = commanded + self.ripple * np.sin(2 * np.pi * RIPPLE_FREQUENCY * time + phase)
        displacement = self.displacement(time, current)[::finer]
        measured = displacement + self.noise * rng.standard_normal(displacement.size)
        record = Record(
            time[::finer],
            commanded[::finer],
            measured,
            experiment,
            {"time": "s", "input": "A", "output": "um", "bias_field": "A/m"},
            {"bias_field": np.full(displacement.size, self.bias_field)},
        )
        hidden = {
            "magnetization": "Preisach, gamma and logistic densities",
            "eddy_currents": self.eddy_currents,
            "strain_saturation": self.strain_saturation,
            "ripple": self.ripple,
            "noise": self.noise,
        }
        return Dataset((record,), hidden=hidden)

    def displacement(self, time: Array, current: Array) -> Array:
        """What the rod's end does, um, without sensor noise; time in s, evenly spaced, current in A."""
        from hysteresis_bench.kernels.second_order import second_order
        from hysteresis_plugins.rigs._gma_rod import diffused, uniform

        surface = PRINTED["turns"] * current + self.bias_field
        if self.eddy_currents:
            step = float(time[1] - time[0])
            _, magnetization = diffused(surface, step, RADIUS, SHELLS, self.resistivity, self.material)
            volumes = np.arange(SHELLS) + 0.5
        else:
            _, magnetization = uniform(surface, self.material)
            volumes = np.ones(1)
        strain = self.strain(magnetization / SATURATION) @ (volumes / volumes.sum())
        deflection = PRINTED["area"] * self.modulus / PRINTED["stiffness"] * strain[:, None]
        rate, spring = self.damping / PRINTED["mass"], PRINTED["stiffness"] / PRINTED["mass"]
        return 1e6 * second_order(time, deflection, np.array([rate]), np.array([spring]))[:, 0]

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
