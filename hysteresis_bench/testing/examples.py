"""What plugins are tested with: a record, and small models without hysteresis whose answer is known."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal

QUANTITIES = {"input": "V", "output": "um", "time": "ms"}


def measured(samples: int = 241, uneven: bool = False) -> Record:
    """Two tones and a hold, a temperature that wanders, the output of a cubic with noise. Nothing can be written."""
    rng = np.random.default_rng(5)
    time = np.linspace(0.5, 3.5, samples)
    if uneven:
        time = 0.5 + 3.0 * np.cumsum(rng.uniform(0.2, 1.8, samples)) / samples
    drive = np.where(time < 2.8, np.sin(7.0 * time) + 0.4 * np.sin(16.0 * time), 0.9)
    output = 1.3 * drive + 0.4 * drive**3 + 0.01 * rng.normal(size=samples)
    units = {**QUANTITIES, "temperature": "degC"}
    return locked(Record(time, drive, output, units=units, columns={"temperature": 30.0 + 5.0 * np.sin(1.1 * time)}))


def locked(record: Record) -> Record:
    """A copy of the record whose arrays cannot be written."""
    output = None if record.output is None else lock(record.output.copy())
    columns = {name: lock(column.copy()) for name, column in record.columns.items()}
    return replace(
        record, time=lock(record.time.copy()), input=lock(record.input.copy()), output=output, columns=columns
    )


def lock(values: Array) -> Array:
    """The same array, which cannot be written any more."""
    values.setflags(write=False)
    return values


@dataclass(frozen=True)
class Cubic(Model):
    """y = a u + b u³."""

    parameters = (
        Parameter("a", -2.0, 4.0, "{output}/{input}", meaning="slope"),
        Parameter("b", 0.01, 10.0, "{output}/{input}^3", scaling="log", meaning="bend"),
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        cubic: Array = p.a * signal.input + p.b * signal.input**3
        return cubic


class Waves(Model):
    """A sum of sines whose amplitudes are the parameters, squared: smooth, cheap, and one minimum in the box."""

    def __init__(self, dimension: int) -> None:
        self.parameters = tuple(Parameter(f"a{i}", 0.0, 1.0) for i in range(dimension))  # type: ignore[misc]

    def simulate(self, signal: Signal, p: Any) -> Array:
        values = np.array(p)
        waves = np.sin(np.outer(signal.time, 1.0 + np.arange(len(values))) * 2.0)
        summed: Array = waves @ (values + values**2)
        return summed


class Plateau(Waves):
    """The same output everywhere; NaN makes the meter answer its ceiling."""

    def __init__(self, dimension: int, level: float) -> None:
        super().__init__(dimension)
        self.level = level

    def simulate(self, signal: Signal, p: Any) -> Array:
        return np.full((signal.time.size, p[0].size), self.level)


class Breaks(Waves):
    """Raises ArithmeticError on the second simulation."""

    def __init__(self, dimension: int) -> None:
        super().__init__(dimension)
        self.left = 2

    def simulate(self, signal: Signal, p: Any) -> Array:
        self.left -= 1
        if self.left <= 0:
            raise ArithmeticError("the model broke")
        return super().simulate(signal, p)
