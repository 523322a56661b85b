"""nlopt's DIRECT-L: dividing rectangles, locally biased.

[1] J. M. Gablonsky, C. T. Kelley, A locally-biased form of the DIRECT algorithm, Journal of Global
    Optimization 21 (2001) 27-37.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start


@dataclass(frozen=True)
class NloptDirectL(Optimizer):
    """Division of the box into rectangles, locally biased (DIRECT-L, nlopt); deterministic.

    Bounds: it samples centres of rectangles inside the box. The shared first points do not enter, and a
    restart would repeat it: it divides further until the budget is spent.
    """

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import Search

        search = Search("GN_DIRECT_L", objective, rng)
        # sizes its memory: above what the budget affords, so that the meter stops it
        search.nlopt.set_maxeval(2 * objective.budget + 1000)
        search.run(start(1)[:, 0])
