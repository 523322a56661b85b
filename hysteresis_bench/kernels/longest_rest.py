"""How long a signal stays where it is."""

from __future__ import annotations

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array


@njit(cache=True, error_model="numpy")
def longest_rest(time: Array, u: Array, width: float) -> float:
    """The longest time within which the signal moves by no more than the width.

    time : float64[samples]          rising
    u : float64[samples]             any unit
    width : unit of u, >= 0          between the highest and the lowest sample of a rest
    -> unit of time

    A window over the samples; where it may begin the highest and the lowest are kept, each followed by what is highest
    or lowest after it, so that every sample is looked at twice at most.
    """
    high, low = np.empty(u.size, dtype=np.int64), np.empty(u.size, dtype=np.int64)
    first_high = first_low = last_high = last_low = 0
    begin, longest = 0, 0.0
    for i in range(u.size):
        while last_high > first_high and u[high[last_high - 1]] <= u[i]:
            last_high -= 1
        while last_low > first_low and u[low[last_low - 1]] >= u[i]:
            last_low -= 1
        high[last_high], low[last_low] = i, i
        last_high, last_low = last_high + 1, last_low + 1
        while u[high[first_high]] - u[low[first_low]] > width:
            begin += 1
            first_high += high[first_high] < begin
            first_low += low[first_low] < begin
        longest = max(longest, time[i] - time[begin])
    return longest
