"""What follows a static problem on every trial: a row each, nothing computed twice, claims judged on it."""

import tomllib
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.control.bench import FEED_FORWARD, SLIDING
from hysteresis_bench.report.paper.claims import HOLDS, NOT_STAGED, UNDECIDED, judge, sentences
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.report.shared.text import number
from hysteresis_bench.report.stages.figures import feed_forward_figure, loop_figures, stage_figures
from hysteresis_bench.report.trials.summary import problems
from hysteresis_bench.study.afterwards import staged_trials, stages
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.results import STAGED_COLUMNS, STAGED_TRIALS, read_results
from hysteresis_bench.study.study_file import check_study
from hysteresis_plugins.rigs.pea_known_truth import PUBLISHED
from tests.synthetic_study import PROBLEMS, write_results

STUDY_TEXT = """
title = "t"
seed = 1
[[problem]]
name = "static"
rig = "pea"
fitted = ["static-sine"]
model = "bouc-wen"
[[optimizer]]
plugin = "pso"
[[stage]]
name = "linear"
after = "static"
optimizers = ["pso"]
model = "hammerstein"
fit = ["b", "c_over_m", "k_over_m"]
fitted = ["sine-50-hz"]
check = ["sine-20-hz", "damped-sine"]
control = ["pso"]
controllers = ["sliding-mode"]
"""
STUDY = check_study(tomllib.loads(STUDY_TEXT), "t")
NONE = pd.DataFrame(columns=list(STAGED_COLUMNS))


def trials(*keys, **changed):
    values = {f"parameter.{name}": value for name, value in (PUBLISHED._asdict() | changed).items()}
    row = {"problem": "static", "optimizer": "pso", "status": "done", "fitness": 0.1} | values
    return pd.DataFrame([row | {"instance": instance, "trial": trial} for instance, trial in keys])


def staged(rows, kept=NONE, study=STUDY):
    built = {"static": build_problem(study.problem[0], study.seed, None)}
    return staged_trials.run_staged_trials(study, rows, built, folder=None, kept=kept)


