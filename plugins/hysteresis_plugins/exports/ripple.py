"""What repeats itself along a course; constants: 2 pi over its period, amplitudes of the first and second harmonic."""

from __future__ import annotations

import math
from collections.abc import Mapping

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part


def ripple_at(p: Array, x: float) -> float:
    """What is added at x of the course."""
    sine = math.sin(p[0] * x)
    cosine = math.cos(p[0] * x)
    return p[1] * sine + p[2] * cosine + p[3] * (2.0 * sine * cosine) + p[4] * (1.0 - 2.0 * sine * sine)


def part_of(p: Mapping[str, float]) -> Part | None:
    first = complex(p["sine"], p["cosine"])
    second = first * complex(p["second"], p["second_aside"])
    return Part((2.0 * math.pi / p["period"], first.real, first.imag, second.real, second.imag)) if first else None
