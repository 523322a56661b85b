"""Slew-rate limit: what drives the hysteresis follows the measured input no faster than at a highest rate."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import speeds, unresolved

SLOWEST = 4.0
"""The largest slowness, in that of a mean movement: it leaves a quarter of the way at most."""


def _rate(share: float, hiding: Hiding) -> float:
    """share : of the rate of the fastest drive at the largest amplitude, at the strength 1;  the weaker the faster"""
    return share * 2.0 * np.pi * hiding.fastest * hiding.amplitude / max(hiding.strength, 1e-9)


def _limited(u: Array, up: float, down: float, step: float) -> Array:
    out, state = np.empty_like(u), float(u[0])
    for k, now in enumerate(u.tolist()):
        state = min(max(now, state - down * step), state + up * step)
        out[k] = state
    return out


def _clipped(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Sample by sample."""
    rate = _rate(0.06, hiding)
    return inner(_limited(u, rate, rate, hiding.step))


def _unequal(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Slower down than up, as of a cylinder with a rod on one side."""
    return inner(_limited(u, _rate(0.08, hiding), _rate(0.05, hiding), hiding.step))


def _soft(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A servo whose rate saturates smoothly with what it is behind."""
    rate, linear = _rate(0.08, hiding), 0.1 * hiding.strength * hiding.amplitude
    out, state = np.empty_like(u), float(u[0])
    for k, now in enumerate(u.tolist()):
        state += np.clip(hiding.step * rate * np.tanh((now - state) / linear), -abs(now - state), abs(now - state))
        out[k] = state
    return inner(out)


def _loaded(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Slower the further out, as against a spring."""
    top = _rate(0.09, hiding)
    out, state = np.empty_like(u), float(u[0])
    for k, now in enumerate(u.tolist()):
        most = hiding.step * top * (1.0 - 0.6 * min(abs(state) / hiding.amplitude, 1.0))
        state = min(max(now, state - most), state + most)
        out[k] = state
    return inner(out)


@dataclass(frozen=True)
class SlewRateLimit(Effect):
    """A highest rate before the hysteresis, such as of an amplifier whose current, or of a valve whose flow is limited.

    |dv/dt| <= 1 / slowness, v as near to u as that allows, v = u at the first sample; the model sees v [1]. Exact for
    an input that is linear between its samples. Unlike a lag it leaves slow inputs as they are. Ours: upwards it takes
    slowness (1 - skew) a unit of way at least, downwards slowness (1 + skew).

    [1] D. H. Klyde, D. T. McRuer, T. T. Myers, J. Guid. Control Dyn. 20 (1997) 81: actuators with a rate limit.
    """

    acts = "input"
    family = "dynamics before the law"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "input-lag": "at one amplitude and frequency both shift the loop in time and take some of its width",
        "transport-delay": "at one amplitude and frequency both shift the loop in time",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_clipped, _unequal)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_soft, _loaded)
    parameters = (
        Parameter("slowness", 0.0, 10.0, "{time}/{input}", null=0.0, meaning="one over the highest rate"),
        Parameter("skew", -0.6, 0.6, null=0.0, meaning="share by which downwards is slower, and upwards faster"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.slew_limit import slew_limited

        if not signal.timed or not np.any(p.slowness):  # the model sees the very input, still shared
            return inner(signal)
        rising, falling = p.slowness * (1.0 - p.skew), p.slowness * (1.0 + p.skew)
        return inner(signal.with_input(slew_limited(signal.time, signal.input, rising, falling)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to what lets a quarter of the way through."""
        slowness, skew = self.parameters
        mean = max((float(np.mean(speeds(record))) for record in records), default=0.0) or 1.0
        return (slowness.within(0.0, SLOWEST / mean), skew)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)
