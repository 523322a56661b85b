"""fit, predict, measure and list from the command line, on good input and bad."""

import json
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from tests.end_to_end.test_run import COMMAND, ENVIRONMENT, run_command, run_here


@pytest.fixture(scope="module")
def data_file(tmp_path_factory):
    """A noisy cubic in two runs, with units."""
    folder = tmp_path_factory.mktemp("data")
    rng = np.random.default_rng(5)
    frames = []
    for run, amplitude in (("small", 0.5), ("large", 1.0)):
        time = np.linspace(0, 2, 200)
        drive = amplitude * np.sin(2 * np.pi * time)
        output = 1.5 * drive + 0.4 * drive**3 + 0.01 * rng.standard_normal(200)
        frames.append(pd.DataFrame({"time [s]": time, "input [V]": drive, "output [um]": output, "run": run}))
    path = folder / "cubic.csv"
    pd.concat(frames).to_csv(path, index=False)
    return path


@pytest.fixture(scope="module")
def fitted(data_file, tmp_path_factory):
    out = tmp_path_factory.mktemp("out") / "fit"
    done = run_command(
        "fit", data_file, "--model", "polynomial", "--held-out", "cubic:small", "--budget", 1500, "--out", out
    )
    assert done.returncode == 0, done.stderr
    return done, out


def test_fit_prints_parameters_errors_and_agreement(fitted):
    done, out = fitted
    assert "um/V" in done.stdout
    assert "Two searches from other starts agree" in done.stdout
    assert "held-out" in done.stdout
    for name in ("model.json", "parameters.csv", "responses.csv", "fit.html"):
        assert (out / name).is_file(), name


def test_parameters_lie_within_their_standard_errors(fitted):
    parameters = pd.read_csv(fitted[1] / "parameters.csv").set_index("name")
    for name, true in (("a", 1.5), ("b", 0.4)):
        value, error = parameters.loc[name, ["value", "standard_error"]].astype(float)
        assert 0 < error < 0.05
        assert abs(value - true) < 4 * error


def test_model_file_follows_its_schema(fitted, data_file):
    content = json.loads((fitted[1] / "model.json").read_text(encoding="utf-8"))
    assert content["schema"] == 2
    assert content["model"] == "polynomial"
    assert content["units"]["output"] == "um"
    assert set(content["parameters"]["a"]) == {"value", "standard_error", "unit"}
    assert content["data"]["fitted"] == ["cubic:large"]
    assert content["data"]["held_out"] == ["cubic:small"]
    assert len(content["data"]["sha256"][0]) == 64
    assert set(content["error"]) == {"fitted", "held_out"}
    assert set(content["error"]["fitted"]) == {"rmse", "relative_rms", "max_error"}


def test_predict_replaces_the_output(fitted, tmp_path):
    data = tmp_path / "new.csv"
    data.write_text("time [s],input [V]\n0,0\n1,0.5\n2,1\n", encoding="utf-8")
    out = tmp_path / "predicted.csv"
    done = run_here("predict", fitted[1] / "model.json", data, "--out", out)
    assert done.returncode == 0, done.stderr
    predicted = pd.read_csv(out)
    assert list(predicted.columns) == ["time [s]", "input [V]", *(f"output{of} [um]" for of in ("", "_low", "_high"))]
    assert predicted["output [um]"].to_numpy() == pytest.approx([0, 1.5 * 0.5 + 0.4 * 0.125, 1.9], abs=0.02)


def test_the_same_seed_gives_the_same_model(fitted, data_file, tmp_path):
    arguments = ("--model", "polynomial", "--held-out", "cubic:small", "--budget", 1500)
    assert run_here("fit", data_file, *arguments, "--out", tmp_path / "fit").returncode == 0
    one, two = (json.loads((folder / "model.json").read_text()) for folder in (fitted[1], tmp_path / "fit"))
    assert one == two


def test_a_fit_with_an_effect_and_a_fixed_parameter(data_file, tmp_path):
    arguments = ("--effect", "bias", "--fix", "b=0.4", "--budget", 1000, "--out", tmp_path / "fit")
    done = run_here("fit", data_file, "--model", "polynomial", *arguments)
    assert done.returncode == 0, done.stderr
    content = json.loads((tmp_path / "fit" / "model.json").read_text())
    assert content["fixed"] == {"b": 0.4}
    assert abs(content["effects"][0]["parameters"]["offset"]["value"]) < 0.01


