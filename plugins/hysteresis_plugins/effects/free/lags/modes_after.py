"""Modes after: what is measured is the response through two modes of any weights."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import unresolved_curve
from hysteresis_plugins.effects.free.lags._modes import PARAMETERS, box, frequency_response, passed, starts, weights


@dataclass(frozen=True)
class ModesAfter(FreeForm):
    """What is measured is the response through two modes beside each other, of any weights, and a direct path.

    y = x + w_1 (mode_1[x] - x) + w_2 (mode_2[x] - x), x the response, mode = (1 + lead s / omega) omega² / (s² +
    2 damping omega s + omega²), omega = 2 pi / period: a sum of modes with unit static gain and residues of any phase,
    in which those of higher frequency follow x at once [1]. So they are transfer functions of fourth order with unit
    static gain, such as of resonances, antiresonances and stages in series. Exact for a response that is linear between
    its samples.

    [1] D. J. Ewins, Modal Testing: Theory, Practice and Application, 2nd ed., Research Studies Press (2000), ch. 2.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    parameters = PARAMETERS

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        return passed(signal.time, output, p) if signal.timed and np.any(weights(p)) else output

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
