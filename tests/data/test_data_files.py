"""Data CSV: what is accepted, and what each fault says."""

import numpy as np
import pytest

from hysteresis_bench import load
from hysteresis_bench.data.data_files import read_data, write_csv
from hysteresis_bench.errors import UserError


def write(folder, text, name="bench.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_units_runs_and_further_columns(tmp_path):
    path = write(tmp_path, "Time [ms], input [V],output[um],run,temperature [degC],remark\n"
                           "0,1,2,a,20,x\n1,2,3,a,21,y\n0,5,6,b,22,z\n2,6,7,b,23,z\n")  # fmt: skip
    dataset = read_data([path])
    assert dataset.names == ("bench:a", "bench:b")
    first, second = dataset.records
    assert first.units["input"] == "V"
    assert first.units["time"] == "ms"
    assert first.units["temperature"] == "degC"
    assert list(second.columns) == ["temperature"]
    assert second.columns["temperature"].tolist() == [22, 23]
    assert first.timed


def test_time_as_an_index_switches_rate_effects_off(tmp_path):
    record = read_data([write(tmp_path, "time [sample],input,output\n0,1,2\n1,2,3\n")]).records[0]
    assert not record.timed
    assert not record.signal.timed


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("time,input\n0,1\n1,2\n", 'no column "output"'),
        ("time,inptu,output\n0,1,2\n1,2,3\n", 'Did you mean "inptu"'),
        ("time,input,output\n0,1,2\n1,,3\n", 'row 3, column "input": empty is not a finite number'),
        ("time,input,output\n0,1,2\n1,2,nan\n", 'row 3, column "output": "nan"'),
        ("time,input,output\n0,1,2\n1,2,1e999\n", 'row 3, column "output"'),
        ("time,input,output\n0,1,2\n1,x,3\n2,y,3\n", "2 such values"),
        ("time,input,output\n0,1,2\n2,2,3\n2,3,4\n", 'row 4, column "time": 2 does not come after 2'),
        ("time,input,output\n0,1,2\n", "has 1 sample"),
        ("time,input,output\n0,1,2\n1,1,3\n", "constant at 1"),
        (
            "time,input,output,input\n0,1,2,3\n1,2,3,4\n",
            'two columns are called "input". Say which it is with --input 2 or --input 4',
        ),
        ("time,input,output\n0,1,2\n\n1,x,3\n", 'row 4, column "input"'),
        ("time,input,output\n0,1,2\n1,2\n", 'row 3, column "output": empty'),
        ("time,input,output\n0,1,2\n1,2,3,4\n", "row 3 has 4 cells, where 3 are expected. Take out"),
        ("", "is empty"),
        ("time,input,output\n", "no samples"),
    ],
)
def test_faults_name_file_row_and_column(tmp_path, text, told):
    path = write(tmp_path, text)
    with pytest.raises(UserError) as error:
        read_data([path])
    assert told in str(error.value)
    assert "bench.csv" in str(error.value)


def test_all_faults_at_once(tmp_path):
    with pytest.raises(UserError, match="has 2 faults"):
        read_data([write(tmp_path, "time,input,output\n0,x,2\n1,2,y\n")])


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(UserError, match=r"there is no such file\.$"):
        read_data([tmp_path / "none.csv"])
    write(tmp_path, "time,input,output\n0,1,2\n1,2,3\n", "slow.csv")
    with pytest.raises(UserError, match=r'Did you mean ".*slow\.csv"'):
        read_data([tmp_path / "slwo.csv"])
    with pytest.raises(UserError, match=r"is a folder; name its files, such as .*slow\.csv"):
        read_data([tmp_path])
    (tmp_path / "empty").mkdir()
    with pytest.raises(UserError, match="is a folder; it holds no data files"):
        read_data([tmp_path / "empty"])


def test_units_must_agree_and_names_differ(tmp_path):
    volts = write(tmp_path, "time,input [V],output\n0,1,2\n1,2,3\n", "a.csv")
    newtons = write(tmp_path, "time,input [N],output\n0,1,2\n1,2,3\n", "b.csv")
    with pytest.raises(UserError, match=r'b.csv: column "input" is in N, .* in V'):
        read_data([volts, newtons])
    with pytest.raises(UserError, match=r"a.csv, .*a.csv: names must differ, and several records are named 'a'"):
        read_data([volts, volts])


def test_written_as_it_is_read(tmp_path):
    text = "time [ms],input [V],output [um],run\n0,1,2,a\n1,2,3.25,a\n0,5,6,b\n2,6,7,b\n"
    dataset = read_data([write(tmp_path, text)])
    again = tmp_path / "again.csv"
    write_csv(again, dataset)
    back = read_data([again])
    for one, other in zip(dataset.records, back.records, strict=True):
        assert np.array_equal(one.output, other.output)
        assert np.array_equal(one.time, other.time)
        assert dict(one.units) == dict(other.units)


def test_prediction_needs_no_output_and_no_moving_input(tmp_path):
    dataset = read_data([write(tmp_path, "time,input\n0,1\n1,1\n")], output_needed=False)
    assert dataset.records[0].output is None


def test_history_is_written_and_read_back(tmp_path):
    dataset = read_data([write(tmp_path, "time,input,output,run\n0,1,2,a\n1,2,3,a\n2,3,3,a\n0,5,6,b\n2,6,7,b\n")])
    write_csv(tmp_path / "again.csv", dataset.map(lambda record: record.skip(1.0)))
    back = read_data([tmp_path / "again.csv"]).records
    assert [record.history for record in back] == [1, 1]
    assert back[0].measured.tolist() == [3, 3]
    with pytest.raises(UserError, match='column "history": 1 for leading samples'):
        read_data([write(tmp_path, "time,input,output,history\n0,1,2,0\n1,2,3,1\n2,2,3,0\n")])


def test_held_out(tmp_path):
    path = write(tmp_path, "time,input,output,run\n0,1,2,a\n1,2,3,a\n2,3,3,a\n0,5,6,b\n2,6,7,b\n4,7,7,b\n")
    assert [record.name for record in load(path, held_out=["bench:b"]).fitted] == ["bench:a"]
    with pytest.raises(UserError, match="no record 'c'"):
        load(path, held_out=["c"])
    with pytest.raises(UserError, match="none is left"):
        load(path, held_out=["bench:a", "bench:b"])
