"""What the output should do: the six signals of the PEA paper's Table 6.

The paper prints neither amplitudes nor durations, and of the damped sine 0.5 Hz in section 5.1; ours are below. Sines
fade in over FADE_IN and are scored from then on, since no controller can start a mass at full speed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array

FADE_IN = 0.2
"""Seconds in which a sine comes to its amplitude."""
COMPLEX = (10.0, 20.0, 30.0, 40.0, 50.0)
"""Hz: the sines of the complex reference."""


@dataclass(frozen=True, eq=False)
class Reference:
    """A wanted output over time, both (samples,); the first `history` samples are followed, not scored."""

    name: str
    time: Array
    position: Array
    history: int = 0

    @cached_property
    def velocity(self) -> Array:
        """By central differences."""
        return np.gradient(self.position, self.time)

    @cached_property
    def acceleration(self) -> Array:
        """By central differences of the positions either side."""
        step = float(self.time[1] - self.time[0])
        inner = np.diff(self.position, 2) / step**2
        return np.concatenate([[0.0], inner, [0.0]])

    @property
    def delay_floor(self) -> float:
        """RMS error of an output that is perfect but one sample late."""
        late = self.position[self.history : -1] - self.position[self.history + 1 :]
        return float(np.sqrt(np.mean(np.square(late))))


def static_reference(amplitude: float, rate: float) -> Reference:
    """What the PEA paper's Figure 14 follows without a sensor: 0.5 Hz, the second of two periods scored."""
    time = np.arange(round(4.0 * rate)) / rate
    return Reference("sine-0.5-hz", time, amplitude * np.sin(np.pi * time), round(2.0 * rate))


def faded_in(passed: Array) -> Array:
    """What a signal is multiplied by while it fades in, without a jump in velocity or acceleration, (samples,).

    passed : (samples,) share of the time it takes; beyond 1 it is all there
    """
    share = np.clip(passed, 0.0, 1.0)
    smooth: Array = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    return smooth


def published_references(amplitude: float, rate: float) -> tuple[Reference, ...]:
    """The six signals; amplitude in the output's unit, rate in samples a second."""

    def made(name: str, duration: float, shape: Callable[[Array], Array], fade_in: float = 0.0) -> Reference:
        time = np.arange(round((duration + fade_in) * rate)) / rate
        smooth = faded_in(time / fade_in) if fade_in else np.ones(time.size)
        return Reference(name, time, amplitude * smooth * shape(time), round(fade_in * rate))

    def sine(frequency: float) -> Callable[[Array], Array]:
        return lambda time: np.sin(2.0 * np.pi * frequency * time)

    return (
        made("ramp", 2.0, lambda time: 1.0 - np.abs(time - 1.0)),  # up in 1 s, down in 1 s
        made("damped-sine", 6.0, lambda time: 0.05 ** (time / 6.0) * np.sin(2.0 * np.pi * 0.5 * time)),  # 0.5 Hz
        made("sine-10-hz", 0.5, sine(10.0), FADE_IN),
        made("sine-30-hz", 0.5, sine(30.0), FADE_IN),
        made("sine-50-hz", 0.5, sine(50.0), FADE_IN),
        made("complex", 0.5, lambda time: np.mean([sine(f)(time) for f in COMPLEX], axis=0), FADE_IN),
    )
