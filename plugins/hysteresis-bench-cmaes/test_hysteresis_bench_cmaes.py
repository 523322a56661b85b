"""bipop-cmaes keeps its contract, and its restarts do what the paper says."""

import numpy as np

from hysteresis_bench.testing import OptimizerContract
from hysteresis_bench_cmaes import BipopCmaes


class TestBipopCmaes(OptimizerContract):
    plugin = "bipop-cmaes"


class Flat:
    """A loss without a slope: every run of CMA-ES stops after a few iterations, and what is asked is kept."""

    dimension, budget = 3, 20_000

    def __init__(self):
        self.evaluations, self.populations = 0, []

    def many(self, points):
        if self.evaluations > self.budget:
            raise StopIteration
        self.evaluations += points.shape[1]
        self.populations.append(points.shape[1])
        return np.zeros(points.shape[1])


def test_one_regime_doubles_its_population_and_the_other_stays_below():
    flat = Flat()
    try:
        BipopCmaes().search(flat, lambda n: np.full((3, n), 0.5), np.random.default_rng(0))
    except StopIteration:
        sizes = list(dict.fromkeys(flat.populations))
    assert {7, 14, 28, 56, 112} <= set(sizes)
    assert any(size not in {7 * 2**i for i in range(20)} for size in sizes)
    large = [size for size in sizes if size in {7 * 2**i for i in range(1, 20)}]
    assert large == sorted(large)
