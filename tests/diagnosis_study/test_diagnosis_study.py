"""A study of diagnosis: what is right, what is counted, and a small run from the command line."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.diagnosis_study.case import Case, compared
from hysteresis_bench.diagnosis_study.confusion import NOTHING, confusion
from hysteresis_bench.diagnosis_study.results import FOLDER, STUDY, read_cases
from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study, read_diagnosis_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.diagnosis_study.page import told, write_closing_page

STUDIES = Path(__file__).parents[2] / "studies"

TEXT = """
kind = "diagnosis"
title = "Small"
seed = 1

[[bench]]
name = "clean"
rig = "hidden-effects"
settings = { model = "bouc-wen", noise = 0.01 }
vary = "draw"
model = "bouc-wen"
fitted = ["slow", "fast"]
held_out = ["mixed"]
fresh = ["stairs"]
"""


def test_every_hidden_effect_must_be_named_or_tied():
    assert compared(["creep", "drift"], ["drift", "creep"], {}) == (["creep", "drift"], [], [], [])
    assert compared(["transport-delay"], ["input-lag"], {"input-lag": {"transport-delay"}}) == (
        [],
        ["transport-delay"],
        [],
        [],
    )
    assert compared(["creep"], ["drift"], {"drift": set()}) == ([], [], ["creep"], ["drift"])
    assert compared([], ["drift"], {}) == ([], [], [], ["drift"])
    assert compared(["eddy-current|input-lag"], ["input-lag"], {}) == (["eddy-current|input-lag"], [], [], [])


def test_one_claim_stands_for_one_hidden_effect():
    rivals = {"input-lag": {"transport-delay", "output-lag"}}
    named, tied, missed, extra = compared(["transport-delay", "output-lag"], ["input-lag"], rivals)
    assert (named, tied, missed, extra) == ([], ["transport-delay"], ["output-lag"], [])


def test_a_claim_that_names_one_effect_does_not_stand_for_another():
    named, tied, missed, _ = compared(
        ["transport-delay", "input-lag"], ["input-lag"], {"input-lag": {"transport-delay"}}
    )
    assert (named, tied, missed) == (["input-lag"], [], ["transport-delay"])


def test_the_confusion_matrix_counts_cases():
    cases = [
        Case("a", "m", 0, "done", hidden="creep", claimed="creep", named="creep"),
        Case("a", "m", 1, "done", hidden="creep", claimed="drift", missed="creep", extra="drift"),
        Case("a", "m", 2, "done", hidden="creep", missed="creep"),
        Case("b", "m", 0, "done"),
        Case("b", "m", 1, "done", claimed="drift", extra="drift"),
        Case("b", "m", 2, "timed-out"),
    ]
    table = confusion(cases)
    assert table.at["creep", "creep"] == table.at["creep", "drift"] == table.at["creep", NOTHING] == 1
    assert table.at[NOTHING, NOTHING] == table.at[NOTHING, "drift"] == 1
    assert table.to_numpy().sum() == 5
    assert [case.right for case in cases] == [True, False, False, True, False, False]


def test_faults_of_a_study_are_told_at_once(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text(TEXT.replace('"fast"', '"fastt"').replace('model = "bouc-wen"\nfitted', 'model = "bouc"\nfitted'))
    with pytest.raises(UserError, match="bouc"):
        read_diagnosis_study(file)
    file.write_text(TEXT.replace('"fast"', '"fastt"'))
    with pytest.raises(UserError, match="fastt"):
        read_diagnosis_study(file)
    file.write_text(TEXT + "sed = 1\n")
    with pytest.raises(UserError, match="sed"):
        read_diagnosis_study(file)


def test_the_study_that_ships_is_one_of_diagnosis():
    path = STUDIES / "closing_the_loop.toml"
    assert is_diagnosis_study(path)
    assert len(read_diagnosis_study(path)[0].bench) > 10
    assert not is_diagnosis_study(STUDIES / "sma.toml")


def test_the_page_tells_shares_and_what_went_wrong(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    (tmp_path / FOLDER).mkdir()
    cases = [
        Case("clean", "bouc-wen", number, "done", before=1.0, after=1.0, fresh=1.0 + number, unfitted=1.0, seconds=1.0)
        for number in range(3)
    ]
    cases.append(Case("clean", "bouc-wen", 3, "done", claimed="drift", extra="drift", before=1.0, after=1.0))
    cases.append(Case("clean", "bouc-wen", 4, "crashed", "exit code 9 <b>"))
    for case in cases:
        (tmp_path / FOLDER / f"clean.{case.number}.json").write_text(json.dumps(asdict(case)))
    page = write_closing_page(tmp_path).read_text()
    assert "something was claimed in 1 of 4 (25\u202f%" in told(tmp_path)[0]
    assert "1 of 3 (33\u202f%" in told(tmp_path)[0]
    assert "exit code 9 &lt;b&gt;" in page
    assert "Cases that went wrong" in page


def test_run_a_study_of_diagnosis_and_continue_it(tmp_path):
    file, out = tmp_path / "small.toml", tmp_path / "results"
    file.write_text(TEXT)
    arguments = ["run", str(file), "--trials", "1", "--jobs", "1", "--out", str(out)]
    first = CliRunner().invoke(main, arguments)
    assert first.exit_code == 0, first.output
    assert (out / "report.html").is_file()
    (case,) = read_cases(out)
    assert case.status == "done"
    assert case.hidden == ""
    assert case.fresh == pytest.approx(1.0, abs=0.2)
    before = (out / FOLDER / "clean.0.json").stat().st_mtime_ns
    assert CliRunner().invoke(main, arguments).exit_code == 0
    assert (out / FOLDER / "clean.0.json").stat().st_mtime_ns == before
    file.write_text(TEXT.replace("seed = 1", "seed = 2"))
    assert CliRunner().invoke(main, arguments).exit_code != 0


def test_the_command_writes_the_page_of_a_diagnosis_study_again(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    (tmp_path / FOLDER).mkdir()
    case = Case("clean", "bouc-wen", 0, "done", before=1.0, after=1.0, fresh=1.0, unfitted=1.0, seconds=1.0)
    (tmp_path / FOLDER / "clean.0.json").write_text(json.dumps(asdict(case)))
    ran = CliRunner().invoke(main, ["report", str(tmp_path)])
    assert ran.exit_code == 0, ran.output
    assert "something was claimed in 0 of 1" in (tmp_path / "report.html").read_text()
