"""Effects inside the state equation: a model offers them, and a user meets them like any other effect."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.fitting import FitOptions, fit_records
from hysteresis_bench.fit.model_file import read_model, write_model
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import INDEX, Dataset, Record
from hysteresis_bench.study.problems import build_problem, build_system
from hysteresis_bench.study.study_file import check_study
from tests.end_to_end.test_run import run_command

EDDY = "eddy-current"
NAME = "eddy-current.coefficient"
TRUTH = {"alpha": 0.6, "beta": 2.0, "gamma": 0.5, "d": 1.3, NAME: 0.03}
UNITS = {"time": "s", "input": "A", "output": "T"}

offering = pytest.mark.parametrize("model", registry.offered()[EDDY])


def measured(samples: int = 161) -> Record:
    """Two tones, and an output like a lagging loop's."""
    time = np.linspace(0.0, 2.0, samples)
    drive = np.sin(2 * np.pi * time) + 0.4 * np.sin(7 * np.pi * time)
    return Record(time, drive, 1.3 * drive - 0.3 * np.cos(2 * np.pi * time), units=UNITS)


def drawn(system: System, record: Record, swarm: int) -> np.ndarray:
    space = Space(system.box([record]))
    return space.from_unit(np.random.default_rng(4).random((space.dimension, swarm)))


def test_the_models_with_room_are_known():
    laws = ("bouc-wen", "free-energy", "free-energy-gma", "jiles-atherton", "jiles-atherton-clamped")
    assert registry.offered()[EDDY] == laws


@offering
def test_it_adds_its_own_parameter_and_leaves_the_others_alone(model):
    alone, around = build_system(model), build_system(model, effects=[EDDY])
    assert [q.name for q in alone.parameters] == [q.name for q in alone.model.parameters]
    assert around.parameters[:-1] == alone.parameters
    assert around.parameters[-1].name == NAME
    assert around.parameters[-1].null == 0.0
    assert around.parameters[-1].unit_in(UNITS) == ("s" if model == "free-energy-gma" else "A s/T")
    record = measured()
    assert around.box([record])[:-1] == alone.box([record])
    assert around.box([record])[-1].faults() == []


@offering
@pytest.mark.parametrize("own_input", [False, True])
def test_null_is_the_model_bit_for_bit(model, own_input):
    record = measured()
    alone, around = build_system(model), build_system(model, effects=[EDDY])
    values = drawn(around, record, 7)
    signal = record.signal
    if own_input:
        signal = signal.with_input(record.input[:, None] * np.linspace(0.5, 1.0, 7))
    expected = alone.simulate(signal, values[:-1])
    values[-1] = 0.0
    assert np.array_equal(around.simulate(signal, values), expected)
    values[-1, 1::2] = around.box([record])[-1].upper
    mixed = around.simulate(signal, values)
    assert np.array_equal(mixed[:, ::2], expected[:, ::2])
    assert np.all(np.max(np.abs(mixed - expected)[:, 1::2], axis=0) > 0)


@offering
def test_a_time_that_is_only_an_index_switches_it_off(model):
    record = replace(measured(), units={**UNITS, "time": INDEX})
    around = build_system(model, effects=[EDDY])
    values = drawn(around, record, 3)
    assert np.array_equal(
        around.simulate(record.signal, values), build_system(model).simulate(record.signal, values[:-1])
    )
    assert "only an index" in around.effects[0][1].inapplicable([record])


@offering
def test_it_acts_inside_wherever_it_stands(model):
    record = measured()
    inner, outer = (build_system(model, effects=names) for names in ([EDDY, "input-lag"], ["input-lag", EDDY]))
    values = drawn(inner, record, 3)
    found = inner.simulate(record.signal, values)
    values[-2:] = values[[-1, -2]]
    assert np.array_equal(outer.simulate(record.signal, values), found)


@offering
def test_swarm_fixed_and_arguments(model):
    record = measured()
    around = build_system(model, effects=[EDDY])
    values = drawn(around, record, 5)
    before = values.copy()
    together = around.simulate(record.signal, values)
    assert np.array_equal(values, before)
    assert np.array_equal(record.input, measured().input)
    for j in range(5):
        alone = around.simulate(record.signal, values[:, j : j + 1])
        np.testing.assert_allclose(alone[:, 0], together[:, j], rtol=1e-9, atol=1e-12)
    fixed = replace(around, fixed={NAME: float(values[-1, 0])})
    assert NAME not in [q.name for q in fixed.parameters]
    np.testing.assert_allclose(fixed.simulate(record.signal, values[:-1, :1])[:, 0], together[:, 0], rtol=1e-9)


