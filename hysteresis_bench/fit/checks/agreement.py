"""Do two searches from other starts agree?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.objective import Problem

AGREE = 0.01
"""Two searches agree when neither's RMSE is more than 1 % above the other's, and their simulated outputs
differ by less than 1 % of the measured range (RMS)."""


def agreement_of(problem: Problem, found: Sequence[Array], losses: Sequence[float]) -> tuple[bool, str]:
    """Whether they do, and a sentence that says how closely. found : (dimension,) of each search;  losses : of them"""
    difference = np.diff(problem.residuals(problem.space.to_unit(np.column_stack(found))))
    spread = max(float(np.ptp(record.measured)) for record in problem.records) or 1.0
    apart = float(np.sqrt(np.mean(difference**2))) / spread
    ratio = max(losses) / (min(losses) or 1e-300)
    if ratio > 1 + AGREE and max(losses) > 1e-9 * problem.scale:
        return False, (
            f"Two searches from other starts do NOT agree: their RMSE differ by {100 * (ratio - 1):.3g} %. "
            f"The better one is shown; a larger budget or narrower bounds may find a better one still."
        )
    if apart > AGREE:
        return False, (
            f"Two searches from other starts fit equally well but do NOT agree: their outputs differ by "
            f"{100 * apart:.2g} % of the range (RMS)."
        )
    close = f"their outputs differ by {100 * apart:.2g} % of the range (RMS)" if apart > 1e-6 else "they found the same"
    return True, f"Two searches from other starts agree: {close}."
