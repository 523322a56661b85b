"""Models that break one promise each."""

from dataclasses import dataclass, field

import numpy as np

from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter


class Gain(Model):
    """y = a u; the others change one thing in it."""

    parameters = (Parameter("a", 0.1, 10.0, "{output}/{input}", meaning="gain"),)

    def simulate(self, signal, p):
        return p.a * signal.input


@dataclass(frozen=True)
class NotFinite(Gain):
    """Has a pole in its box."""

    def simulate(self, signal, p):
        return np.where(p.a > 9.0, np.nan, p.a) * signal.input


@dataclass(frozen=True)
class Corner(Gain):
    """Is infinite at one corner of its box."""

    def simulate(self, signal, p):
        with np.errstate(divide="ignore", invalid="ignore"):
            return signal.input / (p.a - 0.1) * 0.0 + p.a * signal.input


@dataclass(frozen=True)
class Overwrites(Gain):
    """Works in place on its input."""

    def simulate(self, signal, p):
        signal.input.setflags(write=True)
        signal.input[0] = 0.0
        return p.a * signal.input


@dataclass(frozen=True)
class Turned(Gain):
    """Answers (swarm, samples)."""

    def simulate(self, signal, p):
        return (p.a * signal.input).T


@dataclass(frozen=True)
class Single(Gain):
    """Answers single precision."""

    def simulate(self, signal, p):
        return (p.a * signal.input).astype(np.float32)


@dataclass(frozen=True)
class Coupled(Gain):
    """Looks at the whole swarm."""

    def simulate(self, signal, p):
        return p.a / np.max(p.a) * signal.input


@dataclass(frozen=True)
class Remembers(Gain):
    """Answers more every time."""

    calls: list = field(default_factory=list)

    def simulate(self, signal, p):
        self.calls.append(1)
        return p.a * signal.input + len(self.calls)


@dataclass(frozen=True)
class Unmeant(Gain):
    """Does not say what its parameter is."""

    parameters = (Parameter("a", 0.1, 10.0, "{output}/{input}"),)


@dataclass(frozen=True)
class OddUnit(Gain):
    """Has a unit that cannot be filled in."""

    parameters = (Parameter("a", 0.1, 10.0, "{force}/{input}", meaning="gain"),)


@dataclass(frozen=True)
class NoRoom(Gain):
    """Gives a record whose input never moves a box without room."""

    def box(self, records):
        return (self.parameters[0].within(0.0, max(float(np.ptp(record.input)) for record in records)),)


@dataclass(frozen=True)
class NotLinear(Gain):
    """Calls a parameter linear that is squared."""

    linear = ("a",)

    def simulate(self, signal, p):
        return p.a**2 * signal.input


@dataclass(frozen=True)
class Parameterless(Model):
    """Declares no parameters."""

    def simulate(self, signal, p):
        return 1.0 * signal.input
