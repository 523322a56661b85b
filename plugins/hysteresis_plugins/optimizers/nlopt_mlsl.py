"""nlopt's multi-level single linkage with low-discrepancy starts and BOBYQA descents.

[1] A. H. G. Rinnooy Kan, G. T. Timmer, Stochastic global optimization methods, Mathematical Programming 39
    (1987) 27-78.
[2] S. Kucherenko, Y. Sytsko, Application of deterministic low-discrepancy sequences in global optimization,
    Computational Optimization and Applications 30 (2005) 297-318.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy.random import Generator

from hysteresis_bench.contracts import Objective, Optimizer, Start
from hysteresis_plugins.optimizers._settings import between


@dataclass(frozen=True)
class NloptMlsl(Optimizer):
    """Descents by BOBYQA from low-discrepancy points, one a basin as far as it can tell (MLSL-LDS, nlopt).

    tolerance : a descent ends when its steps are this small, as a share of a parameter's range

    Bounds: the methods' own, kept exactly. It begins descents until the budget is spent.
    """

    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        between(1e-14, 0.5, tolerance=self.tolerance)

    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        from hysteresis_plugins.optimizers._nlopt import Search

        search = Search("GN_MLSL_LDS", objective, rng)
        descent = Search("LN_BOBYQA", objective, rng)
        descent.nlopt.set_xtol_abs(self.tolerance)
        search.nlopt.set_local_optimizer(descent.nlopt)
        search.run(start(1)[:, 0])
