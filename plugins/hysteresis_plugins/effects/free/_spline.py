"""What the free forms share that are natural cubic splines [1].

[1] C. de Boor, A Practical Guide to Splines, Springer (1978), ch. IV.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import read_only

if TYPE_CHECKING:
    from hysteresis_bench.kernels.effects.natural_spline import Curves

NARROW = 0.01
"""By which share of itself, or of the data's range, a box is wide of what that range tells."""

POINTS = 61
"""Places at which a curve is computed to be drawn."""


@dataclass(frozen=True)
class Spline:
    """A curve over a range, linear in its ordinates, which are parameters.

    prefix : of their names;  knots : from 0 to 1, rising;  node : a knot at which the curve is 0
    held : level beyond the range, straight otherwise
    tied : the last ordinate is the first, so that a straight line is none of these curves
    """

    prefix: str
    knots: tuple[float, ...]
    node: int | None
    held: bool = False
    tied: bool = False

    def parameters(self, unit: str, meaning: str) -> tuple[Parameter, ...]:
        return tuple(
            Parameter(f"{self.prefix}{k}", -1.0, 1.0, unit, null=0.0, meaning=f"{meaning} at {knot:.3g} of the range")
            for k, knot in enumerate(self.knots[: len(self.knots) - self.tied])
            if k != self.node
        )

    def curves(self, low: Array, high: Array, p: Any) -> Curves:
        """Of a swarm; low, high : (swarm,), the ends of the range."""
        from hysteresis_bench.kernels.effects.natural_spline import natural_splines

        given = np.zeros((len(self.knots), high.size))
        for k in range(len(self.knots) - self.tied):
            if k != self.node:
                given[k] = getattr(p, f"{self.prefix}{k}")
        if self.tied:
            given[-1] = given[0]
        return natural_splines(low, high, knots=self.knots, ordinates=given, held=self.held)

    def drawn(self, x: Array, low: float, high: float, p: Any) -> Array:
        """(points,), of one set of parameters; x : (points,)"""
        column = type(p)(*(np.array([value]) for value in p))
        found = np.zeros((x.size, 1))
        add(found, x[:, None], self.curves(np.array([low]), np.array([high]), column))
        return found[:, 0]


def add(y: Array, x: Array, curves: Curves) -> None:
    """y + s(x) in place of y, (samples, swarm);  x : (samples, 1) or (samples, swarm), y itself too"""
    from hysteresis_bench.kernels.effects.natural_spline import add_spline, add_spline_of_own

    if x.shape[1] > 1:
        add_spline_of_own(y, read_only(x), curves)
    else:
        add_spline(y, read_only(x[:, 0]), curves)


def scale(y: Array, x: Array, curves: Curves) -> None:
    """y (1 + s(x)) in place of y; the arguments as in `add`"""
    from hysteresis_bench.kernels.effects.natural_spline import add_spline_of_own, scale_by_spline

    if x.shape[1] > 1:
        factor = np.ones_like(y)
        add_spline_of_own(factor, read_only(x), curves)
        y *= factor
    else:
        scale_by_spline(y, read_only(x[:, 0]), curves)


def early(prefix: str) -> Spline:
    """A change from the first sample on: 0 there, the knots denser where it begins, as that is where it is quick."""
    return Spline(prefix, tuple((k / 6.0) ** 2 for k in range(7)), 0, held=True)


def bent(prefix: str) -> Spline:
    """A curve of a signal: without a shift and a gain, which belong to what is wrapped."""
    return Spline(prefix, tuple(k / 8.0 for k in range(9)), 4, tied=True)


def narrow(parameter: Parameter, value: float, scale: float | None = None) -> Parameter:
    """In a narrow box around what the data tell; scale : of the width, the value itself where there is none"""
    width = NARROW * (scale or abs(value) or 1.0)
    return parameter.within(value - width, value + width)


def extremes(columns: Sequence[Array]) -> tuple[float, float]:
    """Least and largest value."""
    return min(float(np.min(one)) for one in columns), max(float(np.max(one)) for one in columns)
