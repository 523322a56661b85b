"""What a law declares that it does, asked of simulations: each of its properties, and the senses of its loops."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Property
from hysteresis_bench.signals import Signal

Run = Callable[[Signal], Array]
"""A law at some points of its box: signal -> (samples, swarm)."""

STEP = 0.02
"""Of the input, between samples."""
ALIKE = 1e-6
"""Share of the output's range by which a property may be missed: a solver's tolerance."""
THIN = 1e-3
"""Share of the rectangle around a loop below which its area has no sign."""


def ramps(*reversals: float) -> Array:
    """An input that goes from one value to the next in equal steps, (samples,)."""
    parts = [np.array(reversals[:1])]
    for begin, end in pairwise(reversals):
        parts.append(np.linspace(begin, end, round(abs(end - begin) / STEP) + 1)[1:])
    return np.concatenate(parts)


def _driven(run: Run, u: Array, time: Array | None = None) -> Array:
    return run(Signal(np.linspace(0.0, 1.0, u.size) if time is None else time, np.ascontiguousarray(u[:, None])))


def _rate_independent(run: Run) -> Array:
    u = ramps(0.0, 1.2, -0.8, 0.6, -1.2)
    slow = np.linspace(0.0, 1.0, u.size)
    return _driven(run, u, slow) - _driven(run, u, 40.0 * slow**2 + slow)


def _odd(run: Run) -> Array:
    u = ramps(0.0, 1.2, -0.8, 0.6, -1.2)
    return _driven(run, u) + _driven(run, -u)


def _return_point(run: Run) -> Array:
    u = ramps(0.0, 1.2, -1.0, 0.8, -0.2, 0.8)
    y = _driven(run, u)
    first = int(np.flatnonzero(np.isclose(u, 0.8) & (np.arange(u.size) > ramps(0.0, 1.2, -1.0).size))[0])
    return y[-1:] - y[first : first + 1]


def _congruent(run: Run) -> Array:
    while_rising, while_falling = (ramps(0.0, 1.2, -1.2, 0.4, -0.4), ramps(0.0, 1.2, -0.4, 0.4, -0.4))
    tail = ramps(0.4, -0.4).size
    one, other = (_driven(run, u)[-tail:] for u in (while_rising, while_falling))
    apart: Array = (one - one[0]) - (other - other[0])
    return apart


def _masing(run: Run) -> Array:
    reversals = (0.0, 1.2, -1.2, 0.6, -0.6, 0.2)
    u = ramps(*reversals)
    y = _driven(run, u)
    starts = np.cumsum([round(abs(b - a) / STEP) for a, b in pairwise(reversals)])
    length = round(0.8 / STEP)
    curves = [way * (y[k : k + length] - y[k]) for k, way in zip(starts[:4], (-1, 1, -1, 1), strict=True)]
    return np.concatenate([curve - curves[0] for curve in curves[1:]])


MISSES: Mapping[Property, Callable[[Run], Array]] = {
    "rate-independent": _rate_independent,
    "odd": _odd,
    "return-point": _return_point,
    "congruent": _congruent,
    "masing": _masing,
}
"""By how much a law misses a property, (samples, swarm): nothing, where it has it."""


def missed(run: Run, name: Property) -> Array:
    """The most by which each particle misses a property, as a share of its output's range, (swarm,)."""
    span = np.ptp(_driven(run, ramps(0.0, 1.2, -1.2, 1.2)), axis=0)
    most: Array = np.max(np.abs(MISSES[name](run)), axis=0) / np.where(span > 0.0, span, 1.0)
    return most


def turned(run: Run) -> Sequence[int]:
    """The sense of every particle's loop between -1.2 and 1.2, 0 where it has none."""
    u = ramps(0.0, 1.2, -1.2, 1.2, -1.2, 1.2)
    y = _driven(run, u)
    loop = slice(u.size - ramps(1.2, -1.2, 1.2).size, None)
    steps, found = np.diff(u[loop])[:, None], y[loop]
    areas = -np.sum(0.5 * (found[1:] + found[:-1]) * steps, axis=0)
    boxes = np.ptp(u) * np.ptp(found, axis=0)
    return [int(np.sign(area)) if abs(area) > THIN * box else 0 for area, box in zip(areas, boxes, strict=True)]
