"""Instances of a rig: drawn reproducibly, shared by all optimizers, continued without computing anything again."""

import itertools
import tomllib

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.report.study import write_report
from hysteresis_bench.report.trials.summary import problems
from hysteresis_bench.study.execution.shards import Shard
from hysteresis_bench.study.execution.trial import tickets_of
from hysteresis_bench.study.instances import drawn_constants, ranges_of
from hysteresis_bench.study.problems import dataset_of
from hysteresis_bench.study.results import TRIALS, read_results
from hysteresis_bench.study.run import RunOptions, run_study
from hysteresis_bench.study.store import FILE, Store
from hysteresis_bench.study.study_file import ProblemSpec, check_study

TEXT = """
title = "t"
seed = 1
trials = 1
budget = 20
instances = 2
[[problem]]
name = "p"
rig = "sma"
fitted = ["pwm-60s"]
model = "jiles-atherton"
rig_settings = { latent_heat = 0.0 }
ranges = { wire_lag = [2.0, 5.0] }
[[optimizer]]
plugin = "random-search"
[[optimizer]]
plugin = "pso"
"""
PROBLEM = {
    "name": "p", "rig": "sma", "fitted": ["pwm-60s"], "model": "jiles-atherton",
    "rig_settings": {"latent_heat": 0.0}, "ranges": {"wire_lag": [2.0, 5.0]},
}  # fmt: skip


def test_the_first_instance_is_the_rig_as_it_stands(tmp_path):
    spec = ProblemSpec(**PROBLEM)
    plain = spec.model_copy(update={"ranges": {}})
    assert drawn_constants(spec, 1, 1) == {}
    one, other = (dataset_of(each, 1, tmp_path).records[0] for each in (spec, plain))
    assert np.array_equal(one.output, other.output)


def test_what_is_drawn_depends_on_seed_rig_and_number_alone():
    spec = ProblemSpec(**PROBLEM)
    alike = spec.model_copy(update={"name": "q", "model": "bouc-wen", "ranges": {"wire_lag": (2.0, 5.0)}})
    assert drawn_constants(spec, 1, 7) == drawn_constants(alike, 1, 7)
    assert drawn_constants(spec, 1, 7) != drawn_constants(spec, 1, 8)
    assert 2.0 <= drawn_constants(spec, 1, 7)["wire_lag"] <= 5.0
    assert "latent_heat" not in ranges_of(spec)  # the study sets it


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """A study of two instances that went on with a second trial, then with a third instance."""
    home = tmp_path_factory.mktemp("instances")
    path, out = home / "t.toml", home / "out"
    path.write_text(TEXT, encoding="utf-8")
    tables = []
    for trials, instances in ((1, 2), (2, 2), (2, 3)):
        run_study(path, trials=trials, jobs=1, out=out, options=RunOptions(instances=instances))
        tables.append(read_results(out).trials)
    return out, tables


def test_more_trials_and_more_instances_compute_nothing_again(ran):
    _, tables = ran
    assert [len(table) for table in tables] == [4, 8, 12]
    key = ["problem", "optimizer", "instance", "trial"]
    for before, after in itertools.pairwise(tables):
        both = before.merge(after, on=key, suffixes=("", "_after"))
        assert len(both) == len(before)
        assert (both["seconds"] == both["seconds_after"]).all()


def test_an_instance_is_a_block_with_its_own_best_known(ran):
    out, _ = ran
    [problem] = problems(read_results(out))
    assert (problem.instances, problem.counted) == ([1, 2, 3], "3 instances")
    assert [trials.size for trials in problem.sample("pso").instances] == [2, 2, 2]
    rows = pd.concat(problem.rows.values())
    assert problem.best == rows.groupby("instance")["fitness"].min().to_dict()
    assert "The rig: which constants were chosen how" in write_report(out).read_text(encoding="utf-8")


