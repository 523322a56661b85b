"""Lags before: what acts follows the input with any spectrum of lags."""

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
from hysteresis_plugins.effects.free.lags._spectrum import PARAMETERS, RANGES, box, late, step_response


@dataclass(frozen=True)
class LagsBefore(FreeForm):
    """The model sees the input through lags of any weights, on a logarithmic grid of time constants.

    v = u + sum of w_k (lag_k[u] - u), the model sees v: a spectrum of relaxations [1], its weights of either sign, so
    that lags in series are covered as well. Exact for an input that is linear between its samples.

    [1] N. W. Tschoegl, The Phenomenological Theory of Linear Viscoelastic Behavior, Springer (1989).
    """

    acts = "input"
    family = "dynamics before the law"
    affine = True
    ranges = RANGES
    parameters = PARAMETERS

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not signal.timed or not np.any(p[2:]):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(late(signal.time, signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Time constants from half a sampling step to the duration of the longest record."""
        return box(records)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved_curve(records)

    def curve(self, p: Any) -> Curve:
        return step_response(p, "what acts")
