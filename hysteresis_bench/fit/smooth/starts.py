"""Where the search for the few parameters of a smooth law that are not linear begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.parameters import Parameter, Space

SCREENED = 4
"""Points for each dimension."""


def starts(parameters: Sequence[Parameter]) -> Array:
    """(points, dimension) of the unit box, evenly spread over the parameters and the smoothness, which comes last; then
    over the others where one effect is off, each in turn: with an effect more a law must not be found to predict worse.
    """
    dimension = len(parameters) + 1
    points = [_spread(dimension)]
    for effect in dict.fromkeys(p.name.partition(".")[0] for p in parameters if "." in p.name and p.null is not None):
        own = [p.name.partition(".")[0] == effect for p in parameters]
        off = np.array([_off(p) for p in parameters])
        rest = np.array([*np.logical_not(own), True])
        smaller = _spread(int(rest.sum()))
        embedded = np.empty((len(smaller), dimension))
        embedded[:, rest], embedded[:, ~rest] = smaller, off[own]
        points.append(embedded)
    return np.concatenate(points)


def _spread(dimension: int) -> Array:
    from scipy.stats.qmc import Halton

    return np.asarray(Halton(dimension, scramble=False).random(SCREENED * dimension + 1)[1:])


def _off(p: Parameter) -> float:
    """Of the unit interval, where it is off; its middle where it switches nothing."""
    if p.null is None:
        return 0.5
    return float(Space((p,)).to_unit(np.array([[np.clip(p.null, p.lower, p.upper)]]))[0, 0])
