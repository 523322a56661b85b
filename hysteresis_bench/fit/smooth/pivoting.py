"""Non-negative least squares of a definite system, by block principal pivoting.

Unknowns are dealt into those that are free and those that are held at 0; every one on the wrong side is exchanged at
once [1], and where that does not lessen how many are wrong, the worse half of them. Ours: [1] then exchange the last
of them alone, which took ten times as many exchanges where few unknowns of many are not 0.

[1] L. F. Portugal, J. J. Judice, L. N. Vicente, Mathematics of Computation 63 (1994) 625; J. Kim, H. Park, SIAM J.
    Scientific Computing 33 (2011) 3261.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

MOST = 100
"""Exchanges; where they go round in circles, Lawson's and Hanson's method ends it."""
CLOSE = 1e-12
"""Share of the largest, below which a value or a slope counts as 0."""


def least_above(matrix: Array, right: Array, free: Array, inside: Array) -> Array:
    """The least of x matrix x / 2 - right x with x >= 0 but for the `free` ones, (size,).

    matrix : (size, size), positive definite;  right : (size,);  free : (size,), true where any sign may be
    inside : (size,), true where an unknown is likely not held at 0
    """
    from scipy.linalg.lapack import dposv

    from hysteresis_bench.kernels.exchanges import part_of, wrong_sides

    inside, found, fewest = inside | free, np.zeros(right.size), right.size + 1
    for _ in range(MOST):
        places = np.flatnonzero(inside)
        found[:] = 0.0
        _, found[places], flaw = dposv(part_of(matrix, places).T, right[places], lower=True, overwrite_a=True)
        if flaw:  # of rounding: it is not definite
            break
        slope, below, uphill = wrong_sides(matrix, right, free, inside, found, CLOSE)
        wrong = below.size + uphill.size
        if not wrong:
            return np.where(free, found, np.maximum(found, 0.0))
        if wrong >= fewest:
            below, uphill = _worse_half(below, found), _worse_half(uphill, slope)
        fewest = min(fewest, wrong)
        inside[below], inside[uphill] = False, True
    return _by_single_steps(matrix, right, free)


def _worse_half(wrong: Array, how: Array) -> Array:
    """Places of the lowest ones, half of them and at least one;  wrong : (some,) places;  how : (size,)"""
    found: Array = wrong[np.argsort(how[wrong])[: (wrong.size + 1) // 2]]
    return found


def _by_single_steps(matrix: Array, right: Array, free: Array) -> Array:
    """By Lawson's and Hanson's method, what is free as the difference of two."""
    from scipy.optimize import nnls

    root = np.linalg.cholesky(matrix)
    both = np.concatenate([root.T, -root.T[:, free]], axis=1)
    twice, _ = nnls(both, np.linalg.solve(root, right), maxiter=100 * right.size)
    found: Array = twice[: right.size]
    found[free] -= twice[right.size :]
    return found
