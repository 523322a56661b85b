"""Commands on hostile input: a sentence and exit code 2, or done; never a traceback, never a hang."""

import json
import os

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main

MODEL = {
    "schema": 2, "model": "polynomial", "settings": {}, "effects": [],
    "units": {"time": "s", "input": "V", "output": "um"},
    "parameters": {
        "a": {"value": 1.0, "standard_error": None, "unit": "um/V"},
        "b": {"value": 1.0, "standard_error": None, "unit": "1"},
    },
    "fixed": {}, "preparation": {"input_offset": 0.0, "flip": False, "skip": 0.0, "settle": 0},
    "data": {}, "error": {}, "created_by": {},
}  # fmt: skip
LINES = [f"{i / 10},{np.sin(i / 3):.6f},{np.sin(i / 3) ** 3:.6f}" for i in range(40)]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.json").write_text(json.dumps(MODEL), encoding="utf-8")
    (tmp_path / "good.csv").write_text("time [s],input [V],output [um]\n" + "\n".join(LINES), encoding="utf-8")
    return tmp_path


def told(*arguments, code=2):
    """What a command says."""
    done = CliRunner().invoke(main, [str(one) for one in arguments])
    assert done.exception is None or isinstance(done.exception, SystemExit), repr(done.exception)
    assert done.exit_code == code, done.output
    return " ".join(done.output.split())


def data(folder, text):
    (folder / "bad.csv").write_text(text, encoding="utf-8")
    return folder / "bad.csv"


HOSTILE = {
    "one huge cell": ("time,input,output\n0,1,1\n1,1.7e308,2\n2,0,1\n", 'column "input": "1.7e308" is too large'),
    "denormal steps": ("time,input,output\n0,1,1\n5e-324,2,2\n1e-323,0,1\n", "too short to work with"),
    "a header of a million characters": ("x" * 1_000_000 + "\n1\n2\n", "has a name of 1000000 characters"),
    "a million blanks": ("time,input" + " " * 1_000_000 + "[V],output\n", "has a name of 1000008 characters"),
    "one sample": ("time,input,output\n0,1,1\n", "has 1 sample"),
    "an underscore": ("time,input,output\n0,1_0,1\n1,2,1\n", '"1_0" is not a finite number'),
    "nothing": ("", "is empty"),
    "an unclosed quote": ('time,input,output\n"0,1,1\n', "cannot be read as CSV"),
}  # fmt: skip


@pytest.mark.parametrize("case", HOSTILE)
def test_data(here, case):
    text, words = HOSTILE[case]
    path = data(here, text)
    assert words in told("predict", "model.json", path, "--out", "out.csv")
    assert not (here / "out.csv").exists()


def test_data_that_is_no_file(here):
    os.mkfifo(here / "pipe.csv")
    for name, why in (("pipe.csv", "is no file"), (".", "is a folder; name its files, such as")):
        assert why in told("predict", "model.json", name, "--out", "out.csv")
    assert "no file that can be written" in told("predict", "model.json", "good.csv", "--out", "pipe.csv")
    assert "cannot be read" in told("predict", "pipe.csv", "good.csv", "--out", "out.csv")


def test_two_thousand_columns(here):
    more = [f"c{i}" for i in range(2000)]
    wide = "\n".join(f"{line},{','.join('1' * 2000)}" for line in LINES)
    path = data(here, f"time [s],input [V],output [um],{','.join(more)}\n{wide}")
    told("predict", "model.json", path, "--out", "out.csv", code=0)
    assert len(told("predict", "model.json", data(here, ",".join(more) + "\n"), "--out", "2.csv")) < 3000


def test_two_samples_are_predicted_and_not_fitted(here):
    path = data(here, "time [s],input [V],output [um]\n0,0,0\n1,1,2\n")
    assert "2 samples cannot determine 2 parameters" in told("fit", path, "--model", "polynomial")
    assert "RMSE 0 um" in told("predict", "model.json", path, "--out", "out.csv", code=0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--effect", "bias", "--effect", "bias"], 'effect "bias" is given 2 times'),
        (["--fix", "a=1", "--fix", "b=1"], "every parameter is fixed"),
        (["--fix", "a=1", "--fix", "a=2"], '"a" is given twice'),
        (["--fix", "a=nan"], "must be finite"),
        (["--skip", "1e300"], "leaves nothing"),
        (["--out", "good.csv"], "good.csv"),
    ],
)
def test_fit(here, arguments, words):
    assert words in told("fit", "good.csv", "--model", "polynomial", *arguments)


def test_an_effect_twice_in_a_diagnosis(here):
    twice = ("--effect", "bias", "--effect", "bias")
    assert "given 2 times" in told("diagnose", "good.csv", "--model", "polynomial", *twice)


