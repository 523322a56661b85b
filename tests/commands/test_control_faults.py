"""`control`: values that cannot be and options that would change nothing are faults, and nothing is written."""

import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.fit.model_file import write_model
from tests.control.test_control import model


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_model(tmp_path / "model.json", model("bouc-wen"))
    (tmp_path / "wanted.csv").write_text("time,output\n0,0\n1,1\n2,0\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ("--sweep 1 --amplitude nan", "'--amplitude': nan is not a finite number."),
        ("--sweep 1 --amplitude inf", "'--amplitude': inf is not a finite number."),
        ("--reference wanted.csv --voltage-limit nan", "'--voltage-limit': nan is not a finite number."),
        ("--rig pea --rate nan", "'--rate': nan is not a finite number."),
        ("--rig pea --rate 3", "choose one from 200 to 1e+06 samples a second."),
        ("--sweep 1e300 --amplitude 1", "choose one from 1e-09 to 1e+09 cycles a unit of the model's time."),
        ("--sweep nan", "frequencies above 0."),
        ("--sweep 1 --voltage-limit 3", "--voltage-limit cuts the input of a --reference"),
        ("--rig pea --voltage-limit 3", "--voltage-limit cuts the input of a --reference"),
        ("--reference wanted.csv --amplitude 2", "--amplitude is of a --sweep or a --rig"),
        ("--sweep 1 --rate 100", "--rate is of a --rig, or of a --reference"),
        ("--sweep 1 --seed 0", "--seed is of a --rig: nothing else"),
        ("--reference wanted.csv --open", "--open opens the page of a --rig"),
        ("--sweep 1 --output y", "say how a --reference is read; give one."),
        ("--sweep 1 --rate 100 --voltage-limit 3", "control has 2 faults"),
    ],
)
def test_what_cannot_be_or_changes_nothing_is_refused(here, asked, sentence):
    result = CliRunner().invoke(main, ["control", "model.json", *asked.split()])
    assert result.exit_code == 2, result.output
    assert sentence in " ".join(result.output.split())
    assert sorted(path.name for path in here.iterdir()) == ["model.json", "wanted.csv"]
