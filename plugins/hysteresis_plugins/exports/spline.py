"""A natural cubic spline at one place; constants: knots, where knot 0 lies, scale, the knots, four of every piece."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_plugins.effects.free._spline import Spline


def spline_at(p: Array, o: int, x: float) -> float:
    """Its value; o : where its constants begin."""
    knots: int = int(p[o])
    z = (x - p[o + 1]) * p[o + 2]
    origin = p[o + 3]
    piece: int = o + 3 + knots
    for k in range(knots):
        if z > p[o + 3 + k]:
            origin = p[o + 3 + k]
            piece += 4
    z -= origin
    return p[piece] + z * (p[piece + 1] + z * (p[piece + 2] + z * p[piece + 3]))


def constants_of(spline: Spline, low: float, high: float, p: Mapping[str, float]) -> tuple[float, ...]:
    """low, high : the ends of its range"""
    given = SimpleNamespace(**{name: np.array([value]) for name, value in p.items()})
    curves = spline.curves(np.array([low]), np.array([high]), given)
    numbers = (len(spline.knots), curves.low[0], curves.scale[0], *curves.knots, *curves.pieces[:, :, 0].ravel())
    return tuple(map(float, numbers))
