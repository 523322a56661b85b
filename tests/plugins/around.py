"""An effect around y = 2 u, on a sine that is off its centre, and on a step."""

from collections import namedtuple
from dataclasses import replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.contracts import Effect
from hysteresis_bench.signals import Record, Signal

TIME = np.linspace(2.0, 6.0, 401)
DRIVE = 3.0 * np.sin(2 * np.pi * TIME) + 0.5
STEP = Signal(TIME, np.where(TIME > 2.0, 1.0, 0.0)[:, None])
SINCE = TIME - TIME[1]


def record(time=TIME, drive=DRIVE, name="record", **changes) -> Record:
    return replace(Record(time, drive, 2.0 * drive, name=name), **changes)


def applied(name: str, signal: Signal, settings=None, **values) -> np.ndarray:
    """The effect around y = 2 u, for one set of parameters."""
    effect: Effect = registry.build("effects", name, settings)
    p = namedtuple("Values", values)(*(np.array([float(value)]) for value in values.values()))
    return effect.apply(lambda seen: 2.0 * seen.input, signal, p)[:, 0]


def box(name: str, *records: Record) -> dict[str, tuple[float, float]]:
    parameters = registry.build("effects", name).box(records)
    return {parameter.name: (parameter.lower, parameter.upper) for parameter in parameters}


def against(name: str, *records: Record) -> str:
    return registry.build("effects", name).inapplicable(records)
