"""Does the selected system predict an excitation that it did not see? Where it does worse than the bare model, it is
not the one that is written.

Every fitted record is left out in turn. The bare model, and the systems that grow from it by one adopted effect
after the other, are fitted to the other records and predict it. Held-out records have no part in this.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis


@dataclass(frozen=True)
class Fallback:
    """What was given up. dropped : names, in the order in which they had been adopted
    selected, kept, bare : RMSE on records left out, of what had been selected, of what is kept, of the bare model
    """

    dropped: tuple[str, ...]
    selected: float
    kept: float
    bare: float


Grown = Sequence[tuple[str, Hypothesis]]


def fall_back(fitter: Fitter, base: Hypothesis, order: Grown) -> Fallback | None:
    """None where the last system predicts no worse than the bare model, or where nothing can be left out.

    order : the adopted effects, each with the system that it completes, the last one the selected system
    """
    if len(fitter.stack.records) < 2 or not order:
        return None
    selected = unseen_rmse(fitter, order[-1][1])
    bare = unseen_rmse(fitter, base)
    if selected <= bare:
        return None
    errors = [bare, *(unseen_rmse(fitter, system) for _, system in order[:-1])]
    kept = int(np.argmin(errors))
    return Fallback(tuple(name for name, _ in order[kept:]), selected, errors[kept], bare)


def unseen_rmse(fitter: Fitter, hypothesis: Hypothesis) -> float:
    """RMSE over all fitted records, each predicted by a fit to the others; of a lone record, over its blocks."""
    return float(np.sqrt(np.mean(fitter.unseen(hypothesis) ** 2)))


def predicting(fitter: Fitter, hypotheses: list[Hypothesis], worse: float) -> list[Hypothesis]:
    """Without those that predict records left out worse than the best of them, by this share of their mean square."""
    if len(hypotheses) < 2 or len(fitter.stack.records) < 2:
        return hypotheses
    squares = [unseen_rmse(fitter, hypothesis) ** 2 for hypothesis in hypotheses]
    return [one for one, square in zip(hypotheses, squares, strict=True) if (1.0 - worse) * square <= min(squares)]
