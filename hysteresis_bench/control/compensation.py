"""From the v that a feedback law commands to the voltage, through the inverse hysteresis: two readings of Figure 12.

`Series` is the PEA paper's drawing to the letter: the inverse runs on every v that the law commands. A Bouc-Wen
model forgets its hysteresis along the path |du|, also on the smallest reversals, which real hysteresis does not
(its small loops close). A law that chatters by a few hundredths of a volt at 10 kHz therefore wipes out the h of the
inverse within milliseconds, and the compensation with it.
`AlongReference` is ours: the inverse runs on the v that the reference needs, which is smooth, and what feedback adds
is converted with the model's slope: at h = 0, d (1 - alpha), or of a law without such an inverse, its mean.

Both know what they applied: where the voltage is cut, v is what the voltage that went out is worth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.feed_forward import FeedForward
from hysteresis_bench.control.inverse import Point
from hysteresis_bench.control.iterated_inverse import IteratedInverse

Forward: TypeAlias = FeedForward | IteratedInverse


class Applied(NamedTuple):
    """voltage : that goes out;  v : what it is worth in the model;  cut : the limit changed it"""

    voltage: float
    v: float
    cut: bool


class Compensation(Protocol):
    """The inverse hysteresis in a loop; what it remembers goes in and out."""

    def start(self) -> Any: ...

    def apply(self, state: Any, sample: int, v: float, limit: float) -> tuple[Any, Applied]: ...


@dataclass(frozen=True)
class Series:
    """The inverse in series: it runs on every commanded v."""

    forward: FeedForward

    def start(self) -> Point:
        return self.forward.rest()

    def apply(self, state: Point, sample: int, v: float, limit: float) -> tuple[Point, Applied]:
        point, voltage, cut = self.forward.limited(state, v, limit)
        return point, Applied(voltage, self.forward.hysteresis.output(point), cut)


@dataclass(frozen=True, eq=False)
class AlongReference:
    """The inverse along the v that the reference needs.

    nominal, input : (samples,) that v and its model input;  slope : of v over it, for what feedback adds
    """

    forward: Forward
    nominal: Array
    input: Array
    slope: float

    def start(self) -> None:
        return None

    def apply(self, state: None, sample: int, v: float, limit: float) -> tuple[None, Applied]:
        slope, planned, u = self.slope, float(self.nominal[sample]), float(self.input[sample])
        wanted = self.forward.preparation.measured_input(u + (v - planned) / slope)
        voltage = min(max(wanted, -limit), limit)
        cut = voltage != wanted
        return None, Applied(
            voltage, planned + (self.forward.preparation.seen_input(voltage) - u) * slope if cut else v, cut
        )


def along(forward: Forward, nominal: Array, time: Array) -> AlongReference:
    """The inverse run once along the v of the reference, (samples,), with what linear effects need ahead."""
    v = np.asarray(nominal, dtype=float)
    if forward.dynamics is None:
        return AlongReference(forward, nominal, *forward.along(v))
    u, slope = forward.along(forward.dynamics.output_for(time, v))
    return AlongReference(forward, nominal, forward.dynamics.input_for(time, u), slope)
