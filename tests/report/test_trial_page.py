"""A kept study: its page from small files alone, and any of its trials once more, by its seed."""

import re
import shutil

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.commands.report import report
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.study import summarise, write_report
from hysteresis_bench.report.trial.page import write_trial_page
from hysteresis_bench.report.trials.ioh import write_ioh
from hysteresis_bench.study.kept_files.courses import COURSES
from hysteresis_bench.study.results import RESPONSES, read_results
from hysteresis_bench.study.run import run_study
from tests.report.links import parsed

STUDY = """
title = "two searches"
seed = 3
trials = 2
budget = 60
instances = 2
reference = "pso"
[[problem]]
name = "static"
rig = "sma"
fitted = ["pwm-50s"]
held_out = ["pwm-60s"]
model = "jiles-atherton"
[[optimizer]]
plugin = "pso"
settings = { particles = 10 }
[[optimizer]]
plugin = "random-search"
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    file = tmp_path_factory.mktemp("studies") / "two.toml"
    file.write_text(STUDY, encoding="utf-8")
    return run_study(file, jobs=1, out=file.parent / "run")


@pytest.fixture(scope="module")
def kept(run):
    told = CliRunner().invoke(report, [str(run), "--keep", str(run.parent / "kept")])
    assert told.exit_code == 0, told.output
    return run.parent / "kept"


def test_what_is_kept_has_the_searches(run, kept):
    ours, theirs = read_results(kept), read_results(run)
    assert not (kept / "trials.sqlite").exists()
    assert ours.traces.keys() == theirs.traces.keys()
    assert not ours.damages
    for key, trace in theirs.traces.items():
        assert np.array_equal(ours.traces[key].evaluations, trace.evaluations)
        assert ours.traces[key].losses == pytest.approx(trace.losses, rel=1e-6)
    assert summarise(ours).equals(summarise(theirs))


def test_a_fresh_copy_of_what_is_kept_writes_the_same_page(kept, tmp_path):
    page = (kept / "report.html").read_text(encoding="utf-8")
    fresh = shutil.copytree(kept, tmp_path / "kept", ignore=shutil.ignore_patterns("figures", RESPONSES, "*.html"))
    assert write_report(fresh).read_text(encoding="utf-8") == page
    assert "<h2>Drive and response, loops, errors</h2>" in page
    assert "Convergence" in page or "Best fitness so far" in page
    figures = {f"figures/{figure.name}" for figure in (kept / "figures").iterdir()}
    assert not (figures | {RESPONSES}) & set(parsed(page).sources), "a link to what is not kept"


def test_a_row_leads_to_single_trials_and_a_seed_to_the_trial(kept):
    page = parsed((kept / "report.html").read_text(encoding="utf-8"))
    rows = [source for source in page.sources if source.startswith("#single-")]
    assert len(rows) == 2
    assert {row.removeprefix("#") for row in rows} <= set(page.ids)
    seeds = set(re.findall(r"\b[0-9a-f]{16}\b", (kept / "report.html").read_text(encoding="utf-8")))
    known = set(read_results(kept).trials["seed"])
    assert seeds
    assert seeds <= known


def test_a_trial_is_run_again_and_comes_to_the_same(kept):
    trial = read_results(kept).trials.iloc[-1]
    page = write_trial_page(kept, trial["seed"][:8]).read_text(encoding="utf-8")
    text = re.sub(r"<[^>]+>", " ", page)
    assert "to the last bit" in text
    assert f"--trial {trial['seed']}" in text
    assert "pwm-60s (held-out)" in text
    assert "M_s" in text


def test_a_trial_that_comes_to_something_else_is_told(kept, tmp_path):
    changed = shutil.copytree(kept, tmp_path / "kept")
    file = changed / "trials.csv"
    trial = read_results(kept).trials.iloc[0]
    file.write_text(file.read_text(encoding="utf-8").replace(repr(float(trial["fitness"])), "0.5"), encoding="utf-8")
    page = write_trial_page(changed, trial["seed"]).read_text(encoding="utf-8")
    assert "which is not what trials.csv has" in page


@pytest.mark.parametrize("seed", ["no such seed", ""])
def test_a_seed_that_names_no_single_trial_is_the_users_fault(kept, seed):
    with pytest.raises(UserError, match="--trial"):
        write_trial_page(kept, seed)


def test_damaged_courses_are_told(kept, tmp_path):
    damaged = shutil.copytree(kept, tmp_path / "kept")
    (damaged / COURSES).write_bytes((damaged / COURSES).read_bytes()[:100])
    found = read_results(damaged)
    assert not found.traces
    assert any(COURSES in damage for damage in found.damages)
    (damaged / COURSES).unlink()
    with pytest.raises(UserError, match="no searches to export"):
        write_ioh(read_results(damaged), tmp_path)
