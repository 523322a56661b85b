"""Ill-formed but ordinary files: read right, or one sentence that names what helps."""

import numpy as np
import pytest

from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.layout import Layout
from hysteresis_bench.data.readers.numbers import Ambiguous, decimal_mark, number
from hysteresis_bench.data.readers.sheet import parted
from hysteresis_bench.errors import UserError
from tests.data.ill_formed import CASES, INPUT, OUTPUT, TIME, mat_73


@pytest.mark.parametrize("name", CASES)
def test_it_is_read_right_or_told(tmp_path, name):
    case = CASES[name]
    if case.suffix in (".xlsx", ".h5"):
        pytest.importorskip({".xlsx": "openpyxl", ".h5": "h5py"}[case.suffix])
    path = tmp_path / f"bench{case.suffix}"
    case.write(path)
    if case.said:
        with pytest.raises(UserError) as error:
            read_data([path], layout=Layout(**case.layout))
        assert case.said in str(error.value)
        assert len(error.value.faults) <= 3
        return
    dataset = read_data([path], layout=Layout(**case.layout))
    assert len(dataset.records) == case.records
    kept = np.delete(np.arange(TIME.size), case.lost)
    for record in dataset.records:
        np.testing.assert_allclose(record.time - record.time[0], TIME[kept] - TIME[kept][0], atol=1e-9)
        np.testing.assert_allclose(record.input, INPUT[kept], atol=1e-6)
        np.testing.assert_allclose(record.output, OUTPUT[kept], atol=1e-6)
    for role, unit in case.units.items():
        assert record.units[role] == unit
    (row, *_) = dataset.understood
    assert row["samples"] == str(kept.size)
    assert row["gaps"] == str(len(case.lost))
    assert case.told in " ".join(dataset.notes)
    assert bool(case.lost) == any("left out (row" in note for note in dataset.notes)


def test_there_are_forty():
    assert len(CASES) >= 40


@pytest.mark.parametrize(
    ("cells", "mark"),
    [
        (["1,5", "2,25"], ","),
        (["0,123"], ","),
        (["1.5", "2"], "."),
        (["1.234,5"], ","),
        (["1,234.5", "1,234"], "."),
        (["1,234,567"], "."),
        (["1,234", "0,5"], ","),
        (["1,234", "1,5e-3"], ","),
        (["1.234", "text, with a comma"], "."),
        (["1,234"], None),
        (["1,234", "0.5"], None),
        (["1.234", "0,5"], None),
        (["0.5", "0,5"], None),
    ],
)
def test_a_decimal_mark_is_certain_or_asked_for(cells, mark):
    rows = list(enumerate(cells, start=1))
    if mark is None:
        with pytest.raises(Ambiguous, match="--decimal"):
            decimal_mark(rows)
    else:
        assert decimal_mark(rows) == mark


def test_numbers_in_both_notations():
    assert number("1.234,5", ",") == 1234.5
    assert number("1,234.5", ".") == 1234.5
    assert number("−1,5D-3", ",") == -1.5e-3
    assert np.isnan([number(text, ",") for text in ("1.5", "1_0", "x")]).all()


def test_an_ambiguous_mark_is_decided_by_the_user(tmp_path):
    case = CASES["thousands or decimals"]
    case.write(tmp_path / "a.csv")
    decimal, thousands = (read_data([tmp_path / "a.csv"], layout=Layout(decimal=mark)).records[0] for mark in ",.")
    assert decimal.input[7] == 1.007
    assert thousands.input[7] == 1007.0


def test_a_layout_tells_all_faults():
    with pytest.raises(UserError, match="has 4 faults"):
        Layout(delimiter="x", decimal=";", rate=-1.0, time="t")


def test_cells_of_matlab_73_are_records(tmp_path):
    pytest.importorskip("h5py")
    mat_73(tmp_path / "a.mat")
    dataset = read_data([tmp_path / "a.mat"], layout=Layout(time="1", input="2", output="3"))
    assert dataset.names == ("a:runs/1", "a:runs/2")
    np.testing.assert_array_equal(dataset.records[1].input, INPUT)


@pytest.mark.parametrize(
    ("header", "parts"),
    [
        ("time_ms", ("time", "ms")),
        ("Time in ms", ("Time", "ms")),
        ("U / kV", ("U", "kV")),
        ("t_a", ("t_a", None)),
        ("stress in out", ("stress in out", None)),
        ("in / out", ("in / out", None)),
    ],
)
def test_a_unit_in_a_name(header, parts):
    assert parted(header) == parts
