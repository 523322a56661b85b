"""The magnetostrictive model itself as a test bench: the truth is known to the last digit."""

from __future__ import annotations

from collections import namedtuple
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Rig
from hysteresis_bench.signals import Dataset, Record, Signal
from hysteresis_plugins.models.free_energy_gma import REDUCED, FreeEnergyGma
from hysteresis_plugins.rigs._gma_bench import SINES

TRUTH = {**REDUCED, "M_R": 4.7e5, "eta": 1.3, "H_c": 2.4e3, "b": 3.7e4, "c": 0.5}
"""Ours: round numbers close to what fits the `gma` rig."""


@dataclass(frozen=True)
class GmaKnownTruth(Rig):
    """Model free-energy-gma with known parameters, measured without error: shows which searches find the truth.

    Departs from the contract on purpose: a rig should not be the model under test. On this one a good fit
    proves nothing about an actuator; what it tells is whether the parameters that fit are the true ones. They
    are in `hidden`, under "parameters". Experiments, bias and sampling are those of `gma`.

    amplitude : of the current, A;  bias_field : A/m
    samples_per_period, periods : of every record
    noise : rms of the displacement sensor, um
    """

    experiments: ClassVar[dict[str, str]] = {name: f"sine current at {f:g} Hz from rest" for name, f in SINES.items()}

    amplitude: float = 2.5
    bias_field: float = 40e3
    samples_per_period: int = 500
    periods: int = 2
    noise: float = 0.0

    def __post_init__(self) -> None:
        if self.amplitude <= 0.0 or self.noise < 0.0:
            raise ValueError("amplitude must be above 0, noise at least 0")
        if self.samples_per_period < 8 or self.periods < 1:
            raise ValueError("samples_per_period must be at least 8 and periods at least 1")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record of the experiment's name. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f"no experiment {experiment!r}; there are: {', '.join(self.experiments)}")
        phase = np.arange(self.periods * self.samples_per_period) / self.samples_per_period
        time, current = phase / SINES[experiment], self.amplitude * np.sin(2 * np.pi * phase)
        columns = {"bias_field": np.full(time.size, self.bias_field)}
        model = FreeEnergyGma()
        truth = namedtuple("Truth", list(TRUTH))(*(np.array([value]) for value in TRUTH.values()))
        displacement = model.simulate(Signal(time, current[:, None], columns=columns), truth)[:, 0]
        measured = displacement + self.noise * rng.standard_normal(time.size)
        units = {"time": "s", "input": "A", "output": "um", "bias_field": "A/m"}
        record = Record(time, current, measured, experiment, units, columns)
        return Dataset((record,), hidden={"parameters": TRUTH, "noise": self.noise})
