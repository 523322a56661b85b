"""Known truth for the PEA paper: the published Hammerstein model itself, measured without noise."""

from __future__ import annotations

from collections import namedtuple
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Rig
from hysteresis_bench.signals import Dataset, Record
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.models.hammerstein import Hammerstein
from hysteresis_plugins.rigs.pea import PeaRig

Truth = namedtuple("Truth", ["alpha", "beta", "gamma", "d", "b", "c_over_m", "k_over_m"])
PUBLISHED = Truth(0.304225, 0.675313, 0.497724, 1.045814, 267_700.0, 510.1069, 255_700.0)
"""[PEA] Tables 2 and 3, the G-Pmix columns."""


@dataclass(frozen=True)
class PeaKnownTruth(Rig):
    """The PEA paper's identified model as if it were the actuator: tells whether a search recovers known parameters.

    noise : um, standard deviation of what is added to the displacement

    Ours, and unlike every other rig: this one is the model under test, so a perfect fit exists. It says what a
    search is worth, and nothing about actuators.

    [PEA] the PEA paper: particle swarm genetic hybrid, Hammerstein model
    """

    experiments: ClassVar[dict[str, str]] = {
        "static-sine": "3 periods of 0.5 Hz, 2.5 V, 6000 samples; the Bouc-Wen section alone",
        "sweep": "0.1 to 50 Hz within 10 s, 2.5 V, 20 000 samples; both sections",
    }

    noise: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.noise < np.inf:
            raise ValueError(f"noise must not be negative, not {self.noise}.")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record, named after the experiment: voltage in V, displacement in um.

        Raises ValueError for an unknown experiment.
        """
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        time, voltage = PeaRig().drive(experiment)
        bare = Record(time, voltage, None, experiment, {"time": "s", "input": "V", "output": "um"})
        model = BoucWen() if experiment == "static-sine" else Hammerstein()
        output = model.simulate(bare.signal, Truth(*np.array(PUBLISHED)[:, None]))[:, 0]
        output = output + self.noise * rng.standard_normal(output.size)
        return Dataset((Record(time, voltage, output, experiment, bare.units),), hidden=self.hidden)

    @property
    def hidden(self) -> dict[str, Any]:
        """The parameters, and the noise where there is some."""
        found: dict[str, Any] = {"parameters": PUBLISHED._asdict()}
        return found | ({"noise": {"output": self.noise}} if self.noise > 0.0 else {})
