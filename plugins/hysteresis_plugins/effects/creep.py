"""Creep: a share of the response arrives late, over decades of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import euler_lag, tustin_lag
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import finest_step, longest, unresolved


def _euler(inner: Response, u: Array, hiding: Hiding) -> Array:
    y, late = inner(u), 0.6 * hiding.strength / 3.0
    times = 0.16 / hiding.fastest * 8.0 ** hiding.random[0] * np.array([0.3, 1.0, 3.0])
    return (1.0 - 3.0 * late) * y + late * sum(euler_lag(y, float(tau), hiding.step) for tau in times)


def _tustin(inner: Response, u: Array, hiding: Hiding) -> Array:
    y = inner(u)
    late = (0.12 + 0.2 * hiding.strength) * y / 3.0
    mean = 0.01 * hiding.duration * 10.0 ** hiding.random[0]
    return y + sum(tustin_lag(late, mean * 10.0**decade, hiding.step) - late for decade in (-0.6, 0.0, 0.6))


def _power_law(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Relaxations over four decades whose weights fall with the time constant, as of a fractional element."""
    y, times = inner(u), 0.05 / hiding.fastest * 10.0 ** np.linspace(0.0, 3.0, 9)
    weights = times**-0.25 / np.sum(times**-0.25)
    late = 0.5 * hiding.strength
    relaxed = np.column_stack([euler_lag(y, float(tau), hiding.step) for tau in times]) @ weights
    return (1.0 - late) * y + late * relaxed


def _stretched_exponential(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Kohlrausch's step response 1 - exp(-sqrt(t / tau)), by convolution with the increments."""
    from scipy.signal import fftconvolve

    y, late = inner(u), 0.5 * hiding.strength
    tau = 0.3 / hiding.fastest * 8.0 ** hiding.random[0]
    behind = np.exp(-np.sqrt((hiding.time - hiding.time[0]) / tau))
    lag: Array = fftconvolve(np.diff(y, prepend=y[0]), behind)[: y.size]
    return y - late * lag


@dataclass(frozen=True)
class Creep(Effect):
    """A share of the response arrives late, through relaxations spread evenly over decades of time.

    y = (1 - share) x + share mean_k z_k, tau_k dz_k/dt + z_k = x, x the response, z_k = x at the first sample.

    This is the linear creep operator of [1] in series with the hysteresis: one relaxation where `decades` is
    0, and creep with the logarithm of time, y ~ log(1 + t / t_0) after a step, where it is large [2].
    Ours: `share` counts in the fully relaxed response, so that the static gain and a constant output stay as
    they are; [1] counts in the immediate response, share / (1 - share). It works for any input, also where
    time since "the" step means nothing.

    [1] P. Krejci, K. Kuhnen, Inverse control of systems with hysteresis and creep, IEE Proceedings - Control
    Theory and Applications 148 (2001) 185-192.
    [2] H. Jung, D.-G. Gweon, Creep characteristics of piezoelectric actuators, Review of Scientific
    Instruments 71 (2000) 1896-1900.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    relaxes = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "drift": "creep that is slow against the record is a straight line in time",
        "input-lag": "both let a part of the response arrive late",
        "resonance": "both let a part of the response arrive late",
        "transport-delay": "both let the response arrive late; they differ in how it depends on speed",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_euler, _tustin)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_power_law, _stretched_exponential)
    parameters = (
        Parameter("share", 0.0, 0.9, null=0.0, meaning="of the relaxed response that arrives late"),
        Parameter("time_constant", 1e-3, 1e2, "{time}", "log", meaning="geometric mean of the relaxations'"),
        Parameter("decades", 0.0, 4.0, meaning="from the fastest relaxation to the slowest"),
    )

    relaxations: int = 5

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.lag import late_response

        output = inner(signal)
        if not signal.timed:
            return output
        place = np.linspace(-0.5, 0.5, self.relaxations)[:, None]
        constants = p.time_constant * 10.0 ** (place * p.decades)
        output = own(output, signal)
        return late_response(signal.time, output, p.share, constants, output)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Mean time constants from a sampling step to the duration of the longest record."""
        share, time_constant, decades = self.parameters
        return share, time_constant.within(finest_step(records), longest(records)), decades

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)
