"""`new-study` runs, `schema` says what files hold, `--json` is read by programs."""

import json
import tomllib

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.errors import UserError
from hysteresis_bench.schemas.forms import NAMES, generated, schema
from hysteresis_bench.study.problems import dataset_of
from hysteresis_bench.study.study_file import check_study, read_study

NOISE = 0.1 * np.random.default_rng(4).standard_normal(120)
"""So much that a diagnosis does not ask for more steps than samples, which takes three times as long."""
ROWS = [(i / 50, 3 * np.sin(i / 9), 2 * np.sin(i / 9 - 0.2) + NOISE[i]) for i in range(120)]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("slow", "fast"):
        lines = [";".join(f"{value:.5f}".replace(".", ",") for value in row) for row in ROWS]
        (tmp_path / f"{name}.csv").write_text("time (s);drive (V);way (um)\n" + "\n".join(lines), encoding="utf-8")
    return tmp_path


ROLES = ("--input", "drive", "--output", "way")


def told(*arguments, code=0):
    done = CliRunner().invoke(main, list(arguments))
    assert done.exit_code == code, done.output
    return done.stdout


def test_a_new_study_reads_the_files_as_they_were_told(here):
    told("new-study", "slow.csv", "fast.csv", *ROLES, "--model", "bouc-wen", "--out", "mine.toml")
    study, text = read_study(here / "mine.toml")
    (problem,) = study.problem
    assert text.startswith("#:schema ./study.schema.json")
    assert 'layout   = { input = "drive", output = "way" }' in text
    assert problem.held_out == ["fast"]
    assert len(study.optimizer) == 3
    dataset = dataset_of(problem, 1, here)
    assert dataset.units["output"] == "um"
    np.testing.assert_allclose(dataset.records[0].output, [row[2] for row in ROWS], atol=1e-5)
    said = told("new-study", "slow.csv", *ROLES, "--model", "bouc-wenn", code=2)
    assert said == ""


def test_a_problem_without_its_layout_says_where_it_goes(here):
    told("new-study", "slow.csv", *ROLES, "--model", "bouc-wen", "--out", "mine.toml")
    text = (here / "mine.toml").read_text(encoding="utf-8")
    bare = check_study(tomllib.loads(text.replace('input = "drive", ', "")), "mine.toml")
    with pytest.raises(UserError, match=r"stands in the problem: layout = \{ input"):
        dataset_of(bare.problem[0], 1, here)
    by_place = tomllib.loads(text.replace('"drive"', "2").replace('"way"', "3"))
    assert dataset_of(check_study(by_place, "mine.toml").problem[0], 1, here).names == ("slow",)


@pytest.mark.parametrize(
    ("layout", "words"),
    [
        ({"delimiter": "x", "rate": -1.0}, 'delimiter "x" is none of comma.* rate -1 is no number'),
        ({"columns": "a"}, 'no key "columns"'),
        ({"rate": 10.0, "time": "t"}, "a rate or a column of time, not both"),
    ],
)
def test_a_wrong_layout_is_told_with_the_studys_other_faults(here, layout, words):
    told("new-study", "slow.csv", *ROLES, "--model", "bouc-wen", "--out", "mine.toml")
    raw = tomllib.loads((here / "mine.toml").read_text(encoding="utf-8"))
    raw["problem"][0]["layout"] = layout
    raw["seeds"] = 3
    with pytest.raises(UserError, match=words) as refused:
        check_study(raw, "mine.toml")
    assert any("seeds" in fault for fault in refused.value.faults)


def test_schemas_are_what_the_forms_say(here):
    jsonschema = pytest.importorskip("jsonschema")
    for name in NAMES:
        assert schema(name) == generated(name)
        assert json.loads(told("schema", name)) == schema(name)
    told("new-study", "slow.csv", *ROLES, "--model", "bouc-wen", "--out", "mine.toml")
    jsonschema.validate(tomllib.loads((here / "mine.toml").read_text(encoding="utf-8")), schema("study"))
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"title": "x"}, schema("study"))


def svg(name):
    """A figure, and an answer for programs."""
    return "--plot", f"{name}.svg", "--json"


def test_json_of_fit_predict_and_diagnose(here):
    jsonschema = pytest.importorskip("jsonschema")
    fitted = json.loads(told("fit", "slow.csv", *ROLES, "--model", "polynomial", "--budget", "100", *svg("f")))
    assert {row["name"] for row in fitted["parameters"]} == {"a", "b"}
    jsonschema.validate(json.loads((here / "slow-fit" / "model.json").read_text()), schema("model"))
    predicted = json.loads(told("predict", "slow-fit/model.json", "fast.csv", *ROLES, "--out", "p.csv", "--json"))
    assert predicted["records"]["fast"]["rmse"] > 0.0
    found = json.loads(told("diagnose", "slow.csv", *ROLES, "--model", "polynomial", "--jobs", "1", *svg("d")))
    jsonschema.validate(found, schema("diagnosis"))
    assert fitted["figure"] == "f.svg"
    assert "Fitted minus measured" in (here / "f.svg").read_text(encoding="utf-8")
    assert "Simulated minus measured" in (here / "d.svg").read_text(encoding="utf-8")


def test_json_of_lists():
    assert "bouc-wen" in {row["name"] for row in json.loads(told("list", "models", "--json"))["models"]}
    (one,) = json.loads(told("list", "creep", "--json"))
    assert [parameter["name"] for parameter in one["parameters"]] == ["share", "time_constant", "decades"]
    assert "arrives late" in one["says"]


def test_json_of_compare_run_and_check_plugin(here):
    compared = json.loads(told("compare", "slow.csv", *ROLES, "--models", "polynomial", "--jobs", "1", *svg("c")))
    assert "cubic polynomial" in (here / compared["figure"]).read_text(encoding="utf-8")
    assert {row["law"] for row in compared["laws"]} >= {"polynomial", "cubic polynomial"}
    made = json.loads(told("new-study", "slow.csv", *ROLES, "--model", "polynomial", "--out", "mine.toml", "--json"))
    assert (made["study"], made["records"][0]["input"]) == ("mine.toml", "drive (V)")
    text = (here / "mine.toml").read_text(encoding="utf-8").replace("15050", "200")
    (here / "mine.toml").write_text(text.replace("trials  = 3", "trials = 1"), encoding="utf-8")
    ran = json.loads(told("run", "mine.toml", "--jobs", "1", "--json"))
    assert {row["optimizer"] for row in ran["summary"]} == {"multistart-least-squares", "pso", "random-search"}
    assert ran["failed"] == []
    checked = json.loads(told("check-plugin", "bias", "--json"))
    assert {one["status"] for one in checked} == {"kept"}
    broken = json.loads(told("check-plugin", "faulty-missing", "--json", code=1))
    assert any(one["status"] == "broken" and one["reason"] for one in broken)