@pytest.fixture(scope="module", autouse=True)
def coarse():
    """Loops of 2000 samples a second: the numbers are not looked at."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(staged_trials, "RATE", 2000.0)
        yield


@pytest.fixture(scope="module")
def first():
    return staged(trials((1, 0), (2, 0)))


def test_every_trial_has_a_row_of_its_own_actuator(first):
    assert list(first["instance"]) == [1, 2]
    assert list(first.columns[:6]) == list(STAGED_COLUMNS)
    assert first["fault"].eq("").all()
    assert first["k_over_m"].nunique() == 2
    for name in ("check_error", "check_rmse"):
        parts = first[[f"{name}.sine-20-hz", f"{name}.damped-sine"]]
        np.testing.assert_allclose(first[name], parts.mean(axis=1))
    of_references = [name for name in first if name.startswith(f"tracking_rmse.{SLIDING}.")]
    assert len(of_references) == 6
    assert list(staged_trials.TUNED.values()) == ["tuned.C", "tuned.epsilon", "tuned.rho"]
    np.testing.assert_allclose(first["tuned.C"], 2.0 * first["tuned.rho"])  # as tune_sliding_mode shares the slope
    assert (first["tuned.epsilon"] > 0).all()
    np.testing.assert_allclose(first[f"tracking_rmse.{SLIDING}"], first[of_references].mean(axis=1))


def test_what_is_kept_is_not_computed_again_unless_the_trial_found_something_else(first, monkeypatch):
    computed = []
    section_behind = staged_trials.section_behind

    def counted(stage, label, found, *rest):
        computed.append(found["alpha"])
        return section_behind(stage, label, found, *rest)

    monkeypatch.setattr(staged_trials, "section_behind", counted)
    again = staged(trials((1, 0), (2, 0)), first)
    pd.testing.assert_frame_equal(again, first)
    assert computed == []
    without = STUDY.stage[0].model_copy(update={"controllers": []})
    other = STUDY.model_copy(update={"stage": [without]})
    found = staged(pd.concat([trials((1, 0), alpha=0.5), trials((2, 0))]), first, other)
    assert len(found) == 2
    assert computed == [0.5, PUBLISHED.alpha]  # another model in one, another stage in both


def test_a_model_that_no_controller_can_use_is_told_and_keeps_its_other_numbers():
    [row] = staged(trials((1, 0), alpha=3.0)).to_dict("records")
    assert "monotonic" in row["fault"]
    assert row["check_rmse"] > 0
    assert f"tracking_rmse.{SLIDING}" not in row


@pytest.mark.long
def test_the_courses_of_the_best_trials_loops_are_kept_and_drawn(tmp_path, monkeypatch):
    monkeypatch.setattr(stages, "compare", partial(stages.compare, rate=2000.0))
    built = {"static": build_problem(STUDY.problem[0], STUDY.seed, None)}
    _, responses = stages.run_stages(STUDY, trials((1, 0)), built, folder=None)
    loops = responses[responses["role"] == f"{stages.CONTROL}{SLIDING}"]
    assert set(loops["record"]) == {"ramp", "damped-sine", "sine-10-hz", "sine-30-hz", "sine-50-hz", "complex"}
    assert (loops["simulated"] - loops["output"]).abs().max() < 0.5
    units = {"time": "s", "input": "V", "output": "um"}
    assert len(loop_figures(tmp_path, 1, responses, units=units)) == 6
    fits, _ = stage_figures(tmp_path, 1, responses, units=units)
    assert len(fits) == 2  # of the check alone
    alone = responses[responses["role"] == f"{stages.CONTROL}{FEED_FORWARD}"]
    assert set(alone["record"]) == {"sine-0.5-hz"}
    turns = alone["output"].to_numpy()
    assert np.ptp(turns) == pytest.approx(4.0, abs=1e-3)
    line, loop = (np.polyfit(alone[x], alone["simulated"], 1, full=True)[1][0] for x in ("output", "input"))
    assert line < 0.05 * loop  # in series with its inverse the actuator is nearly a straight line
    drawn = feed_forward_figure(tmp_path, 1, responses, units=units)
    assert f"pso {number((alone['simulated'] - alone['output']).abs().max(), 3)}" in drawn.caption
    assert feed_forward_figure(tmp_path, 1, loops, units=units) is None


@pytest.mark.parametrize("run", [True, False])
def test_claims_on_a_stage_are_judged_over_its_rows(tmp_path, run):
    results = read_results(write_results(tmp_path))
    claim = {"says": "x", "where": "y", "better": "mpso", "worse": "pso", "metric": "check_rmse"}
    rows = results.trials[results.trials["problem"] == PROBLEMS[0]][["optimizer", "instance", "trial"]]
    errors = rows["optimizer"].map({"mpso": 0.8, "pso": 1.0}) * (1 + 0.1 * rows["trial"])
    behind = rows.assign(stage="linear", made_of="h0", fault="", check_rmse=errors, tracking_rmse=np.nan)
    behind = behind.dropna(subset="check_rmse")
    stage = STUDY.stage[0].model_copy(update={"after": PROBLEMS[0]})
    study = results.study.model_copy(update={"stage": [stage]})
    here = problems(replace(results, study=study, staged=behind if run else NONE))
    judged = judge(check_published({"claim": [claim]}), here)
    assert [found.problem for found in judged] == [PROBLEMS[0]]
    assert not any(problem.has("tracking_rmse") for problem in here)  # an empty column is none
    assert judged[0].verdict == (HOLDS if run else UNDECIDED)
    assert (NOT_STAGED in sentences(judged)[0]) != run


def test_a_table_that_is_damaged_is_left_out(tmp_path):
    (write_results(tmp_path) / STAGED_TRIALS).write_text("stage,optimizer\nlinear,pso\n")
    results = read_results(tmp_path)
    assert results.staged.empty
    assert STAGED_TRIALS in results.damages[0]
