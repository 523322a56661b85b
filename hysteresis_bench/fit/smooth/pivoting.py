"""Non-negative least squares of a definite system, by block principal pivoting.

Unknowns are dealt into those that are free and those that are held at 0; every one on the wrong side is exchanged at
once, and where that does not lessen how many are wrong, only the last of them [1].

[1] L. F. Portugal, J. J. Judice, L. N. Vicente, Mathematics of Computation 63 (1994) 625; J. Kim, H. Park, SIAM J.
    Scientific Computing 33 (2011) 3261.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

TRIES = 3
"""Exchanges of all at once that do not lessen how many are wrong, before one goes at a time."""
MOST = 300
"""Exchanges; where rounding makes them go round in circles, Lawson's and Hanson's method ends it."""
CLOSE = 1e-12
"""Share of the largest, below which a value or a slope counts as 0."""


def least_above(matrix: Array, right: Array, free: Array, inside: Array) -> Array:
    """The least of x matrix x / 2 - right x with x >= 0 but for the `free` ones, (size,).

    matrix : (size, size), positive definite;  right : (size,);  free : (size,), true where any sign may be
    inside : (size,), true where an unknown is likely not held at 0
    """
    from scipy.linalg import cho_factor, cho_solve
    from scipy.optimize import nnls

    size = right.size
    inside, found = inside | free, np.zeros(size)
    fewest, tries = size + 1, TRIES
    for _ in range(MOST):
        found[:] = 0.0
        part = np.ix_(inside, inside)
        found[inside] = cho_solve(cho_factor(matrix[part], check_finite=False), right[inside], check_finite=False)
        slope = matrix @ found - right
        below = inside & ~free & (found < -CLOSE * np.max(np.abs(found)))
        uphill = ~inside & (slope < -CLOSE * np.max(np.abs(right)))
        wrong = np.flatnonzero(below | uphill)
        if not wrong.size:
            break
        if wrong.size < fewest:
            fewest, tries = wrong.size, TRIES
        elif tries:
            tries -= 1
        else:
            wrong = wrong[-1:]
        inside[wrong] = ~inside[wrong]
    else:
        root = np.linalg.cholesky(matrix)
        both = np.concatenate([root.T, -root.T[:, free]], axis=1)
        twice, _ = nnls(both, np.linalg.solve(root, right), maxiter=100 * size)
        found = twice[:size]
        found[free] -= twice[size:]
    return np.where(free, found, np.maximum(found, 0.0))
