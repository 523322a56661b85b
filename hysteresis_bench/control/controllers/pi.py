"""Proportional and integral feedback beside the feed-forward; with both gains 0 it is the feed-forward alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from hysteresis_bench.control.closed_loop import Target
from hysteresis_bench.control.feed_forward import LinearSection


class Memory(NamedTuple):
    """The integral, in the unit of v, and what this sample adds to it."""

    integral: float
    gained: float


@dataclass(frozen=True)
class ProportionalIntegral:
    """v = what the reference needs + proportional * error + integral of the error.

    gain : displacement at rest over v;  proportional : v a displacement;  integral : the same a second
    interval : s
    linear : where given, what the reference needs includes its dynamics; else it is reference / gain
    The integral stands still while the voltage is cut.
    """

    gain: float
    proportional: float
    integral: float
    interval: float
    linear: LinearSection | None = None

    def nominal(self, wanted: Target) -> Any:
        return self.linear.driven(*wanted) if self.linear else wanted.position / self.gain

    def start(self) -> Memory:
        return Memory(0.0, 0.0)

    def command(self, state: Memory, target: Target, measured: float) -> tuple[float, Memory]:
        """v, and the memory with this sample's gain pending."""
        error = target.position - measured
        v = self.nominal(target) + self.proportional * error + state.integral
        return v, Memory(state.integral, self.integral * self.interval * error)

    def applied(self, state: Memory, v: float, cut: bool) -> Memory:
        """The integral takes the sample in, unless the voltage was cut."""
        return Memory(state.integral if cut else state.integral + state.gained, 0.0)
