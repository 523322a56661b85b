"""Droop: a slow high-pass after the hysteresis, as of a charge amplifier or an AC-coupled sensor."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import euler_lag, tustin
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import finest_step, longest, one_frequency, unresolved

SLOWEST = 1e-3
"""Least decay in the longest record: three decades below it nothing is left that noise would not hide."""
LEAST, MOST = 0.1, 1.5
"""Shares: less is slow creep backwards; two equal high-passes in series run back beyond the beginning by 0.14 of a
step."""
CENTRED = 0.1
"""Of its range, how far from its first value the input's mean may be to count as moving about it."""


def _off_centre(record: Record) -> float:
    """What of the input would run back, as a share of its range."""
    span = float(np.ptp(record.input))
    return abs(float(np.mean(record.input) - record.input[0])) / span if span > 0.0 else 0.0


def _time_constant(hiding: Hiding) -> float:
    """From two fifths of a record on: the weaker, the slower."""
    return 0.4 * hiding.duration / max(hiding.strength, 1e-6)


def _euler(inner: Response, u: Array, hiding: Hiding) -> Array:
    y = inner(u)
    passed: Array = y + y[0] - euler_lag(y, _time_constant(hiding), hiding.step)
    return passed


def _second_order(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Two stages in series, as of an amplifier behind an AC-coupled input."""
    y, tau = inner(u), 2.0 * _time_constant(hiding)
    passed: Array = y[0] + tustin(y - y[0], [tau * tau, 0.0, 0.0], [tau * tau, 2.0 * tau, 1.0], hiding.step)
    return passed


def _incomplete(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A leaking capacitor in series with one that does not leak: a part of the response stays."""
    y = inner(u)
    passed: Array = y - 0.7 * (euler_lag(y, 0.5 * _time_constant(hiding), hiding.step) - y[0])
    return passed


def _faster_far_out(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A leak that conducts better at a higher voltage."""
    y = inner(u)
    rate, passed = hiding.step / (1.5 * _time_constant(hiding)), y.copy()
    for k in range(1, y.size):
        away = passed[k - 1] - y[0]
        passed[k] = passed[k - 1] + y[k] - y[k - 1] - rate * (1.0 + abs(away / hiding.top)) * away
    return passed


@dataclass(frozen=True)
class Droop(Effect):
    """What is measured runs back to where it began: the discharge of a charge amplifier, or an AC coupling.

    y = x - share (z - x_0), dz/dt = rate (x - z), z = x_0 at the first sample, x the response: with a share of 1 a
    first-order high-pass with the time constant 1 / rate of the amplifier's feedback [1]. Exact for a response that is
    linear between its samples. The loop of a slow drive shrinks and leans against its sense of rotation. Ours: the
    amplifier is reset, or has settled, at the first sample; a share other than 1 runs back where only a part of the
    coupling leaks, or beyond the beginning where two stages follow each other.

    [1] G. Gautschi, Piezoelectric Sensorics, Springer (2002), on amplifiers: drift and time constant.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "leakage": "a slow droop takes away the integral of the response, which goes with the integral of the input",
        "creep": "both go on while the input holds, in opposite senses",
        "transport-delay": "at one frequency droop is a lead, which makes up for a part of a delay",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_euler,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_second_order, _incomplete, _faster_far_out)
    parameters = (
        Parameter("rate", 1e-4, 10.0, "1/{time}", "log", null=0.0, meaning="inverse time constant"),
        Parameter("share", LEAST, MOST, meaning="of the response that runs back, 1 of a charge amplifier"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.droop import droop

        output = inner(signal)
        if not signal.timed or not np.any(p.rate):
            return output
        output = own(output, signal)
        droop(output, signal.time, p.rate, p.share)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From a thousandth over the longest record's duration to a tenth over a step's, which passes steps only."""
        rate, share = self.parameters
        return rate.within(SLOWEST / longest(records), 0.1 / finest_step(records)), share

    def inapplicable(self, records: Sequence[Record]) -> str:
        if reason := unresolved(records):
            return reason
        if one_frequency(records) and max(map(_off_centre, records)) < CENTRED:
            return (
                "at the one frequency of these records, about where they begin, droop is a lead, as a loop's shape is"
            )
        return ""
