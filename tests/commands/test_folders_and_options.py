"""`merge`, `report --keep` and `diagnose`: folders that are not mixed, options that do not contradict each other."""

import shlex
import shutil
from io import StringIO
from types import SimpleNamespace as Of

import numpy as np
import pytest
from click.testing import CliRunner
from rich.console import Console

from hysteresis_bench.cli import main
from hysteresis_bench.commands.diagnose import candidates_table
from hysteresis_bench.errors import UserError
from hysteresis_bench.study.problems import dataset_of
from hysteresis_bench.study.run import run_study
from hysteresis_bench.study.study_file import read_study

STUDY = """
title = "one search"
seed = 3
trials = 2
budget = 30
[[problem]]
name = "p"
data = ["loop.csv"]
model = "bouc-wen"
[[optimizer]]
plugin = "random-search"
"""


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """A study and its results, beside its data."""
    folder = tmp_path_factory.mktemp("studies")
    time = np.arange(200) / 50.0
    rows = [f"{t:.6f},{np.sin(6 * t):.6f},{np.sin(6 * t - 0.2):.6f}" for t in time]
    (folder / "loop.csv").write_text("\n".join(["time [s],input [V],output [um]", *rows]) + "\n", encoding="utf-8")
    (folder / "one.toml").write_text(STUDY, encoding="utf-8")
    run_study(folder / "one.toml", jobs=1, out=folder / "run")
    return folder


def told(*arguments):
    result = CliRunner().invoke(main, [str(argument) for argument in arguments])
    return result.exit_code, " ".join(result.output.split())


def test_a_folder_is_merged_once(ran, tmp_path):
    code, output = told("merge", ran / "run", f"{ran / 'run'}/", "--out", tmp_path / "whole")
    assert (code, "is named twice; name every part once." in output) == (2, True)
    assert not (tmp_path / "whole").exists()


def test_what_follows_a_merge_is_a_command_that_can_be_copied(ran, tmp_path):
    whole = tmp_path / "the whole"
    code, output = told("merge", ran / "run", shutil.copytree(ran / "run", tmp_path / "copy"), "--out", whole)
    assert code == 0, output
    assert output.startswith("2 trials of 2 folders")
    assert output.endswith(f"hysteresis-bench run STUDY.toml --out {shlex.quote(str(whole))}")


def test_what_is_kept_is_mixed_with_nothing_else(ran, tmp_path):
    fit, kept = tmp_path / "fit", tmp_path / "kept"
    fit.mkdir()
    (fit / "model.json").write_text("{}", encoding="utf-8")
    code, output = told("report", ran / "run", "--keep", fit)
    assert (code, "holds something that is no kept study" in output) == (2, True)
    assert [path.name for path in fit.iterdir()] == ["model.json"]
    for _ in range(2):  # into a new folder, and into the same one again
        code, output = told("report", ran / "run", "--keep", kept)
        assert code == 0, output
    (kept / "study.toml").write_text(STUDY.replace("one search", "another"), encoding="utf-8")
    assert 'keeps another study, "another".' in told("report", ran / "run", "--keep", kept)[1]
    whole = shutil.copytree(ran / "run", tmp_path / "copy")
    assert "holds the trials of a study" in told("report", ran / "run", "--keep", whole)[1]


def test_without_its_reference_a_report_speaks_of_the_best_only(ran):
    assert told("report", ran / "run")[0] == 0
    assert "is the reference" not in (ran / "run" / "summary.csv").read_text(encoding="utf-8")
    page = (ran / "run" / "report.html").read_text(encoding="utf-8")
    assert "each optimizer with the best" in page
    assert "with the reference" not in page


def test_a_record_that_is_unknown_is_told_with_its_file(ran):
    (spec,) = read_study(ran / "one.toml")[0].problem
    with pytest.raises(UserError, match=r'no record "bad" in loop\.csv\. Known: loop\.'):
        dataset_of(spec.model_copy(update={"fitted": ["bad"]}), 3, ran)


def test_a_diagnosis_is_of_one_model_or_of_several(ran, tmp_path):
    loop, out = ran / "loop.csv", tmp_path / "d"
    code, output = told("diagnose", loop, "--model", "bouc-wen", "--models", "dahl,duhem", "--out", out)
    assert (code, "--models is where the law is sought, and --model names it; give one of them." in output) == (2, True)
    code, output = told("diagnose", loop, "--models", "foo", "--out", out)
    assert (code, 'error: diagnose: no model "foo".' in output) == (2, True)
    assert not out.exists()


@pytest.mark.parametrize("width", [80, 90, 120])
def test_the_headings_of_the_effects_are_whole(width):
    numbers = {"rmse": 0.004644123, "cv_rmse": 0.0046221, "p": 1.1e-121, "tied_with": ["drift"]}
    marks = {"applicable": True, "adopted": False, "stand_in": False, "at_bound": True}
    row = Of(effect="response-with-temperature", **numbers, **marks)
    console = Console(width=width, record=True, file=StringIO())
    console.print(candidates_table(Of(candidates=[row], certainty={row.effect: Of(probability=0.28)})))
    headings = console.export_text().partition(row.effect)[0].split()
    assert {"effect", "sure", "RMSE", "left", "out", "tied", "with"} <= {*headings}
