"""Viscous damping: beside the hysteresis acts a force that is proportional to the input's rate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import fastest, output_span
from hysteresis_plugins.effects._rate import rate, without_rates


def _speed(u: Array, hiding: Hiding) -> Array:
    """Over that of the fastest drive at the largest amplitude."""
    return np.asarray(np.gradient(u, hiding.step) / (2.0 * np.pi * hiding.fastest * hiding.amplitude))


def _dashpot(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + 0.3 * hiding.strength * abs(hiding.top) * _speed(u, hiding)


def _root(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A fluid damper whose force goes with the square root of the speed."""
    v = _speed(u, hiding)
    return inner(u) + 0.3 * hiding.strength * abs(hiding.top) * np.sign(v) * np.sqrt(np.abs(v))


def _square(inner: Response, u: Array, hiding: Hiding) -> Array:
    """An orifice: the force goes with the square of the speed."""
    v = _speed(u, hiding)
    return inner(u) + 0.3 * hiding.strength * abs(hiding.top) * v * np.abs(v)


@dataclass(frozen=True)
class ViscousDamping(Effect):
    """Beside the hysteresis acts a dashpot: a force that is proportional to the input's rate is added to the output.

    y = x + damping du/dt, x the response: as c₀ dx/dt stands beside Bouc-Wen hysteresis in a damper's force [1]. It
    turns loops clockwise, output over input, the wider the faster they are run; no lag does so. Ours: the rate at a
    sample is the central difference.

    [1] B. F. Spencer, S. J. Dyke, M. K. Sain, J. D. Carlson, J. Eng. Mech. 123 (1997) 230, eq. (1).
    """

    acts = "law"
    family = "damping beside the law"
    affine = True
    linear = ("damping",)
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_dashpot,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_root, _square)
    parameters = (
        Parameter("damping", 0.0, 1.0, "{output} {time}/{input}", null=0.0, meaning="force over the rate of the input"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        if not signal.timed or signal.time.size < 2 or not np.any(p.damping):
            return output
        damped: Array = output + p.damping * rate(signal.time, signal.input)
        return damped

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to what makes the output's range at the fastest input."""
        return (self.parameters[0].within(0.0, (output_span(records) or 1.0) / (fastest(records) or 1.0)),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_rates(records)
