"""The export for IOHprofiler: runs as the format has them, and the same numbers out of its own reader."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import statistics
from hysteresis_bench.commands.report import report
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.trials.ioh import write_ioh
from hysteresis_bench.report.trials.summary import problems
from hysteresis_bench.study.results import read_results
from tests.synthetic_study import BUDGET, OPTIMIZERS, PROBLEMS, write_results


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return read_results(write_results(tmp_path_factory.mktemp("study"), trials=6))


@pytest.fixture(scope="module")
def written(results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ioh")
    return folder, write_ioh(results, folder)


def test_a_file_an_optimizer_and_problem_with_a_run_a_trial(results, written):
    folder, files = written
    assert len(files) == len(PROBLEMS) * len(OPTIMIZERS)
    content = json.loads((folder / "pymoo_ga" / "IOHprofiler_f1_paper_box_linear.json").read_text())
    [scenario] = content["scenarios"]
    assert (content["algorithm"]["name"], content["function_name"]) == ("pymoo-ga", PROBLEMS[0])
    assert len(scenario["runs"]) == 4  # two of six failed
    assert all(run["evals"] == BUDGET for run in scenario["runs"])
    table = np.loadtxt(folder / "pymoo_ga" / scenario["path"], skiprows=1)
    assert np.count_nonzero(table[:, 0] == 1) == 4
    first = table[: np.nonzero(table[:, 0] == 1)[0][1]]
    assert np.all(np.diff(first[:, 1]) < 0)
    assert first[-1, 1] == pytest.approx(scenario["runs"][0]["best"]["y"], rel=1e-9)
    assert len(scenario["runs"][0]["best"]["x"]) == scenario["dimension"] == 5


def test_without_the_course_of_the_searches_there_is_nothing_to_export(tmp_path):
    folder = write_results(tmp_path, trials=1)
    (folder / "trials.sqlite").unlink()
    with pytest.raises(UserError, match="no searches to export"):
        write_ioh(read_results(folder), tmp_path / "out")


def test_the_command_writes_it_beside_the_report(results, tmp_path, monkeypatch):
    written = []  # the page itself takes seconds, and `test_report` has it
    monkeypatch.setattr("hysteresis_bench.report.study.write_report", lambda folder: written.append(folder) or folder)
    told = CliRunner().invoke(report, [str(results.folder), "--ioh", str(tmp_path)])
    assert told.exit_code == 0, told.output
    assert written == [results.folder]
    assert len(list(tmp_path.glob("*/*.json"))) == len(PROBLEMS) * len(OPTIMIZERS)


def test_iohinspector_finds_the_same_running_times(results, written):
    inspector = pytest.importorskip("iohinspector")
    folder, _ = written
    manager = inspector.DataManager()
    manager.add_folder(str(folder))
    here = problems(results)[0]
    data = manager.select(function_ids=[1]).load(monotonic=True, include_meta_data=True)
    low, high = here.best[1] * 1.05, here.best[1] * 50.0
    found = inspector.metrics.aggregate_running_time(data, f_min=low, f_max=high, eval_max=BUDGET)
    assert set(found["algorithm_name"]) == set(OPTIMIZERS)
    for row in found.to_dict("records"):
        label, target = row["algorithm_name"], row["raw_y"]
        there = [(label, *key) in here.traces for key in here.keys(label)]
        hits = here.reached(label, np.full((len(there), 1), target))[there, 0]
        assert row["success_ratio"] == np.mean(np.isfinite(hits))
        ours = statistics.expected_running_time(hits, np.full(hits.size, BUDGET))
        assert row["ERT"] == pytest.approx(ours) or (np.isinf(ours) and not np.isfinite(row["ERT"]))
