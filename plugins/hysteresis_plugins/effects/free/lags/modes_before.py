"""Modes before: what acts is the input through two modes of any weights."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import unresolved_curve
from hysteresis_plugins.effects.free.lags._modes import PARAMETERS, box, frequency_response, passed, starts, weights


@dataclass(frozen=True)
class ModesBefore(FreeForm):
    """The model sees the input through two modes beside each other, of any weights, and a direct path.

    v = u + w_1 (mode_1[u] - u) + w_2 (mode_2[u] - u), the model sees v, the modes as of `modes-after` [1]: a position
    loop, an amplifier or a drive train that overshoots. Exact for an input that is linear between its samples.

    [1] D. J. Ewins, Modal Testing: Theory, Practice and Application, 2nd ed., Research Studies Press (2000), ch. 2.
    """

    acts = "input"
    family = "dynamics before the law"
    affine = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "modes-after": (
            "modes before a rate-independent hysteresis and after it differ only where the loop is not a straight line"
        ),
    }
    parameters = PARAMETERS

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or not np.any(weights(p)):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(passed(signal.time, signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Periods from two sampling steps to twice the one in which the fastest record runs through its range."""
        return box(records)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """Most of the motion in the slower mode; or a little of it, beside the direct path."""
        return starts(records)

    def curve(self, p: Any) -> Curve:
        return frequency_response(p)
