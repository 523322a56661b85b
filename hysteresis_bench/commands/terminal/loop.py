"""A loop in the terminal, drawn with Braille dots: two across and four down a character."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array

BRAILLE = 0x2800
BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
"""Of the dots of a character, by row and column."""


def drawn(curves: Sequence[tuple[Array, Array]], width: int = 60, height: int = 14) -> str:
    """Curves as lines of characters; a curve is x and y, (samples,) each."""
    x, y = (np.concatenate([curve[axis] for curve in curves]) for axis in (0, 1))
    dots = np.zeros((4 * height, 2 * width), dtype=bool)
    for one, other in curves:
        steps = max(2, 8 * width * 4 // max(one.size, 1) + 1)
        at = np.linspace(0, one.size - 1, (one.size - 1) * steps + 1)
        index = np.arange(one.size)
        columns = _scaled(np.interp(at, index, one), x, dots.shape[1])
        rows = dots.shape[0] - 1 - _scaled(np.interp(at, index, other), y, dots.shape[0])
        dots[rows, columns] = True
    cells = dots.reshape(height, 4, width, 2).transpose(0, 2, 1, 3)
    codes = BRAILLE + (cells * BITS).sum(axis=(2, 3))
    return "\n".join("".join(map(chr, line)) for line in codes)


def _scaled(values: Array, whole: Array, size: int) -> Array:
    spread = float(np.ptp(whole)) or 1.0
    return np.asarray((values - float(whole.min())) / spread * (size - 1), dtype=int)
