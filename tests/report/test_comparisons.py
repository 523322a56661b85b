"""Verdicts in tables: beside a best that these trials chose, where test and A12 disagree; searches cut short."""

import io
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hysteresis_bench import statistics
from hysteresis_bench.report.searches.pairwise import matrices
from hysteresis_bench.report.study.console import print_summary
from hysteresis_bench.report.study.optimizers import table as optimizers_table
from hysteresis_bench.report.study.words import winners
from hysteresis_bench.report.trials.anytime import anytime
from hysteresis_bench.report.trials.summary import problems, summary_of
from hysteresis_bench.report.trials.targets import section
from hysteresis_bench.study.results import read_results
from tests.report.test_claims import problem
from tests.synthetic_study import write_results

STUDIES = 100
MOST = 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / STUDIES)
"""Of studies in which equal ones are told apart: the level and three standard errors."""


def test_the_best_is_compared_over_all_pairs_as_the_trials_chose_it():
    here = problem({"pso": 1.0, "a": 1.01, "b": 1.02, "c": 0.99, "d": 1.0}, instances=1, trials=30)
    values = {label: here.sample(label).blocks for label in here.labels}
    pairs = [(one, other) for i, one in enumerate(here.labels) for other in here.labels[i + 1 :]]
    alone = [statistics.wilcoxon(values[one], values[other], statistics.TIE) for one, other in pairs]
    corrected = dict(zip(map(frozenset, pairs), statistics.holm(alone), strict=True))
    for other, found in here.against_winner.items():
        assert found.p == pytest.approx(corrected[frozenset((other, here.winner))])
    against_reference = statistics.holm([statistics.wilcoxon(values[each], values["pso"]) for each in "abcd"])
    assert [found.p for found in here.against_reference.values()] == pytest.approx(against_reference)


def test_ten_identical_optimizers_are_seldom_told_apart_from_the_best_of_them():
    """The trials choose the best by its median, as a report does; corrected over nine comparisons it is told apart from
    another one in a tenth of the studies."""
    rng, wrong, before = np.random.default_rng(2), 0, 0
    for _ in range(STUDIES):
        samples = {name: statistics.Sample((rng.normal(0.0, 1.0, 30),)) for name in "abcdefghij"}
        best = min(samples, key=lambda name: np.median(samples[name].blocks))
        others = [name for name in samples if name != best]
        found = statistics.every_pair(samples)
        wrong += min(found[name, best].p for name in others) < statistics.LEVEL
        alone = [statistics.wilcoxon(samples[name].blocks, samples[best].blocks) for name in others]
        before += min(statistics.holm(alone)) < statistics.LEVEL
    assert wrong / STUDIES <= MOST
    assert wrong < before


def test_the_map_is_corrected_over_those_it_does_not_show():
    labels = ["pso", "new", *map(str, range(10))]
    here = problem(dict.fromkeys(labels, 1.0), instances=1, trials=20, noise=1e-3)
    wins = np.where(np.arange(20) % 10 < 7, 0.1, -0.1) + 1e-4 * np.arange(20)
    errors = here.rows["pso"]["relative_rms"].to_numpy() * np.exp(-wins)
    new = here.rows["new"].assign(relative_rms=errors, fitness=7 * errors**2)
    here = replace(here, rows=here.rows | {"new": new}, best={1: new["fitness"].min()})
    alone = statistics.wilcoxon(here.sample("new").blocks, here.sample("pso").blocks, statistics.TIE)
    assert alone < statistics.LEVEL < here.tested["new", "pso"].p
    assert not matrices(here, ["pso", "new"])[1].any()


@pytest.fixture
def at_odds():
    """New has 21 small wins and 19 large losses against pso, on 40 instances."""
    here = problem({"pso": 1.0, "new": 1.0}, instances=40, trials=1, noise=0.0)
    differences = np.concatenate([-0.02 - 0.001 * np.arange(21), 1.0 + 0.1 * np.arange(19)])
    errors = here.rows["pso"]["relative_rms"].to_numpy() * np.exp(differences)
    rows = here.rows["new"].assign(relative_rms=errors, fitness=7 * errors**2)
    best = {
        instance: min(float(one), float(other))
        for instance, one, other in zip(rows["instance"], rows["fitness"], here.rows["pso"]["fitness"], strict=True)
    }
    both = {"pso": here.rows["pso"], "new": rows}
    more = {"held_out_rmse": 1.0, "seconds": 1.0}
    return replace(here, rows={label: frame.assign(**more) for label, frame in both.items()}, best=best)


def test_where_test_and_a12_disagree_nobody_is_better_and_a_sentence_says_so(at_odds):
    assert at_odds.against_reference["new"].significant
    shown = optimizers_table(at_odds, summary_of([at_odds], 100))
    row = next(dict(zip(shown.header, row, strict=True)) for row in shown.cells if row[0].text == "new")
    assert row["Against reference"].text == "cannot tell"
    assert "We cannot tell which is better of new against the reference" in shown.note
    assert "the signed-rank test favours one and A12 does not" in shown.note
    assert not matrices(at_odds, ["pso", "new"])[1].any()
    assert "we cannot tell it apart from" in winners([at_odds], summary_of([at_odds], 100))[0]


def test_the_terminal_says_it_too(at_odds, monkeypatch, tmp_path):
    monkeypatch.setattr("hysteresis_bench.report.study.console.problems", lambda results: [at_odds])
    results, out = read_results(write_results(tmp_path, trials=1)), io.StringIO()
    print_summary(results, Console(file=out, width=200))
    assert "cannot tell apart" in out.getvalue()
    assert "signed-rank test favours one" in " ".join(out.getvalue().split())


def test_a_run_cut_short_of_a_schedule_for_the_whole_budget_is_signed():
    here = problem({"pso": 1.0, "mpso": 0.9, "gone": 1.1}, instances=2)
    here = replace(here, anytime={"pso": True, "mpso": False, "gone": None})
    [table] = section([here], budget=100).blocks[1:]
    assert {row[0].text for row in table.cells} == {"pso", "mpso\u00a0†", "gone"}
    assert "† Its schedule is set for the whole budget" in table.note
    assert "Whether the schedule of gone needs the budget is not known: not installed here." in table.note
    unsigned = replace(here, anytime={"pso": True, "mpso": True})
    assert section([unsigned], budget=100).blocks[1].note == ""
    without_courses = replace(here, traces={})
    assert "†" not in str(section([without_courses], budget=100).blocks[1].cells)


def test_the_optimizers_class_says_whether_its_schedule_needs_the_budget(tmp_path):
    results = read_results(write_results(tmp_path, trials=1))
    known = anytime(results)
    assert (known["mpso"], known["pso"]) == (False, True)
    assert problems(results)[0].anytime == known


def test_a_plugin_that_is_not_installed_is_no_hindrance():
    study = SimpleNamespace(optimizer=[SimpleNamespace(name="ours", plugin="never-installed")])
    made = {"optimizers": {"older, slower": {"plugin": "icpso"}, "ours": {}}}
    assert anytime(SimpleNamespace(study=study, provenance=made)) == {"older, slower": False, "ours": None}
