"""Leakage: the output of a charge amplifier runs back to zero.

[1] G. Gautschi, Piezoelectric Sensorics, Springer (2002), charge amplifiers and their time constant.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal


def _leaking(inner: Response, u: Array, hiding: Hiding) -> Array:
    """By implicit Euler steps on the fine grid."""
    x, rate = inner(u), 3.0 * hiding.strength / hiding.duration
    y = np.empty_like(x)
    y[0] = x[0]
    for k in range(1, x.size):
        y[k] = (y[k - 1] + x[k] - x[k - 1]) / (1.0 + rate * hiding.step)
    return y


@dataclass(frozen=True)
class Example(Effect):
    """The output leaks away to zero, as the charge of a piezoelectric sensor does through its amplifier [1].

    dy/dt = dx/dt - rate y, x the response; y = x at the first sample. Exact for a response that is linear between its
    samples. Where time is only an index it changes nothing.
    """

    acts = "output"
    family = "dynamics after the law"
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_leaking,)
    parameters = (Parameter("rate", 0.0, 1.0, "1/{time}", null=0.0, meaning="1 / the amplifier's time constant"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        x = inner(signal)
        leaking = np.flatnonzero(p.rate)  # the others stay as they are, to the last bit
        if not signal.timed or not leaking.size:
            return x
        rate, y = p.rate[leaking], x.copy()
        passed = np.diff(signal.time)[:, None] * rate
        kept, risen = np.exp(-passed), np.diff(x[:, leaking], axis=0) * -np.expm1(-passed) / passed
        for k in range(1, signal.time.size):
            y[k, leaking] = y[k - 1, leaking] * kept[k - 1] + risen[k - 1]
        return y

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to ten time constants in the longest record."""
        longest = max(float(record.time[-1] - record.time[0]) for record in records) or 1.0
        return (self.parameters[0].within(0.0, 10.0 / longest),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return "" if all(record.timed for record in records) else "the time of these records is only an index"
