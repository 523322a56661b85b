"""Growth of the loop's area with the amplitude: near 3 in Rayleigh's regime, 2 of a linear lag, below 1 in saturation.

[1] Lord Rayleigh, Philosophical Magazine 23 (1887) 225.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.diagnosis.structure.course import Course
from hysteresis_bench.diagnosis.structure.curves import Curve
from hysteresis_bench.diagnosis.structure.finding import Finding
from hysteresis_bench.diagnosis.structure.properties.rate_independence import FASTER
from hysteresis_bench.diagnosis.structure.properties.sense import THIN, loops

WIDER = 1.3
"""Ratio of the largest to the smallest amplitude that is needed."""
LINEAR = 2.0
"""The exponent of what merely scales with the amplitude."""


def area_growth(course: Course) -> Finding:
    """The exponent b of area ~ amplitude^b, and whether it is other than 2, as where the loop merely scales."""
    from scipy.special import stdtr

    found = [loop for number in range(len(course.views)) for loop in loops(course, number)]
    sizes = np.array([size for size, _, _ in found])
    if sizes.size < 3 or sizes.max() < WIDER * sizes.min():
        return Finding("growth of the area", "The loops have one amplitude only: how their area grows cannot be told.")
    rows = np.array([row for _, _, row in found])
    durations = np.array([duration for _, duration, _ in found])
    areas = np.abs(rows @ course.y)
    errors = np.sqrt(np.einsum("ii->i", course.noise.covariance(rows)))
    errors = np.hypot(errors, 0.25 * THIN * course.span_y * sizes)  # what the way between the samples may add
    clear = areas > 4.0 * errors
    if np.count_nonzero(clear) < 3 or sizes[clear].max() < WIDER * sizes[clear].min():
        return Finding("growth of the area", "Too few loops enclose a clear area: how it grows cannot be told.")
    x, y, weight = np.log(sizes[clear]), np.log(areas[clear]), areas[clear] / errors[clear]
    design = np.column_stack([x, np.ones_like(x)])
    slow = np.log(durations[clear])
    if np.ptp(slow) > np.log(FASTER):  # a lag's area grows with the frequency as well
        design = np.column_stack([design, slow])
    degrees = x.size - int(np.linalg.matrix_rank(design * weight[:, None]))
    solution = np.linalg.lstsq(design * weight[:, None], y * weight, rcond=None)[0]
    left = (y - design @ solution) * weight
    covariance = np.linalg.pinv((design * weight[:, None]).T @ (design * weight[:, None]))
    scatter = max(1.0, float(left @ left) / max(degrees, 1))
    exponent, error = float(solution[0]), float(np.sqrt(covariance[0, 0] * scatter))
    p = float(2.0 * stdtr(max(degrees, 1), -abs(exponent - LINEAR) / error))
    order = np.argsort(x)
    curve = Curve(np.exp(x[order]), np.exp(y[order]))
    words = f"the area grows with the amplitude to the power {exponent:.2g} ± {error:.1g}: {_regime(exponent)}."
    return Finding("growth of the area", words, exponent, p, unit="", curves=(curve,), along="amplitude")


def _regime(exponent: float) -> str:
    if exponent > 2.5:
        return "near 3 as in Rayleigh's regime, far from saturation"
    if exponent < 1.2:
        return "as where friction slips fully, or a material saturates"
    return "between Rayleigh's regime and saturation; a linear lag alone gives 2"
