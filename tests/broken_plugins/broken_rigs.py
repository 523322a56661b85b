"""Rigs that break one promise each."""

from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.contracts import Rig
from hysteresis_bench.signals import Dataset, Record

UNITS = {"time": "s", "input": "V", "output": "um"}


class Sine(Rig):
    """A sine; the others change one thing in it."""

    experiments = {"sine": "a sine"}  # noqa: RUF012

    def measure(self, experiment, rng):
        if experiment not in self.experiments:
            raise ValueError(f"no experiment {experiment!r}. Known: sine")
        time = np.linspace(0.0, 1.0, 50)
        record = Record(time, np.sin(6.0 * time), rng.standard_normal(50), experiment, UNITS)
        return Dataset((self.changed(record),))

    def changed(self, record):
        return record


@dataclass(frozen=True)
class Unitless(Sine):
    """Forgets the unit of the output."""

    def changed(self, record):
        return replace(record, units={"time": "s", "input": "V"})


@dataclass(frozen=True)
class Unseeded(Sine):
    """Has noise of its own."""

    def changed(self, record):
        return replace(record, output=np.random.default_rng().standard_normal(50))


@dataclass(frozen=True)
class Backwards(Sine):
    """Its time does not increase."""

    def changed(self, record):
        return replace(record, time=np.round(record.time, 1))


@dataclass(frozen=True)
class Anything(Sine):
    """Measures whatever it is asked."""

    def measure(self, experiment, rng):
        return super().measure("sine", rng)


@dataclass(frozen=True)
class Promises(Sine):
    """Declares more than it can measure."""

    experiments = {"sine": "a sine", "square": "a square"}  # noqa: RUF012

    def changed(self, record):
        if record.name == "square":
            raise NotImplementedError("not yet")
        return record


@dataclass(frozen=True)
class NoExperiments(Rig):
    """Declares no experiment."""

    def measure(self, experiment, rng):
        raise ValueError("nothing can be measured")
