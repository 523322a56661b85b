"""Leakage curve: the output collects a current that is any smooth curve of the input."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import largest_input, longest, motionless, output_span, without_time
from hysteresis_plugins.effects.free._spline import POINTS, narrow

ORDERS = (1, 2, 3, 4, 5, 6, 7)


@dataclass(frozen=True)
class LeakageCurve(FreeForm):
    """The output collects the integral of a current that is a polynomial of the input.

    y = x + integral of sum_k c_k (u / U)^k dt from the record's first sample, x the response, U the largest input:
    of `leakage`, without its straight line. Exact for an input that is linear between its samples.
    """

    acts = "added"
    family = "change with time, path or temperature"
    affine = True
    linear = tuple(f"current{k}" for k in ORDERS)
    ranges = ("largest",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("largest", 0.5, 10.0, "{input}", meaning="input that the powers count in", positive=True),
        *(
            Parameter(
                f"current{k}",
                -1.0,
                1.0,
                "{output}/{time}",
                null=0.0,
                meaning=f"part of power {k}, at the largest input",
            )
            for k in ORDERS
        ),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.polynomial_current import collect

        if not signal.timed:
            return inner(signal)
        output = own(inner(signal), signal)
        collect(output, signal.time, signal.input, p.largest, np.stack([getattr(p, f"current{k}") for k in ORDERS]))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Each part up to what collects the output's range twenty times in the longest record."""
        most = 20.0 * (output_span(records) or 1.0) / longest(records)
        largest, *currents = self.parameters
        return narrow(largest, largest_input(records) or 1.0), *(one.within(-most, most) for one in currents)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records) or motionless(records)

    def curve(self, p: Any) -> Curve:
        z = np.linspace(-1.0, 1.0, POINTS)
        current = np.sum([getattr(p, f"current{k}") * z**k for k in ORDERS], axis=0)
        return Curve(p.largest * z, current, "input", "current into the output", "{input}", "{output}/{time}")
