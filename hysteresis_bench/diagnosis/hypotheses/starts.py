"""Where the search for a new effect's own parameters begins."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.parameters import Parameter

VALUES = 48
"""Values of an effect's own parameters that are screened, in one swarm."""


def grid(parameters: list[Parameter]) -> list[dict[str, float]]:
    """Switched off; then values spread over the box, those of a linear switch denser towards its null."""
    from scipy.stats.qmc import Halton

    off = {p.name: _inside(p) if p.null is None else float(np.clip(p.null, p.lower, p.upper)) for p in parameters}
    if not parameters:
        return [{}]
    spread = Halton(len(parameters), scramble=False).random(VALUES + 1)[1:]
    return [off, *({p.name: _at(p, x) for p, x in zip(parameters, row, strict=True)} for row in spread)]


def _inside(p: Parameter) -> float:
    return float(np.sqrt(p.lower * p.upper)) if p.scaling == "log" else 0.5 * (p.lower + p.upper)


def _at(p: Parameter, x: float) -> float:
    if p.scaling == "log":
        return float(p.lower * (p.upper / p.lower) ** x)
    if p.null is None:
        return p.lower + x * (p.upper - p.lower)
    below = max(p.null - p.lower, 0.0) / (p.upper - p.lower)
    edge, share = (p.lower, (below - x) / below) if x < below else (p.upper, (x - below) / (1.0 - below))
    return float(p.null + (edge - p.null) * 10.0 ** (3.0 * (share - 1.0)))
