"""Trials say what they were made with, and a store of before still opens."""

import json
import sqlite3
from dataclasses import replace

import pytest

from hysteresis_bench import registry
from hysteresis_bench.report.study import write_report
from hysteresis_bench.study.origin import made_with, mixed, origin
from hysteresis_bench.study.store import FILE, Outcome, Store
from tests.synthetic_study import write_results

OUTCOME = Outcome("p", "pso", 0, "0", "done", "", 10, 0.5)


def test_an_origin_names_processor_versions_and_other_distributions():
    plugins = [registry.load("models", "polynomial"), registry.load("optimizers", "pso")]
    made_by = json.loads(origin(plugins))
    assert {"processor", "python", "numpy", "hysteresis-bench"} <= set(made_by)
    assert made_by["hysteresis-test-plugins"] == "0.1"


def test_what_differs_between_trials_is_told_and_nothing_else():
    one, other = ({"numpy": version, "scipy": "1.14"} for version in ("2.0", "2.1"))
    guest = {**one, "guest": "3"}
    made_by = [*[one] * 4, *[other] * 2, guest]
    origins = {("p", "pso", 1, number): each for number, each in enumerate(made_by)}
    assert mixed(origins) == ("Trials were not all made with the same numpy: 5 with 2.0, 2 with 2.1.",)
    groups = {words: [number for *_, number in trials] for words, trials in made_with(origins).items()}
    assert groups == {"numpy 2.0": [0, 1, 2, 3, 6], "numpy 2.1": [4, 5]}
    assert mixed({("p", "pso", 0): one, ("p", "pso", 1): guest}) == ()
    assert made_with({("p", "pso", 0): one}) == {}


@pytest.mark.long
def test_the_report_tells_trial_by_trial_what_differs(tmp_path):
    folder = write_results(tmp_path / "results", trials=2)
    with sqlite3.connect(folder / FILE) as store:
        store.execute('UPDATE trials SET origin = \'{"numpy": "2.0"}\'')
        store.execute("UPDATE trials SET origin = '{\"numpy\": \"2.1\"}' WHERE optimizer = 'mpso' AND trial = 1")
    store.close()
    page = " ".join(write_report(folder).read_text(encoding="utf-8").split())
    assert "Trials were not all made with the same numpy: 30 with 2.0, 2 with 2.1." in page
    assert "numpy 2.1" in page


def test_the_store_keeps_origins_and_gives_back_what_it_was_given(tmp_path):
    with Store(tmp_path) as store:
        store.begin("t")
        store.add(replace(OUTCOME, origin='{"numpy": "2.0"}'))
        store.add(replace(OUTCOME, trial=1, status="killed"))
        assert store.origins() == {("p", "pso", 1, 0): {"numpy": "2.0"}}
        assert next(store.outcomes()) == replace(OUTCOME, origin='{"numpy": "2.0"}')
        assert store.forget(["killed", "not-started"]) == 1
        assert store.keys() == {("p", "pso", 1, 0)}


def test_a_store_of_before_is_read_and_continued(tmp_path):
    """One that kept neither origins nor instances."""
    connection = sqlite3.connect(tmp_path / FILE)
    with connection:
        connection.execute("CREATE TABLE study (title TEXT NOT NULL)")
        connection.execute(
            "CREATE TABLE trials (problem TEXT, optimizer TEXT, trial INTEGER, seed TEXT, status TEXT, reason TEXT, "
            "evaluations INTEGER, fitness REAL, rmse REAL, relative_rms REAL, max_error REAL, held_out_rmse REAL, "
            "seconds REAL, parameters TEXT, trace BLOB, PRIMARY KEY (problem, optimizer, trial))"
        )
        connection.execute(
            "INSERT INTO trials (problem, optimizer, trial, seed, status, reason, evaluations, fitness, parameters) "
            "VALUES ('p', 'pso', 0, '0', 'done', '', 10, 0.5, '{}')"
        )
    connection.close()
    with Store(tmp_path) as store:
        assert store.origins() == {}
        assert list(store.outcomes()) == [OUTCOME]
        assert len(store.table()) == 1
        store.begin("t")
        store.add(replace(OUTCOME, trial=1, origin='{"numpy": "2.0"}'))
        assert len(store.table()) == 2
        store.add(replace(OUTCOME, instance=2))
        assert store.keys() == {("p", "pso", 1, 0), ("p", "pso", 1, 1), ("p", "pso", 2, 0)}
        assert store.origins() == {("p", "pso", 1, 1): {"numpy": "2.0"}}