def test_two_searches_that_disagree_are_told(data_file, tmp_path):
    """On a budget of one evaluation nothing but the polish agrees; on a flat model nothing can."""
    arguments = ("--model", "polynomial", "--bounds", "a=-1:-0.5", "--bounds", "b=1:9", "--budget", 1)
    done = run_here("fit", data_file, *arguments, "--out", tmp_path / "fit")
    assert done.returncode == 0
    assert "edge of its box" in done.stdout.replace("\n", " ")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--model", "polynomal"], 'Did you mean "polynomial"'),
        (["--model", "polynomial", "--effect", "bais"], 'Did you mean "bias"'),
        (["--model", "polynomial", "--optimizer", "psoo"], 'no optimizer "psoo"'),
        (["--model", "polynomial", "--bounds", "a=5:1"], "low 5.0 is above high 1.0"),
        (["--model", "polynomial", "--bounds", "a:5=1"], "should read PARAMETER=LOW:HIGH"),
        (["--model", "polynomial", "--bounds", "z=0:1"], 'no parameter "z"'),
        (["--model", "polynomial", "--fix", "z=1"], 'no parameter "z"'),
        (["--model", "polynomial", "--held-out", "none"], "no record 'none'"),
        (["--model", "polynomial", "--skip", "5"], "leaves nothing"),
        (["--model", "polynomial", "--effect", "temperature-sensitivity"], "temperature"),
    ],
)
def test_faults_are_one_message_and_exit_2(data_file, tmp_path, arguments, told):
    done = run_here("fit", data_file, *arguments, "--out", tmp_path / "fit")
    assert done.returncode == 2, done.stdout
    assert told in " ".join(done.stderr.split())
    assert not (tmp_path / "fit").exists()


def test_a_loop_that_is_open_cannot_be_settled(tmp_path):
    data = tmp_path / "ramp.csv"
    data.write_text("time,input,output\n" + "".join(f"{i},{i},{i}\n" for i in range(20)), encoding="utf-8")
    done = run_command("fit", data, "--model", "polynomial", "--settle", "--out", tmp_path / "fit")
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "is not a closed loop" in done.stderr


def test_a_constant_output_is_nothing_to_identify(tmp_path):
    data = tmp_path / "flat.csv"
    data.write_text("time,input,output\n" + "".join(f"{i},{i},3\n" for i in range(20)), encoding="utf-8")
    done = run_here("fit", data, "--model", "polynomial", "--out", tmp_path / "fit")
    assert done.returncode == 2
    assert "output is constant" in done.stderr


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{}", "schema"),
        ("not json", "not valid JSON"),
        ('{"schema": 1, "model": "polynomial"}', "missing or wrong"),
        (
            '{"schema": 1, "model": "nix", "settings": {}, "units": {}, "parameters": {}, "effects": []}',
            'no model "nix"',
        ),
        (
            '{"schema": 1, "model": "polynomial", "settings": {}, "units": {}, "parameters": {}, "effects": []}',
            'parameter "a" is missing',
        ),
    ],
)
def test_a_broken_model_file_is_told(tmp_path, data_file, content, told):
    path = tmp_path / "model.json"
    path.write_text(content, encoding="utf-8")
    done = run_here("predict", path, data_file, "--out", tmp_path / "out.csv")
    assert done.returncode == 2
    assert told in done.stderr


def test_measure_is_seeded(tmp_path):
    files = [tmp_path / name for name in ("one.csv", "two.csv", "three.csv")]
    for file, seed in zip(files, (1, 1, 2), strict=True):
        assert run_here("measure", "sma", "pwm-60s", "--seed", seed, "--out", file).returncode == 0
    one, two, three = (file.read_text() for file in files)
    assert one == two != three
    assert one.startswith("time [s],input [degC],output [deg]")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["measure", "smaa", "pwm-60s", "--out", "x.csv"], 'Did you mean "sma"'),
        (["measure", "sma", "pwm-60", "--out", "x.csv"], 'Did you mean "pwm-60s"'),
        (["list", "modles"], 'Did you mean "models"'),
        (["repotr", "x"], 'Did you mean "report"'),
        (["report", "no-such-folder"], "holds no results"),
        (["run", "no-such-study.toml"], "No such file"),
    ],
)
def test_wrong_words_are_met_with_the_nearest_known(arguments, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run_here(*arguments)
    assert done.returncode == 2
    assert told in " ".join(done.stderr.split())


def test_broken_plugins_are_listed_with_their_fault():
    done = run_here("list")
    assert done.returncode == 0
    text = " ".join(done.stdout.split())
    assert "faulty-missing broken: AttributeError" in text
    assert "pwm-60s" in text


@pytest.mark.parametrize("arguments", [["--help"], ["list"], ["list", "studies"], ["fit", "x.csv"]])
def test_help_lists_and_faults_import_neither_numba_nor_matplotlib(arguments, tmp_path):
    code = (
        "import sys\nfrom hysteresis_bench.cli import main\n"
        f"try:\n    main({arguments!r})\nexcept SystemExit:\n    pass\n"
        "slow = {'numba', 'matplotlib', 'scipy', 'pandas'} & set(sys.modules)\nassert not slow, slow\n"
    )
    done = subprocess.run([sys.executable, "-c", code], env=ENVIRONMENT, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr


def test_the_module_is_the_command():
    assert subprocess.run([*COMMAND, "--version"], env=ENVIRONMENT, capture_output=True).returncode == 0
