"""What magnetostrictive rigs share: coil, bias, drive, experiments, mechanics and sensor of the GMA paper's bench."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig, Range
from hysteresis_bench.signals import Dataset, Record

PRINTED = {"turns": 14400.0, "area": 7.85e-5, "mass": 0.5, "damping": 4.325e3, "stiffness": 3.375e7}
"""Coil turns a metre, rod's cross-section in m^2, kg, N s/m, N/m: the GMA paper, section IV.B."""
MODULUS = 30e9
"""Pa; Terfenol-D has 25 to 35 GPa (Engdahl, Handbook of Giant Magnetostrictive Materials, 2000)."""
STRICTION = 1.0e-3
"""Saturation magnetostriction of Terfenol-D: Dapino, Smith, Flatau, IEEE Trans. Magnetics 36 (2000) 545."""
RIPPLE_FREQUENCY = 300.0
"""Hz; a six-pulse rectifier on 50 Hz mains, ours."""

SINES = {f"sine-{f}hz": float(f) for f in (1, 10, 50, 100, 200)}
NESTED = (1.0, 0.8, 0.6, 0.4, 0.2)
"""Amplitudes of the nested loops, as shares of the largest, a period each."""

BENCH_RANGES = {
    "amplitude": Range(2.2, 2.8, "A; the drive: the paper prints none"),
    "bias_field": Range(34e3, 46e3, "A/m; magnets within a seventh"),
    "striction": Range(0.85e-3, 1.15e-3, "by preload and texture"),
    "modulus": Range(25e9, 35e9, "Pa; Terfenol-D has 25 to 35 GPa"),
    "damping": Range(3.7e3, 5.0e3, "N s/m; within a seventh of what is printed"),
    "ripple": Range(0.01, 0.03, "A; the drive's rectifier"),
    "noise": Range(0.03, 0.07, "um; displacement sensors"),
}


@dataclass(frozen=True)
class GmaBench(DrivenRig):
    """Commanded current in A to displacement in micrometres; how the rod's strain follows its field is the rig's own.

    The rod is demagnetized, the bias applied, and the current started from 0. Displacement is counted
    from the demagnetized rod. The bias is no secret: it is the column "bias_field" of every record. The
    input is the commanded current; the ripple is hidden in it.

    amplitude : of the current, A, ours;  bias_field : of the permanent magnets, A/m, ours
    samples_per_period, periods : of every record; the nested loops have five periods
    striction : of saturation;  modulus : Pa;  damping : N s/m, printed
    ripple : amplitude of the current ripple, A, ours;  noise : rms of the displacement sensor, um, ours
    """

    units: ClassVar[Mapping[str, str]] = MappingProxyType({"time": "s", "input": "A", "output": "um"})
    experiments: ClassVar[dict[str, str]] = {
        **{name: f"sine current at {f:g} Hz from rest" for name, f in SINES.items()},
        "nested-loops": "sine current at 1 Hz whose amplitude falls by a fifth every period",
    }

    amplitude: float = 2.5
    bias_field: float = 40e3
    samples_per_period: int = 500
    periods: int = 2
    striction: float = STRICTION
    modulus: float = MODULUS
    damping: float = PRINTED["damping"]
    ripple: float = 0.02
    noise: float = 0.05

    def __post_init__(self) -> None:
        if self.amplitude <= 0.0 or self.ripple < 0.0 or self.noise < 0.0:
            raise ValueError("amplitude must be above 0, ripple and noise at least 0")
        if min(self.striction, self.modulus, self.damping) <= 0.0:
            raise ValueError("striction, modulus and damping must be above 0")
        if self.samples_per_period < 8 or self.periods < 1:
            raise ValueError("samples_per_period must be at least 8 and periods at least 1")

    @abstractmethod
    def rod_strain(self, time: Array, surface: Array) -> Array:
        """(samples,): of the whole rod; time in s, evenly spaced, surface : field of the coil and the bias, A/m"""

    @property
    @abstractmethod
    def truths(self) -> Mapping[str, Any]:
        """What the rod hides, by name."""

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record of the experiment's name. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f"gma has no experiment {experiment!r}; there are: {', '.join(self.experiments)}")
        frequency = SINES.get(experiment, 1.0)
        shares = np.ones(self.periods) if experiment in SINES else np.array(NESTED)
        rate = frequency * self.samples_per_period
        time, finer = _fine_grid(shares.size * self.samples_per_period, rate)
        share = shares[np.arange(time.size) // (self.samples_per_period * finer)]
        commanded = self.amplitude * share * np.sin(2 * np.pi * frequency * time)
        return self._measured(experiment, time, commanded, finer, rng)

    def play(self, drive: Record, rng: Generator) -> Dataset:
        """A record of the drive's name; the supply has no limit."""
        time, finer = _fine_grid(drive.time.size, 1.0 / float(drive.time[1] - drive.time[0]))
        return self._measured(drive.name, time, np.interp(time, drive.time, drive.input), finer, rng)

    def _measured(self, name: str, time: Array, commanded: Array, finer: int, rng: Generator) -> Dataset:
        phase = 2 * np.pi * rng.random()
        current = commanded + self.ripple * np.sin(2 * np.pi * RIPPLE_FREQUENCY * time + phase)
        displacement = self.displacement(time, current)[::finer]
        measured = displacement + self.noise * rng.standard_normal(displacement.size)
        record = Record(
            time[::finer],
            commanded[::finer],
            measured,
            name,
            {**self.units, "bias_field": "A/m"},
            {"bias_field": np.full(displacement.size, self.bias_field)},
        )
        hidden = {**self.truths, "ripple": self.ripple, "noise": self.noise}
        return Dataset((record,), hidden=hidden)

    def displacement(self, time: Array, current: Array) -> Array:
        """What the rod's end does, um, without sensor noise; time in s, evenly spaced, current in A."""
        from hysteresis_bench.kernels.second_order import second_order

        strain = self.rod_strain(time, PRINTED["turns"] * current + self.bias_field)
        deflection = PRINTED["area"] * self.modulus / PRINTED["stiffness"] * strain[:, None]
        rate, spring = self.damping / PRINTED["mass"], PRINTED["stiffness"] / PRINTED["mass"]
        return 1e6 * second_order(time, deflection, np.array([rate]), np.array([spring]))[:, 0]


def _fine_grid(samples: int, rate: float) -> tuple[Array, int]:
    """Time in s, so many times as fine as the samples: the ripple wants twelve steps a period, the diffusion four a
    sample."""
    finer = max(4, int(np.ceil(12 * RIPPLE_FREQUENCY / rate)))
    return np.arange((samples - 1) * finer + 1) / (rate * finer), finer
