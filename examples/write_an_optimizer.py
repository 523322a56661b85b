"""Write an optimizer, registered in examples/pyproject.toml, and run it against others on one problem."""

from dataclasses import dataclass
from pathlib import Path

from hysteresis_bench import run_study
from hysteresis_bench.contracts import Optimizer

STUDY = """
title = "Does a shrinking box beat a swarm?"
seed = 3
trials = 5
budget = 2000
problem = [{ name = "loop", rig = "hidden-effects", fitted = ["nested"], model = "bouc-wen" }]
optimizer = [{ plugin = "halving-search" }, { plugin = "pso-constriction" }, { plugin = "random-search" }]
"""


@dataclass(frozen=True)
class HalvingSearch(Optimizer):
    """Uniform random points around the best so far, in a box that shrinks."""

    particles: int = 50
    shrink: float = 0.9

    def search(self, objective, start, rng):
        points, width, lowest = start(self.particles), 1.0, float("inf")
        while True:  # the meter ends it: an exception leaves through here when the budget is spent
            losses = objective.many(points)
            if losses.min() < lowest:
                lowest, best = losses.min(), points[:, losses.argmin()].copy()
            width *= self.shrink
            points = (best[:, None] + width * (rng.random(points.shape) - 0.5)).clip(0.0, 1.0)


if __name__ == "__main__":
    Path("halving.toml").write_text(STUDY, encoding="utf-8")
    results = run_study("halving.toml")
    print(results.trials.groupby("optimizer")["relative_rms"].median().sort_values().to_string())
