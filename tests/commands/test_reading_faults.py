"""Options of the commands that read and write data: numbers that are none, and names that promise another file."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.commands.outputs import check_table
from hysteresis_bench.errors import UserError


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = [f"{k / 100},{np.sin(k / 9):.6f},{np.cos(k / 9):.6f}" for k in range(200)]
    (tmp_path / "loop.csv").write_text("\n".join(["time [s],input [V],output [um]", *lines]), encoding="utf-8")
    return tmp_path


def told(*arguments, code=2):
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == code, done.output
    return " ".join(done.output.split())


@pytest.mark.parametrize("option", ["--skip", "--input-offset"])
@pytest.mark.parametrize("value", ["nan", "inf"])
def test_a_preparation_by_no_number_is_refused(here, option, value):
    for command in ("fit", "diagnose", "compare"):
        model = () if command == "compare" else ("--model", "dahl")
        said = told(command, "loop.csv", *model, option, value)
        assert f"Invalid value for '{option}': {value} is not a finite number." in said


@pytest.mark.parametrize(
    ("asked", "sentences"),
    [
        ("fit --model dahl --set plays=3", ['no setting "plays"']),
        ("fit --model dahl --fix z=1 --bounds y=0:1", ['fixed: no parameter "z"', 'bounds: no parameter "y"']),
        ("fit --model dahl --effect bais --optimizer psoo", ['no effect "bais"', 'no optimizer "psoo"']),
        ("diagnose --model dahl --set plays=3", ['no setting "plays"']),
        ("diagnose --models dahll --effect bais", ['no model "dahll"', 'no effect "bais"']),
        ("compare --models dahll", ['no model "dahll"']),
    ],
)
def test_a_record_that_is_not_there_hides_no_other_fault(here, asked, sentences):
    command, *options = asked.split()
    said = told(command, "loop.csv", *options, "--held-out", "foo")
    assert f"{command} has {1 + len(sentences)} faults: held out: no record 'foo'; there are: loop." in said
    assert all(sentence in said for sentence in sentences)


@pytest.mark.parametrize("value", ["-1", "0", "nan", "inf", "1e9"])
def test_a_test_of_a_plugin_takes_a_finite_time(value):
    said = told("check-plugin", "bias", "--timeout", value)
    assert "Invalid value for '--timeout'" in said
    assert "broken" not in said


@pytest.mark.parametrize(
    "command", [("measure", "pea", "ramp", "--out"), ("check", "loop.csv", "--out")], ids=lambda one: one[0]
)
def test_what_is_csv_is_not_called_otherwise(here, command):
    for name in ("hs.xlsx", "hs.mat", "hs"):
        assert "is CSV, so give it a name that ends in .csv, such as hs.csv." in told(*command, name)
    assert [path.name for path in here.iterdir()] == ["loop.csv"]
    told(*command, "hs.CSV", code=0)


def test_a_table_may_be_called_text(here):
    check_table(here / "a.txt")
    with pytest.raises(UserError, match="is there already"):
        check_table(here / "loop.csv")


def test_a_rate_against_the_column_of_time_is_told(here):
    content = json.loads(CliRunner().invoke(main, ["check", "loop.csv", "--rate", "5", "--json"]).output)
    assert any("5 Hz as given in place of the column of time, which says 100 Hz" in note for note in content["notes"])


def test_a_hole_in_time_is_told(here):
    lines = (here / "loop.csv").read_text(encoding="utf-8").splitlines()
    (here / "hole.csv").write_text("\n".join(lines[:80] + lines[150:]), encoding="utf-8")
    assert "a hole in the time of record hole: no sample for 0.71 s between rows 80 and 81" in told(
        "check", "hole.csv", code=0
    )


def test_two_samples_are_not_said_to_be_well(here):
    lines = (here / "loop.csv").read_text(encoding="utf-8").splitlines()
    (here / "two.csv").write_text("\n".join(lines[:3]), encoding="utf-8")
    said = told("check", "two.csv", code=0)
    assert "two: 2 samples are too few: `diagnose` and `compare` need 40" in said
    assert "Nothing is odd" not in said


def test_c_may_be_called_by_its_name(here):
    units = {"time": "s", "input": "V", "output": "um"}
    found = {"distance": (0.8, "V"), "i": (0.1, "1"), "gap": (0.0, "V"), "slope": (0.1, "um/V"), "F_C": (0.9, "um")}
    parameters = {name: {"value": one, "standard_error": None, "unit": unit} for name, (one, unit) in found.items()}
    preparation = {"input_offset": 0.0, "flip": False, "skip": 0.0, "settle": 0}
    model = {"schema": 2, "model": "dahl", "settings": {}, "units": units, "parameters": parameters, "effects": []}
    model |= {"fixed": {}, "preparation": preparation, "data": {}, "error": {}, "created_by": {}}
    (here / "model.json").write_text(json.dumps(model), encoding="utf-8")
    told("export", "model.json", "--to", "C", code=0)
    assert (here / "model.c").is_file()
    told("export", "model.json", "--to", "Python", code=0)
    assert "Known: python, c" in told("export", "model.json", "--to", "cobol")


def test_a_file_whose_name_is_no_text_is_refused(tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/bad\xff.csv")
    Path(path).write_text("time,input,output\n0,0,0\n1,1,1\n", encoding="utf-8")
    done = CliRunner().invoke(main, ["fit", path, "--model", "dahl", "--out", str(tmp_path / "fit")])
    assert done.exit_code == 2
    assert "holds bytes that are no letters" in " ".join(done.stderr.split())
