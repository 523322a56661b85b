"""Curves of straight pieces of play operators, one sample on; state: started, then where every play is.

Constants: plays, pieces, slope, the half-widths, the nodes, the weights, play by play.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.play import played


def law(s: Array, p: Array, t: float, u: float) -> float:
    plays: int = int(p[0])
    pieces: int = int(p[1])
    nodes: int = 3 + plays
    weights: int = nodes + pieces + 1
    y = p[2] * u
    for k in range(plays):
        s[1 + k] = u if s[0] == 0.0 else played(u, p[3 + k], s[1 + k])
        for j in range(pieces):
            if s[1 + k] <= p[nodes + j]:
                break
            share = (s[1 + k] - p[nodes + j]) / (p[nodes + j + 1] - p[nodes + j])
            y += p[weights + k * pieces + j] * min(share, 1.0)
    s[0] = 1.0
    return y


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    shape = {name: np.array([p[name]]) for name in ("radius", "centre", "grading")}
    radii, nodes = (cells[:, 0] for cells in model.cells(SimpleNamespace(**shape)))
    weights = [p[name] for name in model.linear[1:]]
    first = (float(model.plays + 1), float(model.pieces), p["slope"])
    return Part((*first, *map(float, radii), *map(float, nodes), *weights), state=model.plays + 2)
