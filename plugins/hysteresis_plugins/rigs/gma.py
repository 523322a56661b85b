"""The giant magnetostrictive actuator on its test bench."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Rig
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

    amplitude : of the current, A, ours
    bias_field : of the permanent magnets, A/m, ours
    samples_per_period, periods : of every record; the nested loops have five periods
    eddy_currents : without them the field is the same all over the rod
    strain_saturation : without it the strain is quadratic in the magnetization
    ripple : amplitude of the current ripple, A, ours;  noise : rms of the displacement sensor, um, ours
    """

    experiments: ClassVar[dict[str, str]] = {
        **{name: f"sine current at {f:g} Hz from rest" for name, f in SINES.items()},
        "nested-loops": "sine current at 1 Hz whose amplitude falls by a fifth every period",
    }

    amplitude: float = 2.5
    bias_field: float = 40e3
    samples_per_period: int = 500
    periods: int = 2
    eddy_currents: bool = True
    strain_saturation: bool = True
    ripple: float = 0.02
    noise: float = 0.05

    def __post_init__(self) -> None:
        if self.amplitude <= 0.0 or self.ripple < 0.0 or self.noise < 0.0:
            raise ValueError("amplitude must be above 0, ripple and noise at least 0")
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
            _, magnetization = diffused(surface, step, RADIUS, SHELLS, RESISTIVITY, material())
            volumes = np.arange(SHELLS) + 0.5
        else:
            _, magnetization = uniform(surface, material())
            volumes = np.ones(1)
        strain = self.strain(magnetization / SATURATION) @ (volumes / volumes.sum())
        deflection = PRINTED["area"] * MODULUS / PRINTED["stiffness"] * strain[:, None]
        rate, spring = PRINTED["damping"] / PRINTED["mass"], PRINTED["stiffness"] / PRINTED["mass"]
        return 1e6 * second_order(time, deflection, np.array([rate]), np.array([spring]))[:, 0]

    def strain(self, relative: Array) -> Array:
        """Magnetostriction at M / M_s: the even series of Jiles, J. Phys. D 28 (1995) 1537, to the fourth power."""
        quartic = QUARTIC if self.strain_saturation else 0.0
        return 1.5 * STRICTION * (relative**2 + quartic * relative**4)


def material() -> Material:
    """Terfenol-D of sorts, ours: coercive fields of 5 kA/m in the mean, relative permeability about 12."""
    from hysteresis_plugins.rigs._gma_rod import Material

    mean = 5e3
    coercive = mean * 5.0 * (np.arange(CLASSES) + 0.5) / CLASSES
    share = coercive * np.exp(-2.0 * coercive / mean)  # gamma density of shape 2
    return Material(
        coercive=coercive,
        width=50e3 + coercive,
        share=share / share.sum(),
        saturation=SATURATION,
        reversible=0.3,
        softness=120e3,
    )
