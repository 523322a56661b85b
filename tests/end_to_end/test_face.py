"""The Python face: seven functions, light to import, with full signatures and results that a notebook shows."""

import inspect
import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import hysteresis_bench
from hysteresis_bench import DiagnosisOptions, FitOptions, control, diagnose, fit, load, measure, predict, run_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import Estimate, FittedModel, write_model
from hysteresis_bench.signals import Dataset
from tests.conftest import record
from tests.end_to_end.test_run import ENVIRONMENT, write_study

PUBLISHED = {"alpha": 0.3575, "beta": 0.0364, "gamma": 0.0272, "d": 1.0458}
UNITS = {"time": "s", "input": "V", "output": "um"}

IN_A_FRESH_PROCESS = """
import json, sys
import hysteresis_bench as face
slow = sorted({"numba", "numpy", "pandas", "scipy"} & set(sys.modules))
import hysteresis_bench.control.comparison, hysteresis_bench.fit.fitting
print(json.dumps([slow, [name for name in face.__all__ if not callable(getattr(face, name))]]))
"""


def test_it_is_light_and_its_names_stay_functions():
    command = [sys.executable, "-c", IN_A_FRESH_PROCESS]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == [[], []]


@pytest.mark.parametrize("name", hysteresis_bench.__all__)
def test_every_function_names_its_parameters(name):
    function = getattr(hysteresis_bench, name)
    parameters = inspect.signature(function).parameters.values()
    assert len(parameters) <= 7
    assert not any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters)
    assert "Raises UserError" in function.__doc__


def test_fit_and_predict_from_files(tmp_path):
    known = record(120)
    frame = pd.DataFrame({"time": known.time, "input": known.input, "output": known.output})
    for name in ("a", "b"):
        frame.to_csv(tmp_path / f"{name}.csv", index=False)
    data = load(tmp_path / "a.csv", tmp_path / "b.csv", held_out=["b"])
    found = fit(data, "polynomial", fixed={"b": 0.5}, options=FitOptions(budget=300, seed=2))
    assert found.model.parameters["a"].value == pytest.approx(1.0)
    assert "seed 2" in found.notes[0]
    write_model(tmp_path / "model.json", found.model)
    predicted = predict(tmp_path / "model.json", tmp_path / "b.csv")
    np.testing.assert_allclose(predicted.records[0].output, known.output, atol=1e-6)
    html = found._repr_html_()
    assert "polynomial" in html
    assert html.count("<table") == 2
    assert "held-out" in data._repr_html_()


def test_measure_names_what_is_unknown():
    together, alone = measure("sma", "pwm-60s", "pwm-50s", seed=1), measure("sma", "pwm-50s", seed=1)
    assert together.names == ("pwm-60s", "pwm-50s")
    np.testing.assert_array_equal(alone.records[0].output, together.records[1].output)
    with pytest.raises(UserError, match="has 2 faults"):
        measure("sma", "pwm-6", "steppes")
    with pytest.raises(UserError, match="name an experiment"):
        measure("sma")


def test_control_on_a_rig_that_can_be_stepped():
    estimates = {name: Estimate(value, None, "1") for name, value in PUBLISHED.items()}
    model = FittedModel("bouc-wen", {}, (), {}, UNITS, estimates)
    found = control(model, "pea", rate=2000.0)
    assert found.conditions["rate"] == 2000.0
    assert "<table" in found._repr_html_()
    with pytest.raises(UserError, match="sma cannot be run sample by sample"):
        control(model, "sma")
    falling = {name: Estimate(value, None, "1") for name, value in (("a", -1.0), ("b", 0.0))}
    with pytest.raises(UserError, match="No inverse: the output falls"):
        control(FittedModel("polynomial", {}, (), {}, UNITS, falling), "pea")


def test_diagnose_shows_what_it_found():
    known = record(240)
    noise = 0.01 * np.random.default_rng(0).standard_normal(240)
    noisy = Dataset((replace(known, output=known.output + noise),))
    found = diagnose(noisy, "polynomial", options=DiagnosisOptions(jobs=1))
    html = found._repr_html_()
    assert found.headline.split()[0] in html
    assert html.count("<table") == 2


def test_a_study_is_read_after_it_ran(tmp_path):
    steps = []
    results = run_study(write_study(tmp_path, ["pso"]), trials=1, jobs=1, on_progress=steps.append)
    assert list(results.trials["status"]) == ["done"]
    assert [(step.done, step.total) for step in steps] == [(0, 1), (1, 1)]
    assert "pso" in results._repr_html_()


def test_a_platform_without_locks_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "fcntl", None)
    with pytest.raises(UserError, match="this platform has no fcntl"):
        run_study(write_study(tmp_path, ["pso"]), trials=1, jobs=1)
