"""The response as an array that an effect may overwrite: the kernels of effects act in place."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Signal


def own(response: Array, signal: Signal) -> Array:
    """The response itself, or a copy where it is read-only, not in order, or shares memory with the input."""
    usable = response.flags.writeable and response.flags.c_contiguous and response.dtype == np.float64
    if usable and not np.may_share_memory(response, signal.input):
        return response
    return np.array(response, dtype=float, order="C")
