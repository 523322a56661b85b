"""What a fitted law remembers: closed forms of the Everett function and of densities, and what any law promises."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.fit.model_file import Estimate, FittedModel
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.inspection.memory import density, everett, fitted_range, ways
from hysteresis_bench.signals import Signal

UNITS = {"time": "s", "input": "V", "output": "um"}
ENDS = (-2.0, 3.0)


def fitted(model: str, settings: dict | None = None, **values: float) -> FittedModel:
    """A model as a fit leaves it: with the values of its example but for those that are named."""
    law = registry.build("models", model, settings or {})
    example = dict(law.example.parameters) if law.example else {}
    known = {p.name: 0.0 for p in law.parameters} | example | values
    estimates = {p.name: Estimate(known[p.name], None, "1") for p in law.parameters}
    ranges = {"ranges": {"input": list(ENDS)}}
    return FittedModel(model, settings or {}, (), {}, UNITS, estimates, data=ranges)


def test_the_everett_function_of_plays_is_their_closed_form():
    weights = {"w1": 0.5, "w2": 0.2, "w3": 0.1}
    found = everett(fitted("prandtl-ishlinskii", {"plays": 3}, radius=2.0, slope=0.7, **weights), ENDS)
    upper, lower = np.meshgrid(found.levels, found.levels, indexing="ij")
    way = upper - lower
    moved = [w * np.maximum(way - 2.0 * r, 0.0) for w, r in zip(weights.values(), (0.5, 1.0, 1.5), strict=True)]
    closed = 0.5 * (0.7 * way + sum(moved))
    np.testing.assert_allclose(found.values, np.where(way >= 0.0, closed, np.nan), atol=1e-12)


def test_its_density_is_that_of_the_thresholds():
    plays, radius, weight = 40, 2.5, 0.3
    values = {f"w{k}": weight for k in range(1, plays + 1)}
    law = fitted("prandtl-ishlinskii", {"plays": plays}, radius=radius, slope=1.0, **values)
    middles, mixed = everett(law, ENDS).density
    way = np.subtract.outer(middles, middles)
    inside = np.isfinite(mixed) & (way > 1.0) & (way < 4.0)
    assert np.mean(mixed[inside]) == pytest.approx(0.25 * weight / (radius / (plays + 1)), rel=0.02)


@pytest.mark.parametrize("model", ["bouc-wen", "jiles-atherton-clamped", "energy-based", "ferroelectric"])
def test_it_is_nothing_on_the_diagonal_and_grows_with_the_way_back(model):
    found = everett(fitted(model), ENDS).values
    np.testing.assert_allclose(np.diag(found), 0.0, atol=1e-12)
    grown = -np.diff(found, axis=1)
    assert np.all(grown[np.isfinite(grown)] >= -1e-9)
    assert found[-1, 0] > 0.0


def test_a_law_that_knows_time_has_none():
    assert everett(fitted("hammerstein"), ENDS) is None


def test_a_model_without_a_range_says_so():
    law = fitted("bouc-wen")
    assert fitted_range(law) == ENDS
    assert fitted_range(replace(law, data={})) is None


def _hats() -> dict[str, float]:
    rng = np.random.default_rng(7)
    return {"radius": 2.5, "centre": 0.5, "grading": 1.0, "slope": 0.2} | {
        f"w{k}_{j}": float(rng.uniform(0.05, 0.5)) for k in range(5) for j in range(1, 8)
    }


LAWS = {
    "prandtl-ishlinskii": ({}, {}),
    "preisach": ({}, {}),
    "preisach-hats": ({"plays": 4, "pieces": 7}, _hats()),
}


@pytest.mark.parametrize("name", LAWS)
def test_along_a_branch_plays_join_with_the_weights_of_the_density(name):
    settings, values = LAWS[name]
    law, at, step = fitted(name, settings, **values), 0.37, 1e-6
    known = np.array([[estimate.value] for estimate in law.parameters.values()])

    def slope(*way: float) -> float:
        """Of the output where the way ends."""
        end, before = way[-1], way[-1] + step * np.sign(way[-2] - way[-1])
        u = np.array([*way[:-1], before, end])[:, None]
        y = law.system.simulate(Signal(np.arange(float(u.size)), u, timed=False), known)[:, 0]
        return float((y[-1] - y[-2]) / (end - before))

    joined = slope(-2.0, 3.0, at) - slope(-2.0, 3.0, at, at + 1e-5)
    thresholds = density(law, np.array([0.0])).thresholds
    moved = [k for k, threshold in enumerate(thresholds) if 2.0 * threshold < 3.0 - at]
    weights = [density(law, np.array([at + thresholds[k]])).weights[k, 0] for k in moved]
    assert 0 < len(moved) < len(thresholds) or name == "preisach-hats"
    assert joined == pytest.approx(sum(weights), rel=1e-3)


def test_a_density_is_told_over_the_input_as_it_is_measured():
    law, places = fitted("preisach", a2_2=0.05), np.array([-1.0, 0.0, 2.0])
    turned = replace(law, preparation=Preparation(input_offset=0.5, flip=True))
    seen = density(law, np.sort(0.5 - places))
    np.testing.assert_array_equal(density(turned, places).weights, -seen.weights[:, ::-1])


def test_ways_follow_the_memory_that_is_not_wiped_out():
    assert list(ways([0.0, 2.0, -1.0, 1.0, -2.0])) == [
        (0.0, 0.0, 2.0),
        (2.0, 2.0, 0.0),
        (2.0, 0.0, -1.0),
        (-1.0, -1.0, 1.0),
        (1.0, 1.0, -1.0),
        (2.0, -1.0, -2.0),
    ]
