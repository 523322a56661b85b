"""Bouc-Wen, one sample on; state: started, u, h; constants: alpha, beta, gamma, d, n."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.bouc_wen_inverse import inverted
from hysteresis_bench.kernels.bouc_wen_step import moved


def law(s: Array, p: Array, t: float, u: float) -> float:
    if s[0] != 0.0:
        s[2] = moved(s[2], u - s[1], p[0] * p[3], p[1], p[2], p[4], np.inf)
    s[0] = 1.0
    s[1] = u
    return p[3] * u - s[2]


def inverse(s: Array, p: Array, v: float) -> float:
    if s[0] == 0.0:
        s[1] = v / p[3]
    else:
        s[1], s[2] = inverted(s[1], s[2], v, p[0], p[1], p[2], p[3], p[4])
    s[0] = 1.0
    return s[1]


def unbounded(p: Mapping[str, float]) -> str:
    """Why h has no bound, as `kernels.bouc_wen.bounded` has it; else ""."""
    sign, rate = ("+", p["beta"] + p["gamma"]) if p["alpha"] * p["d"] >= 0.0 else ("-", p["beta"] - p["gamma"])
    return f"with beta or beta {sign} gamma below 0 its hysteresis has no bound" if min(p["beta"], rate) < 0.0 else ""


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    """Raises ValueError where h has no bound: the model cuts it by the length of the whole record."""
    if reason := unbounded(p):
        raise ValueError(reason)
    constants = (p["alpha"], p["beta"], p["gamma"], p["d"], float(model.n))
    steepest = p["alpha"] * max(1.0, 2.0 * p["beta"] / (p["beta"] + p["gamma"])) if p["beta"] > 0.0 else np.inf
    return Part(constants, state=3, invertible=bool(p["d"] > 0.0 and p["alpha"] >= 0.0 and steepest < 1.0))