def test_its_box_and_response_carry_units():
    record = measured()
    scale = {"input": 40.0, "output": 1e-3, "time": 250.0}
    scaled = {key: factor * getattr(record, key) for key, factor in scale.items()}
    other = replace(record, **scaled)
    around = build_system("bouc-wen", effects=[EDDY])
    factor = scale["input"] * scale["time"] / scale["output"]
    here, there = (around.box([r])[-1] for r in (record, other))
    np.testing.assert_allclose([there.lower, there.upper], [factor * here.lower, factor * here.upper], rtol=1e-9)
    values = np.array([[x] for x in TRUTH.values()])
    factors = np.array([[1.0], [1 / 40.0], [1 / 40.0], [1e-3 / 40.0], [factor]])
    again = around.simulate(other.signal, factors * values)
    np.testing.assert_allclose(again, 1e-3 * around.simulate(record.signal, values), rtol=1e-9, atol=1e-14)


@pytest.fixture(scope="module")
def lagging(tmp_path_factory):
    """Bouc-Wen data with eddy currents at two frequencies, as a file."""
    rng = np.random.default_rng(6)
    system = build_system("bouc-wen", effects=[EDDY])
    frames = []
    for run, frequency in (("slow", 0.5), ("fast", 4.0)):
        time = np.linspace(0.0, 2.0 / frequency, 241)
        drive = np.sin(2 * np.pi * frequency * time)
        output = system.simulate(Record(time, drive, None).signal, np.array([[x] for x in TRUTH.values()]))[:, 0]
        output += 0.002 * rng.normal(size=time.size)
        frames.append(pd.DataFrame({"time [s]": time, "input [A]": drive, "output [T]": output, "run": run}))
    path = tmp_path_factory.mktemp("lagging") / "lagging.csv"
    pd.concat(frames).to_csv(path, index=False)
    return path


def test_a_fit_recovers_it_and_its_file_is_the_same_model(lagging, tmp_path):
    from hysteresis_bench.data.data_files import read_data

    dataset = read_data([lagging])
    found = fit_records(dataset, "bouc-wen", [EDDY], options=FitOptions(budget=1500))
    estimate = found.model.parameters[NAME]
    assert estimate.unit == "A s/T"
    assert abs(estimate.value - TRUTH[NAME]) < 4 * estimate.standard_error < 0.1 * TRUTH[NAME]
    without = fit_records(dataset, "bouc-wen", options=FitOptions(budget=1500))
    assert without.records["rmse"].max() > 5 * found.records["rmse"].max()
    write_model(tmp_path / "model.json", found.model)
    content = json.loads((tmp_path / "model.json").read_text(encoding="utf-8"))
    assert NAME not in content["parameters"]
    assert content["effects"][0]["effect"] == EDDY
    assert content["effects"][0]["parameters"]["coefficient"]["value"] == estimate.value
    again = read_model(tmp_path / "model.json")
    for one, two in zip(found.model.predict(dataset).records, again.predict(dataset).records, strict=True):
        assert np.array_equal(one.output, two.output)


@pytest.mark.long
def test_the_command_line_fits_predicts_and_lists_it(lagging, tmp_path):
    done = run_command(
        "fit", lagging, "--model", "bouc-wen", "--effect", EDDY, "--budget", 800, "--out", tmp_path / "fit"
    )
    assert done.returncode == 0, done.stderr
    assert NAME in done.stdout
    done = run_command("predict", tmp_path / "fit" / "model.json", lagging, "--out", tmp_path / "out.csv")
    assert done.returncode == 0, done.stderr
    both = (pd.read_csv(path)["output [T]"].to_numpy() for path in (lagging, tmp_path / "out.csv"))
    assert np.std(np.subtract(*both)) < 0.004
    told = run_command("list", "effects").stdout
    assert EDDY in told
    assert "bouc-wen, free-energy" in " ".join(told.split())


def test_a_model_without_room_says_who_has_it(lagging):
    dataset = Dataset((measured(),))
    with pytest.raises(UserError, match="polynomial has no room for eddy-current; models that offer it: bouc-wen, "):
        fit_records(dataset, "polynomial", [EDDY])
    with pytest.raises(ValueError, match="no room for eddy-current"):
        build_system("polynomial", effects=[EDDY])
    with pytest.raises(UserError, match=r'no effect "edy-current".*Did you mean "eddy-current"'):
        fit_records(dataset, "bouc-wen", ["edy-current"])
    untimed = dataset.map(lambda record: replace(record, units={**UNITS, "time": INDEX}))
    with pytest.raises(UserError, match="only an index"):
        fit_records(untimed, "bouc-wen", [EDDY])


def test_a_study_file_may_ask_for_it(lagging):
    problem = {"name": "lagging", "model": "bouc-wen", "data": [str(lagging)], "effects": [EDDY], "box": "data"}
    raw = {"title": "t", "seed": 1, "problem": [problem], "optimizer": [{"plugin": "pso"}]}
    study = check_study(raw, "study")
    built = build_problem(study.problem[0], study.seed, lagging.parent)
    assert built.problem.space.names == tuple(TRUTH)
    losses = built.problem.losses(built.problem.space.to_unit(np.array([[x] for x in TRUTH.values()])))
    assert losses[0] == pytest.approx(0.002, rel=0.1)
    problem["model"] = "polynomial"
    with pytest.raises(UserError, match="polynomial has no room for eddy-current"):
        check_study(raw, "study")