def test_shards_share_the_trials_of_every_optimizer(tmp_path):
    study = check_study(tomllib.loads(TEXT.replace("instances = 2", "instances = 6")), "t.toml")
    tickets = tickets_of(study, tmp_path, 2)
    assert len({ticket.key for ticket in tickets}) == len(tickets) == 24
    parts = [Shard(number, 2).of_tickets(tickets) for number in (1, 2)]
    assert sorted(ticket.key for part in parts for ticket in part) == sorted(ticket.key for ticket in tickets)
    assert all(sum(ticket.optimizer == "pso" for ticket in part) == 6 for part in parts)


def test_a_problem_may_have_fewer_trials_than_the_study_is_asked_for(tmp_path):
    dear = TEXT.replace('name = "p"', 'name = "q"\nmost_trials = 2')
    both = TEXT.replace(
        "[[optimizer]]", dear[dear.index("[[problem]]") : dear.index("[[optimizer]]")] + "[[optimizer]]", 1
    )
    study = check_study(tomllib.loads(both), "t.toml")
    for asked, of_q in ((1, 1), (2, 2), (5, 2)):
        trials = [(ticket.problem, ticket.trial) for ticket in tickets_of(study, tmp_path, asked)]
        assert sorted(set(trials)) == [("p", i) for i in range(asked)] + [("q", i) for i in range(of_q)]
    assert study.identity() == check_study(tomllib.loads(both.replace("most_trials = 2\n", "")), "t.toml").identity()


def test_a_folder_of_one_instance_is_kept_as_before(tmp_path):
    path = tmp_path / "t.toml"
    path.write_text(TEXT.replace("instances = 2\n", ""), encoding="utf-8")
    out = run_study(path, jobs=1, out=tmp_path / "out")
    assert "instance" not in pd.read_csv(out / TRIALS).columns
    (out / FILE).unlink()
    assert list(read_results(out).trials["instance"]) == [1, 1]


def test_an_instance_that_cannot_be_simulated_fails_in_its_block(tmp_path):
    path = tmp_path / "t.toml"
    impossible = TEXT.replace("wire_lag = [2.0, 5.0]", "martensite_start = [17.0, 200.0]")
    path.write_text(impossible.replace("instances = 2", "instances = 4"), encoding="utf-8")
    with pytest.raises(UserError, match=r"martensite_start = 200\.0"):
        run_study(path, jobs=1, out=tmp_path / "none")
    both = "martensite_start = [16.0, 20.5], austenite_finish = [26.5, 30.0]"
    path.write_text(TEXT.replace("wire_lag = [2.0, 5.0]", both).replace("instances = 2", "instances = 8"), "utf-8")
    out = run_study(path, jobs=1, out=tmp_path / "out")
    with Store.reading(out) as store:
        ended = list(store.outcomes())
    failed = [outcome for outcome in ended if outcome.status == "raised"]
    assert 0 < len(failed) < len(ended)
    assert all(f"instance {outcome.instance} cannot be simulated" in outcome.reason for outcome in failed)
    page = write_report(out).read_text(encoding="utf-8")
    assert "cannot be simulated" in page


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"instances": 3}, "measured data are one instance"),
        ({"ranges": {"a": [1.0, 2.0]}}, "measured data are one instance"),
    ],
)
def test_measured_data_have_no_instances(change, told):
    problem = {"name": "p", "data": ["a.csv"], "model": "bouc-wen"} | change
    with pytest.raises(UserError, match=told):
        check_study({"title": "t", "seed": 1, "problem": [problem], "optimizer": [{"plugin": "pso"}]}, "t.toml")


@pytest.mark.parametrize(
    ("ranges", "told"),
    [
        ({"wire_lags": [1.0, 2.0]}, "wire_lag"),
        ({"wire_lag": [5.0, 2.0]}, "5.0 must be below 2.0"),
        ({"wire_lag": [-1.0, 2.0]}, "must not be negative"),
    ],
)
def test_ranges_that_make_no_rig_are_told(ranges, told):
    raw = {"title": "t", "seed": 1, "problem": [PROBLEM | {"ranges": ranges}], "optimizer": [{"plugin": "pso"}]}
    with pytest.raises(UserError, match=told):
        check_study(raw, "t.toml")
