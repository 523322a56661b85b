"""A bolted joint: many small contacts that stick, and slip at forces of their own.

[1] W. D. Iwan, A distributed-element model for hysteresis and its steady-state dynamic response, Journal of Applied
    Mechanics 33 (1966) 893-900.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Rig
from hysteresis_bench.signals import Dataset, Record

SAMPLES, DURATION = 2000, 4.0
"""Of every record; s."""


@dataclass(frozen=True)
class Example(Rig):
    """A bolted joint, displacement in mm to force in N: contacts in parallel, each of which slips at its own force [1].

    contacts : their number
    stiffness : of all contacts while they stick, N/mm
    strength : force at which the last contact slips, N; the others are spread evenly below it
    noise : standard deviation of the force sensor, N
    """

    experiments: ClassVar[dict[str, str]] = {
        "growing": "4 cycles at 1 Hz that grow to 0.5 mm",
        "nested": "minor loops of 2.5 Hz in major ones of 0.5 Hz, 0.5 mm",
    }

    contacts: int = 40
    stiffness: float = 1000.0
    strength: float = 200.0
    noise: float = 0.5

    def __post_init__(self) -> None:
        if self.contacts < 1 or min(self.stiffness, self.strength) <= 0.0 or self.noise < 0.0:
            raise ValueError("contacts, stiffness and strength must be above 0, noise at least 0.")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record, named after the experiment. Raises ValueError for an unknown one."""
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        time = np.arange(SAMPLES) * (DURATION / SAMPLES)
        if experiment == "growing":
            displacement = 0.5 * time / DURATION * np.sin(2.0 * np.pi * time)
        else:
            displacement = 0.35 * np.sin(np.pi * time) + 0.15 * np.sin(5.0 * np.pi * time)
        force = self.force(displacement) + self.noise * rng.standard_normal(SAMPLES)
        units = {"time": "s", "input": "mm", "output": "N"}
        return Dataset((Record(time, displacement, force, experiment, units),), hidden=self.hidden)

    def force(self, displacement: Array) -> Array:
        """The true force in N from rest; displacement : (samples,) mm"""
        slips = self.strength * np.arange(1, self.contacts + 1) / self.contacts**2
        held = np.zeros(self.contacts)
        total = np.zeros(displacement.size)
        for k, moved in enumerate(np.diff(displacement), start=1):
            held = np.clip(held + self.stiffness / self.contacts * moved, -slips, slips)
            total[k] = held.sum()
        return total

    @property
    def hidden(self) -> dict[str, Any]:
        """What is in the data beside the hysteresis."""
        return {"noise": self.noise}
