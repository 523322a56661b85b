"""Pairwise maps and final parameters: their numbers by hand, their colours from the palette."""

import re

import numpy as np
import pytest

from hysteresis_bench.report.searches.final_parameters import final_parameters, good_trials
from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.searches.pairwise import matrices, pairwise
from hysteresis_bench.report.shared.theme import INK, SERIES
from tests.report.test_claims import problem


def test_the_map_holds_a12_and_who_is_told_apart(tmp_path):
    here = problem({"pso": 1.0, "new": 0.5, "same": 1.0}, noise=0.0)
    labels = ["pso", "new", "same"]
    shares, apart = matrices(here, labels)
    np.testing.assert_array_equal(shares, [[np.nan, 0.0, 0.5], [1.0, np.nan, 1.0], [0.5, 0.0, np.nan]])
    assert apart.tolist() == [[False, True, False], [True, False, True], [False, True, False]]
    drawn = pairwise(tmp_path, "map", here)
    assert "var(--series-1)" in drawn.inline
    assert "var(--series-2)" in drawn.inline
    assert INK not in drawn.inline  # every colour follows the page


def test_too_few_instances_have_no_map(tmp_path):
    assert pairwise(tmp_path, "map", problem({"a": 1.0, "b": 1.1, "pso": 1.2}, instances=5)) is None


def test_the_grid_is_of_good_trials_on_the_first_instance_and_of_what_they_searched(tmp_path):
    here = problem({"pso": 1.0, "new": 1.0, "bad": 2.0}, instances=2, trials=6, noise=0.0)
    rng = np.random.default_rng(1)
    for rows in here.rows.values():
        rows["parameter.a"] = 10.0 ** rng.uniform(-4, 2, len(rows))
        rows["parameter.b"] = rng.random(len(rows))
        rows["parameter.fixed"] = 3.0
    ended = good_trials(here)
    assert list(ended.columns) == ["optimizer", "parameter.a", "parameter.b"]
    assert ended["optimizer"].value_counts().to_dict() == {"pso": 6, "new": 6}
    drawn = final_parameters(tmp_path, "grid", here, looks={"pso": Look(SERIES[0])})
    assert "12 trials" in drawn.caption
    assert "on the first instance" in drawn.caption
    assert not re.search(r"#(?!ffffff|000000)[0-9a-f]{6}", drawn.inline.replace("&#", ""))


def test_trials_that_ended_alike_have_no_grid(tmp_path):
    here = problem({"pso": 1.0, "new": 1.0}, instances=2, trials=6, noise=0.0)
    for rows in here.rows.values():
        for name in ("parameter.a", "parameter.b"):
            rows[name] = 5.0 + 1e-3 * np.arange(len(rows))
    assert len(good_trials(here).columns) == 3
    assert final_parameters(tmp_path, "grid", here, looks={}) is None


@pytest.mark.parametrize("trials", [1, 6])
def test_few_trials_or_one_parameter_have_no_grid(tmp_path, trials):
    here = problem({"pso": 1.0, "new": 1.0}, instances=2, trials=trials, noise=0.0)
    for rows in here.rows.values():
        rows["parameter.a"] = np.arange(len(rows)) + 1.0
        if trials == 1:
            rows["parameter.b"] = np.arange(len(rows)) + 2.0
    assert final_parameters(tmp_path, "grid", here, looks={}) is None
