"""Laws and effects with constants of their own get the columns in the units of these, or refuse them."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import FitOptions, compare, fit, measure, registry
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.laws.exclusion import unlike_in_unit
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.checks.wanted_units import in_wanted_units, unlike_wanted
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.study_file import ProblemSpec

ROD = "free-energy-gma"


@pytest.fixture(scope="module")
def rod():
    return measure("gma", "sine-100hz")


def rewritten(dataset, **changes):
    """changes : by column, its factor and its unit"""

    def one(record):
        values = {"time": record.time, "input": record.input, "output": record.output}
        units = dict(record.units)
        for column, (factor, unit) in changes.items():
            values[column], units[column] = factor * values[column], unit
        return replace(record, **values, units=units)

    return dataset.map(one)


@pytest.mark.parametrize(
    "changes", [{"input": (1e3, "mA")}, {"output": (1e-3, "mm")}, {"time": (1e3, "ms")}, {"input": (1.0, "1")}]
)
def test_a_rod_gets_amperes_seconds_and_micrometres(rod, changes):
    (found,) = in_wanted_units(rewritten(rod, **changes), [registry.build("models", ROD)], "the model's").records
    (wanted,) = rod.records
    for column in ("time", "input", "output"):
        assert np.allclose(getattr(found, column), getattr(wanted, column), rtol=1e-12)
        assert found.units[column] == wanted.units[column]


def test_the_fit_says_what_it_converted_and_predicts_in_the_same_units(rod):
    quick = FitOptions(budget=60)
    plain, milli = (
        fit(data, ROD, options=quick) for data in (rod, rewritten(rod, input=(1e3, "mA"), output=(1e-3, "mm")))
    )
    assert any("input [mA] was converted to A, output [mm] was converted to um" in note for note in milli.notes)
    assert milli.model.units["output"] == "um"
    assert milli.model.error["fitted"]["rmse"] == pytest.approx(plain.model.error["fitted"]["rmse"], rel=1e-3)


def test_what_does_not_convert_is_a_fault_and_excludes_the_law(rod):
    volts = rewritten(rod, input=(1.0, "V"))
    with pytest.raises(UserError, match="in V, the model's input in A"):
        fit(volts, ROD)
    assert "takes the input in A, and the records have it in V" in unlike_in_unit([ROD, "bouc-wen"], volts.records)[ROD]
    assert unlike_in_unit([ROD, "bouc-wen"], rod.records) == {}
    told = compare(volts, options=DiagnosisOptions(laws=[ROD, "dahl"], jobs=1))
    assert "takes the input in A" in told.table.set_index("law")["reason"][ROD]


def warmed(unit, degrees):
    """A Bouc-Wen actuator whose gain falls with a temperature that a column tells in some unit."""
    (record,) = measure("hidden-effects", "slow").records
    celsius = 20.0 + 15.0 * np.sin(np.linspace(0.0, 5.0, record.time.size))
    output = record.output * (1.0 + 0.01 * (celsius - 20.0))
    units = {**record.units, "temperature": unit}
    return Dataset((replace(record, output=output, columns={"temperature": degrees(celsius)}, units=units),))


def test_kelvin_and_fahrenheit_are_degrees_celsius():
    quick = FitOptions(budget=600)
    kinds = {"degC": lambda t: t, "K": lambda t: t + 273.15, "degF": lambda t: 1.8 * t + 32.0}
    gains = [
        fit(warmed(unit, degrees), "bouc-wen", ["temperature-sensitivity"], options=quick).model.parameters[
            "temperature-sensitivity.gain"
        ]
        for unit, degrees in kinds.items()
    ]
    assert {one.unit for one in gains} == {"1/K"}
    assert [one.value for one in gains] == pytest.approx(3 * [0.01], rel=0.02)


def test_columns_that_are_in_any_unit_are_told_nothing_of_and_keep_theirs(rod):
    """A diagnosis asks every effect what it wants: a sentence on each column would hide all others."""
    milli = rewritten(rod, input=(1e3, "mA"))
    found = in_wanted_units(milli, [registry.effect("temperature-sensitivity")], "temperature-sensitivity's")
    assert found.notes == milli.notes
    assert found.units == milli.units


def test_a_temperature_in_volts_is_not_in_question():
    volts, kelvin = (warmed(unit, lambda t: t) for unit in ("V", "K"))
    question = Question("bouc-wen")
    assert question.in_wanted_units(kelvin).units["temperature"] == "degC"
    kept = question.in_wanted_units(volts)
    assert kept.units["temperature"] == "V"
    stack = Stack(registry.build("models", "bouc-wen"), kept.records)
    assert "in degC, and the records have it in V" in stack.candidates()[1]["temperature-sensitivity"]
    assert "response-with-temperature" not in stack.free_forms()
    with pytest.raises(UserError, match="in V, the model's temperature in degC"):
        Question("bouc-wen", ["temperature-sensitivity"]).in_wanted_units(volts)


def test_a_time_that_is_only_an_index_wants_nothing(rod):
    index = rod.map(lambda record: replace(record, units={**record.units, "time": "sample"}))
    assert unlike_wanted(registry.build("models", ROD), index.records) == ""
    assert in_wanted_units(index, [registry.build("models", ROD)], "the model's").units["time"] == "sample"


def test_a_rate_has_the_unit_of_the_time():
    milliseconds = {"time": "ms", "input": "V", "output": "um"}
    own = {one.name: one.unit_in(milliseconds) for one in registry.build("models", "hammerstein").parameters}
    assert (own["k_over_m"], own["c_over_m"], own["b"]) == ("1/ms^2", "1/ms", "1/ms^2")


def test_a_problem_of_a_study_converts_its_files_as_well(rod, tmp_path):
    write_csv(tmp_path / "rod.csv", rewritten(rod, input=(1e3, "mA")))
    spec = ProblemSpec(name="rod", data=["rod.csv"], model=ROD)
    built = build_problem(spec, 0, tmp_path)
    assert np.allclose(built.problem.records[0].input, rod.records[0].input, rtol=1e-6)
    assert built.dataset.units["input"] == "A"
