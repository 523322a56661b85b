"""Creep: a share of the response arrives late, over decades of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import finest_step, longest, unresolved


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
    family = "linear dynamics after the law"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "drift": "creep that is slow against the record is a straight line in time",
        "input-lag": "both let a part of the response arrive late",
        "resonance": "both let a part of the response arrive late",
        "transport-delay": "both let the response arrive late; they differ in how it depends on speed",
    }
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
        return late_response(signal.time, output, p.share, p.time_constant * 10.0 ** (place * p.decades))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Mean time constants from a sampling step to the duration of the longest record."""
        share, time_constant, decades = self.parameters
        return share, time_constant.within(finest_step(records), longest(records)), decades

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)
