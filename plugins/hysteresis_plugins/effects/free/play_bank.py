"""Play bank: what acts crosses dead bands of any widths, beside each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import input_span, motionless
from hysteresis_plugins.effects.free._spline import POINTS, narrow

PLAYS = 10
NAMES = tuple(f"weight{k}" for k in range(1, PLAYS + 1))


@dataclass(frozen=True)
class PlayBank(FreeForm):
    """What acts crosses dead bands of several widths beside each other, a share of the motion none.

    v = u + sum of w_k (P_k[u] - u), P_k the play of half-width k reach / 10, the model sees v: the operator of Prandtl
    and Ishlinskii before the law [1], its weights the shares. Every play starts in the middle of its dead band.

    [1] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
    """

    acts = "input"
    family = "law"
    affine = True
    ranges = ("reach",)
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("reach", 0.5, 5.0, "{input}", meaning="half-width of the widest dead band", positive=True),
        *(Parameter(name, 0.0, 1.0, null=0.0, meaning=f"share that crosses dead band {name[6:]}") for name in NAMES),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.play_bank import play_bank

        shares = np.stack([getattr(p, name) for name in NAMES])
        if not np.any(shares):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        radii = np.arange(PLAYS + 1)[:, None] * (p.reach / PLAYS)
        whole = np.vstack([1.0 - np.sum(shares, axis=0), shares])
        return inner(signal.with_input(play_bank(signal.input, radii, whole[:, None])))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Up to 0.4 times the range of the input, as of a single dead band."""
        return narrow(self.parameters[0], 0.4 * (input_span(records) or 1.0)), *self.parameters[1:]

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

    def curve(self, p: Any) -> Curve:
        way = np.linspace(0.0, 2.0 * p.reach, POINTS)
        crossed = way[:, None] >= 2.0 * p.reach * np.arange(1, PLAYS + 1) / PLAYS
        shares = np.array([getattr(p, name) for name in NAMES])
        through = 1.0 - shares.sum() + crossed @ shares
        return Curve(way, through, "way since the last reversal", "share of the motion that gets through", "{input}")
