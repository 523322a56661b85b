"""Rayleigh's law: parabolic loops within loops, with the memory of every turning point that still counts."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def rayleigh(u: Array) -> Array:
    """The irreversible part of Rayleigh's law for a unit coefficient.

    Rate-independent: the order of samples matters, their times do not. Exact for an input that is monotone
    between its samples. Zero at the first sample, from where the virgin curve starts.

    u : float64[samples, columns]     input, any unit
    -> float64[samples, columns]      unit of u, squared

    [1]  virgin curve  r = ± (u - u_0)² / 2;  after a turn at (u_t, r_t)  r = r_t ± (u - u_t)² / 4
    A branch that comes back to where it was left goes on as if nothing had happened (Madelung's rules). The same
    as the integral of play operators over all half-widths [2], which is what the tests compare with.
    [1] Lord Rayleigh, Phil. Mag. 23 (1887) 225.
    [2] M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, Springer (1996), chapter 2.
    """
    samples, columns = u.shape
    out = np.empty((samples, columns))
    turn, value = np.empty(samples + 1), np.empty(samples + 1)  # turning points not yet wiped out, outermost first
    for j in range(columns):
        origin, before, r = u[0, j], u[0, j], 0.0
        depth, direction = 0, 0.0
        out[0, j] = 0.0
        for i in range(1, samples):
            now = u[i, j]
            if now != before:
                heading = 1.0 if now > before else -1.0
                if heading * direction < 0.0:
                    turn[depth], value[depth] = before, r
                    depth += 1
                direction = heading
                while depth > 0:
                    # the first turn closes at its mirror image on the virgin curve
                    close = turn[depth - 2] if depth > 1 else 2.0 * origin - turn[0]
                    if heading * (now - close) < 0.0:
                        break
                    depth = max(depth - 2, 0)
                if depth == 0:
                    r = 0.5 * (now - origin) * abs(now - origin)
                else:
                    r = value[depth - 1] + 0.25 * heading * (now - turn[depth - 1]) ** 2
                before = now
            out[i, j] = r
    return out
