"""Units of columns: the same, converted, refused; and told."""

import contextlib
import string

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.units import converted, frequency_in, in_units, rounded, same_unit, seconds_in
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record

MODEL = {"time": "s", "input": "V", "output": "um", "temperature": "degC"}


def in_model_units(units, **columns):
    record = Record(np.arange(3.0), np.array([0.0, 1.0, 2.0]), None, units=units, columns=columns)
    return in_units(Dataset((record,)), MODEL, "new.csv", "the model's")


@pytest.mark.parametrize(
    ("one", "other"),
    [("um", "µm"), ("um", "μm"), ("degC", "°C"), ("deg C", "degC"), ("C/m^2", "C/m²"), ("uC/cm2", "uC/cm^2"),
     ("N.m", "Nm"), ("deg", "°"), ("1", "mm/mm"), ("a.u.", "a.u."), ("sample", "sample")],
)  # fmt: skip
def test_one_unit_in_two_spellings(one, other):
    assert same_unit(one, other)
    values = np.array([1.0, 2.0])
    assert converted(values, one, other) is values


@pytest.mark.parametrize(
    ("value", "unit", "wanted", "expected"),
    [
        (1.0, "ms", "s", 1e-3), (2.0, "kV", "V", 2000.0), (20.0, "degC", "K", 293.15), (300.0, "K", "°C", 26.85),
        (50.0, "degF", "degC", 10.0), (1.0, "uC/cm2", "C/m^2", 0.01), (5.0, "%", "1", 0.05),
        (180.0, "deg", "rad", np.pi),
        (1.0, "Oe", "A/m", 1000.0 / (4.0 * np.pi)), (1.0, "kNm", "N m", 1000.0),
    ],
)  # fmt: skip
def test_conversions(value, unit, wanted, expected):
    assert converted(np.array([value]), unit, wanted)[0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("unit", "wanted"), [("N", "V"), ("s", "sample"), ("a.u.", "um"), ("a.u.", "s"), ("counts.", "V"), ("9**9**9", "m")]
)
def test_what_does_not_convert(unit, wanted):
    with pytest.raises(ValueError, match="does not convert into"):
        converted(np.ones(2), unit, wanted)


@pytest.mark.parametrize(
    ("value", "words"), [(123.4, "120"), (0.00123, "0.0012"), (1.0, "1"), (98765.0, "99000"), (3.71e7, "3.7e+07")]
)
def test_numbers_in_sentences_have_no_needless_powers_of_ten(value, words):
    assert rounded(value) == words


def test_a_unit_where_the_model_has_none_is_refused_with_what_to_do():
    record = Record(np.arange(3.0), np.arange(3.0), None, units={"time": "s", "input": "kg"})
    with pytest.raises(UserError, match="is in kg, the model's input has none: take it out of the header, or fit with"):
        in_units(Dataset((record,)), {"time": "s", "input": "1", "output": "1"}, "new.csv", "the model's")


def test_a_column_that_the_model_does_not_know_is_told_once():
    found = in_model_units({"time": "s", "input": "V", "output": "um", "load": "N"}, load=np.ones(3))
    said = "new.csv: load is read in N, without conversion: the model's unit of load is not stated."
    assert found.notes == (said,)
    assert in_units(found, MODEL, "the records", "the model's").notes == (said,)


@pytest.mark.parametrize(
    ("unit", "words"), [("s", "2 Hz"), ("sec", "2 Hz"), ("ms", "2 cycles a ms"), ("1", "2 cycles a unit of time")]
)
def test_a_frequency_in_words(unit, words):
    assert frequency_in(unit, 2.0) == words


def test_conversions_are_told_in_one_line():
    found = in_model_units({"time": "ms", "input": "kV", "temperature": "K"}, temperature=np.full(3, 293.15))
    record = found.records[0]
    assert record.time == pytest.approx([0.0, 1e-3, 2e-3])
    assert record.input == pytest.approx([0.0, 1e3, 2e3])
    assert record.columns["temperature"] == pytest.approx([20.0] * 3)
    assert dict(record.units) == MODEL
    assert found.notes == (
        "new.csv: time [ms] was converted to s, input [kV] was converted to V, temperature [K] was converted to degC.",
    )


def test_absent_units_are_the_models_and_told():
    found = in_model_units({"time": "s"})
    assert found.notes == ("new.csv: no unit is stated; taken as the model's: input as V.",)
    assert found.records[0].units["input"] == "V"


def test_every_column_that_does_not_convert_is_named_with_both_units():
    with pytest.raises(UserError, match=r'2 faults.*"input" is in N, the model.s input in V.*"temperature" is in Pa'):
        in_model_units({"input": "N", "temperature": "Pa"}, temperature=np.ones(3))


def test_records_of_other_units_are_fitted_together(tmp_path):
    for name, header, top in (("a", "time [s],input [V],output [um]", 2), ("b", "time [ms],input [mV],output", 2000)):
        (tmp_path / f"{name}.csv").write_text(f"{header}\n0,0,0\n1,{top},1\n2,0,0\n", encoding="utf-8")
    found = read_data([tmp_path / "a.csv", tmp_path / "b.csv"])
    first, second = found.records
    assert second.input == pytest.approx(first.input)
    assert second.time == pytest.approx(1e-3 * first.time)
    assert second.units == first.units
    assert len(found.notes) == 2
    assert "taken as the other records': output as um" in found.notes[1]


def test_index_time_stays_an_index(tmp_path):
    path = tmp_path / "loop.csv"
    path.write_text("time [sample],input,output\n0,0,0\n1,1,1\n", encoding="utf-8")
    assert not read_data([path], units={**MODEL, "time": "sample"}).records[0].timed
    with pytest.raises(UserError, match="sample does not convert into s"):
        read_data([path], units=MODEL)
    assert seconds_in("sample", 5.0) == 5.0
    assert seconds_in("ms", 0.5) == pytest.approx(500.0)


units = st.sampled_from(["um", "mm", "V", "kV", "degC", "K", "%", "1", "deg", "A/m", "Oe", "T", "s", "min"])


@settings(max_examples=60, deadline=None)
@given(units, units, st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=4))
def test_there_and_back(one, other, values):
    given_values = np.array(values)
    try:
        there = converted(given_values, one, other)
    except ValueError:
        return
    np.testing.assert_allclose(converted(there, other, one), given_values, rtol=1e-9, atol=1e-6)


@settings(max_examples=150, deadline=2000)
@given(st.text(alphabet=string.ascii_letters + string.digits + "µ°%^*/().- ²", max_size=12))
def test_no_text_is_a_riddle(text):
    """Whatever a header says: the same unit as itself, and a sentence at worst."""
    assert same_unit(text, text)
    with contextlib.suppress(ValueError):
        assert np.isfinite(converted(np.ones(1), text, "V")).all()
