"""The Jiles-Atherton model itself as a test bench: the truth is known to the last digit."""

from __future__ import annotations

from collections import namedtuple
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.contracts import Rig
from hysteresis_bench.signals import Dataset, Record, Signal
from hysteresis_plugins.models.jiles_atherton import JilesAtherton

TRUTH = {"alpha": 1e-6, "a": 6.0, "k": 10.0, "M_s": 2.5e6, "c": 0.2}
"""Ours: inside the paper's box and well-posed: c alpha M_s / 3a = 0.028, alpha M_s = 2.5 < k."""


@dataclass(frozen=True)
class SmaKnownTruth(Rig):
    """Model jiles-atherton with known parameters, measured without error: shows which searches find the truth.

    Departs from the contract on purpose: a rig should not be the model under test. On this one a good fit
    proves nothing about an actuator; what it tells is whether the parameters that fit are the true ones. They
    are in `hidden`, under "parameters". Temperature as a raised cosine between 0 and 60 degC.
    """

    experiments: ClassVar[dict[str, str]] = {
        "pwm-50s": "2 cycles of 50 s, 10 samples a second",
        "pwm-60s": "2 cycles of 60 s, 10 samples a second",
    }

    highest: float = 60.0  # degC

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record of the experiment's name. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        period = {"pwm-50s": 50.0, "pwm-60s": 60.0}[experiment]
        time = np.arange(round(20 * period)) / 10.0
        temperature = 0.5 * self.highest * (1.0 - np.cos(2.0 * np.pi * time / period))
        truth = namedtuple("Truth", list(TRUTH))(*(np.array([value]) for value in TRUTH.values()))
        angle = JilesAtherton().simulate(Signal(time, temperature[:, None]), truth)[:, 0]
        record = Record(time, temperature, angle, experiment, {"time": "s", "input": "degC", "output": "deg"})
        return Dataset((record,), hidden={"parameters": TRUTH})
