"""Where no formula of an effect fits, its family is told, with the curve in the model; where one fits, its name."""

import json

import numpy as np
import pytest
from scipy.signal import lfilter

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.around import concluded, searched
from hysteresis_bench.diagnosis.families import course
from hysteresis_bench.diagnosis.findings.diagnosis_file import read_diagnosis, write_diagnosis
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.fallback import unseen_rmse
from hysteresis_bench.diagnosis.search.free_forms import with_free_forms
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.fit.model_file import read_model
from hysteresis_bench.report.diagnosis.page import write_diagnosis_page
from hysteresis_bench.signals import Record, joined
from hysteresis_plugins.effects import drift

FITTED = ("slow", "nested")
X = np.linspace(0.0, 1.0, 50)


@pytest.fixture(scope="module")
def diffusive():
    """Records whose zero runs away with the square root of time, an unseen one, and what is diagnosed of the first."""
    rig = HiddenEffects(effects=("drift",), draw=2, other=True)
    assert rig._form("drift") is drift._diffusive
    rng = np.random.default_rng(4)
    seen = joined(*(rig.measure(name, rng) for name in (*FITTED, "mixed"))).split(["mixed"])
    question = Question("bouc-wen", among=("creep", "drift", "droop", "leakage"), options=DiagnosisOptions(jobs=1))
    found = concluded(searched(seen, question), ("dahl",))  # of other laws one is asked, as all would take long
    return seen, rig.measure("stairs", rng), found


def test_the_family_is_named_where_no_formula_fits(diffusive):
    _, _, found = diffusive
    assert found.effects == ("zero-with-time",)
    assert found.verdict == "effect-found"
    (family,) = found.families
    assert family.family == "change with time, path or temperature"
    assert family.family in found.headline
    assert (family.curve.x_unit, family.curve.along) == ("s", "time")
    curve = family.curve.y / family.curve.y[-1]
    assert np.max(np.abs(curve - np.sqrt(family.curve.x / family.curve.x[-1]))) < 0.1


def test_predict_uses_the_curve(diffusive, tmp_path):
    seen, unseen, found = diffusive
    write_diagnosis(tmp_path / "out", found)
    predicted = read_model(tmp_path / "out" / "model.json").predict(unseen)
    error = predicted.records[0].output - unseen.records[0].output
    assert np.sqrt(np.mean(error**2)) < 1.15 * seen.hidden["noise"]


def test_the_files_and_the_page_tell_the_family(diffusive, tmp_path):
    _, _, found = diffusive
    write_diagnosis(tmp_path, found)
    (kept,) = read_diagnosis(tmp_path).diagnosis["families"]
    assert kept["effect"] == "zero-with-time"
    assert len(kept["curve"]["x"]) == len(kept["curve"]["y"]) > 10
    page = write_diagnosis_page(tmp_path).read_text(encoding="utf-8")
    assert "What no formula here fits" in page
    assert "the zero of the output" in page
    old = json.loads((tmp_path / "diagnosis.json").read_text(encoding="utf-8"))
    del old["families"]
    (tmp_path / "diagnosis.json").write_text(json.dumps(old), encoding="utf-8")
    assert read_diagnosis(tmp_path).diagnosis["families"] == []


@pytest.mark.parametrize(
    ("y", "words"),
    [
        (X, "rises"),
        (-X, "falls"),
        (1.0 - np.exp(-6.0 * X), "rises and levels off"),
        (X**4, "rises, faster at the end"),
        (X * (1.0 - X), "rises, then falls"),
        (-X * (1.0 - X), "falls, then rises"),
        (np.sin(20.0 * X), "goes up and down"),
        (0.0 * X, "does not change"),
    ],
)
def test_a_course_is_told_in_words(y, words):
    assert course(X, y) == words


@pytest.mark.long
def test_a_law_far_from_the_noise_takes_the_shape_that_predicts_what_is_left_out():
    """A curve has no dynamics: with it a law of another shape is just another law, where it is no cause."""
    rng, records = np.random.default_rng(0), []
    model = registry.build("models", "jiles-atherton")
    for time, u, y in responses(model, 500, ((1.0, 0.3), (0.7, 0.5), (0.85, 0.4))):
        noisy = y + 0.001 * np.ptp(y) * rng.standard_normal(y.size)
        records.append(Record(time, u, noisy, name=f"run {len(records)}"))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen", {}), tuple(records)))
    floor = 0.001 * float(np.ptp(records[0].output))
    selection = Selection(fitter, Workers(fitter, 1), floor, ())
    bare = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    found = with_free_forms(selection, bare)
    curves = selection.adopted(found)
    assert curves
    assert {*curves} <= {"input-curve", "output-curve", "parallel-curve"}
    assert found.rmse > 1.2 * floor, "it is no name"
    assert unseen_rmse(fitter, found) < 0.3 * unseen_rmse(fitter, bare)


@pytest.mark.long
def test_free_forms_join_far_from_the_noise_where_nearly_all_that_is_left_out_is_predicted():
    """Two relaxations and a square root of time, no formula of the program's, around a law a little wrong."""
    rng, records = np.random.default_rng(0), []
    model = registry.build("models", "bouc-wen")
    for time, u, y in responses(model, 300, ((1.0, 0.3), (0.7, 2.0), (0.85, 0.8))):
        size = np.ptp(y)
        y += 0.008 * size * np.sin(9.0 * u / model.example.amplitude)  # the fault
        y = 0.6 * _relaxed(time, y, 0.03) + 0.4 * _relaxed(time, y, 0.4) + 0.2 * size * np.sqrt(time / time[-1])
        noisy = y + 0.002 * size * rng.standard_normal(y.size)
        records.append(Record(time, u, noisy, name=f"run {len(records)}"))
    fitter = Fitter(Stack(model, tuple(records)))
    floor = 0.002 * float(np.ptp(records[0].output))
    selection = Selection(fitter, Workers(fitter, 1), floor, ())
    bare = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    found = with_free_forms(selection, bare)
    forms = {"lags-after", "zero-with-time"}
    assert forms <= {*selection.adopted(found)} <= {*forms, "input-curve"}, "the fault is a curve of the input"
    assert found.rmse > 1.2 * floor, "the law is wrong"
    assert unseen_rmse(fitter, found) < 0.3 * unseen_rmse(fitter, bare)


def _relaxed(time, y, constant):
    kept = np.exp(-time[1] / constant)
    return y[0] + lfilter([1.0 - kept], [1.0, -kept], y - y[0])


def responses(model, samples, excitations):
    """Time, input and output of a model's example; excitations : share of its amplitude, and frequency in Hz."""
    example, time = model.example, np.linspace(0.0, 10.0, samples)
    values = np.array([example.parameters[p.name] for p in model.parameters])[:, None]
    for share, frequency in excitations:
        u = example.amplitude * share * np.sin(2 * np.pi * frequency * time) * (0.6 + 0.04 * time)
        yield time, u, System(model).simulate(Record(time, u, None).signal, values)[:, 0]
