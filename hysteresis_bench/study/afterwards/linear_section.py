"""The linear section G(s) = b / (s² + (c/m) s + k/m) from what goes in and what comes out.

An output-error fit, started from a linear regression. This stands for the toolbox of the PEA paper, section 3.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.identifiability.analysis import analyse
from hysteresis_bench.fit.least_squares import at_bound, polish
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Space

REACH = 10.0
"""The output-error fit searches from a tenth to ten times what the regression gives."""


@dataclass(frozen=True, eq=False)
class LinearSection:
    """values, standard_errors : (3,) gain b 1/s², damping c/m 1/s, stiffness k/m 1/s²; an error is inf where
    the data cannot tell. fault : why the section cannot be used, or an empty string."""

    values: Array
    standard_errors: Array
    fault: str = ""


def fitted(problem: Problem, inputs: Sequence[Array]) -> LinearSection:
    """Least squares on the output of a problem whose parameters are gain, damping and stiffness, in this order.

    inputs : for every record of the problem what enters the section, (samples,); standard errors allow for
    residuals that are correlated in time. Where the regression gives an unstable section its values are
    returned with a fault: no simulation can be fitted from there.
    """
    seen = [
        (record.time, v, record.output)
        for record, v in zip(problem.records, inputs, strict=True)
        if record.output is not None
    ]
    start = regressed(seen)
    unknown = np.full(3, np.inf)
    if fault := unstable(start):
        return LinearSection(start, unknown, fault)
    near, far = np.sort([start / REACH, start * REACH], axis=0)
    boxes = zip(problem.space.parameters, near, far, strict=True)
    walls = [parameter.within(low, high, "linear") for parameter, low, high in boxes]
    boxed = replace(problem, space=Space(tuple(walls)))
    values = polish(boxed, start)
    stuck = [name for name, edge in zip(problem.space.names, at_bound(boxed.space, values), strict=True) if edge]
    if stuck:
        return LinearSection(values, unknown, f"no optimum near the regression: {', '.join(stuck)} left its box")
    return LinearSection(values, analyse(boxed, values).standard_errors)


def unstable(values: Array) -> str:
    """Why a section with this gain, damping and stiffness is none, or an empty string."""
    if not np.all(np.isfinite(values)):
        return "the regression has no solution"
    names = [name for name, value in zip(("damping", "stiffness"), values[1:], strict=True) if value <= 0.0]
    return f"unstable: the {' and the '.join(names)} would have to be negative" if names else ""


def regressed(records: Sequence[tuple[Array, Array, Array]]) -> Array:
    """Gain, damping and stiffness, (3,), by linear regression on filtered signals; no simulation, no start.

    records : (time, input v, output y) of (samples,) each. With the lag L = 1 / (1 + s/w) the derivatives of
    L² y are signals: s L² y = w (L - L²) y and s² L² y = w² (1 - 2 L + L²) y. So
    s² L² y = b L² v - (c/m) s L² y - (k/m) L² y holds at every sample, for records that begin in equilibrium.
    Noise biases it: a start, not a result.
    """
    from hysteresis_bench.kernels.lag import lag

    rows, sides = [], []
    for time, v, y in records:
        w = _fastest(time, v)
        constant = np.array([1.0 / w])
        once = lag(time, np.column_stack([v, y]), np.repeat(constant, 2))
        twice = lag(time, once, np.repeat(constant, 2))
        slope = w * (once[:, 1] - twice[:, 1])
        curvature = w**2 * (y - 2.0 * once[:, 1] + twice[:, 1])
        rows.append(np.column_stack([twice[:, 0], -slope, -twice[:, 1]]))
        sides.append(curvature)
    matrix, side = np.concatenate(rows), np.concatenate(sides)
    scale = np.linalg.norm(matrix, axis=0)
    if not np.all(scale > 0.0):
        return np.full(3, np.nan)
    section: Array = np.linalg.lstsq(matrix / scale, side, rcond=None)[0] / scale
    return section


def _fastest(time: Array, v: Array) -> float:
    """Angular frequency of the fastest half wave of the input, 1/s: where the filter's corner belongs."""
    positive = v > np.mean(v)
    crossings = time[1:][positive[1:] != positive[:-1]]
    if crossings.size < 2:
        return 2.0 * np.pi / float(time[-1] - time[0])
    return float(np.pi / np.min(np.diff(crossings)))