def test_outputs_replace_nothing(here):
    own = (here / "good.csv").read_bytes()
    assert "one of the inputs" in told("predict", "model.json", "good.csv", "--out", "good.csv")
    assert "no folder nowhere" in told("predict", "model.json", "good.csv", "--out", "nowhere/out.csv")
    assert "is there already" in told("measure", "sma", "pwm-60s", "--out", "good.csv")
    assert (here / "good.csv").read_bytes() == own
    (here / "responses.csv").write_bytes(own)
    assert "responses.csv is one of the inputs" in told("fit", "responses.csv", "--model", "polynomial", "--out", ".")
    told("predict", "model.json", "good.csv", "--out", "good.csv", "--force", code=0)
    assert (here / "good.csv").read_bytes() != own


@pytest.mark.parametrize("kept", ["model.json", "diagnosis.json", "closing.json"])
def test_a_diagnosis_replaces_nothing_of_another_command(here, kept):
    (here / "out").mkdir()
    (here / "out" / kept).write_text("kept", encoding="utf-8")
    if kept == "closing.json":  # the diagnosis at the end of a study
        (here / "out" / "diagnosis.json").write_text("kept", encoding="utf-8")
        (here / "out" / "diagnosis.html").write_text("kept", encoding="utf-8")
    assert "not this command's own" in told("diagnose", "good.csv", "--model", "polynomial", "--out", "out")
    assert (here / "out" / kept).read_text(encoding="utf-8") == "kept"


def test_a_report_that_is_kept_is_not_begun_anew(here):
    (here / "kept").mkdir()
    (here / "kept" / "report.html").write_text("kept", encoding="utf-8")
    (here / "study.toml").write_text(
        'title = "t"\nseed = 1\n[[problem]]\nname = "p"\nmodel = "polynomial"\ndata = ["good.csv"]\n'
        '[[optimizer]]\nplugin = "pso"\n',
        encoding="utf-8",
    )
    assert "a report that is kept" in told("run", "study.toml", "--out", "kept")
    assert (here / "kept" / "report.html").read_text(encoding="utf-8") == "kept"


@pytest.mark.parametrize("value", ["NaN", "Infinity", "1e308", '"1"', "null", "[]", "true"])
def test_numbers_of_a_model_file(here, value):
    (here / "model.json").write_text(json.dumps(MODEL).replace("1.0", value, 1), encoding="utf-8")
    told("predict", "model.json", "good.csv", "--out", "out.csv")


@pytest.mark.parametrize("change", [{"units": {}}, {"parameters": []}, {"effects": {}}, {"preparation": {"x": 1}},
                                    {"schema": True}, {"preparation": {"settle": -1}}, {"preparation": {"skip": "x"}},
                                    {"fixed": {"a": None}}, {"units": {"time": 1, "input": 2}}])  # fmt: skip
def test_parts_of_a_model_file(here, change):
    (here / "model.json").write_text(json.dumps(MODEL | change), encoding="utf-8")
    told("predict", "model.json", "good.csv", "--out", "out.csv")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"preparation": {**MODEL["preparation"], "flip": "false"}}, '"flip" is missing or wrong'),
        ({"preparation": {**MODEL["preparation"], "flipp": True}}, "preparation: flipp"),
        ({"fixed": {"c": 1.0}}, 'no parameter "c". Known: a, b'),
        ({"fixed": {"a": 1.0}}, '"a" is both found and fixed'),
        ({"parameters": {**MODEL["parameters"], "a": {"value": 1.0, "standard_error": None, "unit": "mV"}}}, 'in "mV"'),
        ({"effects": [{"effect": "record-offset", "settings": {}, "parameters": {}}]}, 'setting "default" is missing'),
        ({"effects": [{"effect": "record-offset", "settings": {}, "parameters": {}}] * 2}, "stands there twice"),
    ],
)
def test_what_a_model_file_leaves_open_is_not_guessed(here, change, words):
    (here / "model.json").write_text(json.dumps(MODEL | change), encoding="utf-8")
    assert words in told("predict", "model.json", "good.csv", "--out", "out.csv")


def test_units_are_converted_and_told(here):
    told("predict", "model.json", "good.csv", "--out", "one.csv", code=0)
    scaled = [line.split(",") for line in LINES]
    text = "\n".join(f"{float(t) * 1e3},{float(u) / 1e3},{y}" for t, u, y in scaled)
    path = data(here, "time [ms],input [kV],output [um]\n" + text)
    words = told("predict", "model.json", path, "--out", "two.csv", code=0)
    assert "time [ms] was converted to s, input [kV] was converted to V." in words
    one, two = (np.loadtxt(here / name, delimiter=",", skiprows=1) for name in ("one.csv", "two.csv"))
    np.testing.assert_allclose(one, two, rtol=1e-12, atol=1e-15)
