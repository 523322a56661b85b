"""Text in CSV files: no formula to a spreadsheet, and read back as it was."""

import pandas as pd
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from hysteresis_bench.data.csv_files import guarded, read_table, unguarded, write_table
from hysteresis_bench.data.data_files import read_data, write_csv
from hysteresis_bench.errors import UserError

DANGEROUS = ("=1+1", "+cmd", "-cmd", "@SUM(A1)", "'=x", "''+y")


@settings(max_examples=200, deadline=None)
@example("'=1")
@example("'-1")
@example("-1")
@given(st.text(alphabet="'=+-@\t\r1e.a", max_size=6) | st.text(max_size=10))
def test_every_text_comes_back(text):
    assert unguarded(guarded(text)) == text


@pytest.mark.parametrize("text", DANGEROUS)
def test_no_cell_begins_a_formula(text):
    assert guarded(text)[0] == "'"


def test_numbers_as_text_stay_numbers():
    assert [guarded(text) for text in ("-1", "+2.5", "-1e-3")] == ["-1", "+2.5", "-1e-3"]


def test_tables(tmp_path):
    path = tmp_path / "t.csv"
    table = pd.DataFrame({"optimizer": DANGEROUS, "@fitness": [-1.5, 2.0, None, 0.1 + 0.2, 1e300, 3.0]})
    write_table(path, table)
    cells = pd.read_csv(path, header=None, dtype=str)
    assert not cells.iloc[:, 0].str.match(r"[=+\-@]").any()
    pd.testing.assert_frame_equal(read_table(path), table, check_exact=True)


def test_names_of_runs(tmp_path):
    path = tmp_path / "=loop.csv"
    path.write_text("time,input,output,run,=more\n0,1,2,=a,1\n1,2,3,=a,1\n0,1,2,-b,2\n1,2,3,-b,2\n", encoding="utf-8")
    dataset = read_data([path])
    assert dataset.names == ("=loop:=a", "=loop:-b")
    write_csv(tmp_path / "out.csv", dataset)
    assert ",=" not in (tmp_path / "out.csv").read_text(encoding="utf-8")
    back = read_data([tmp_path / "out.csv"])
    assert back.names == ("out:=loop:=a", "out:=loop:-b")
    assert list(back.records[0].columns) == ["=more"]


HEADER = "time [s],input [V],output"


@settings(max_examples=150, deadline=None)
@given(
    header=st.sampled_from([HEADER, "time,input,output,run", "time [ms],input[K],output [%],note"])
    | st.text(max_size=20),
    cells=st.lists(
        st.lists(
            st.sampled_from(["0", "1", "2.5", "-3", "1e300", "5e-324", "nan", "", " ", "=1", '"', "1_0", "٣", "0x1"])
            | st.floats().map(str)
            | st.text(max_size=4),
            min_size=1,
            max_size=4,
        ),
        max_size=5,
    ),
)  # fmt: skip
def test_any_file_is_read_or_refused_in_a_sentence(tmp_path_factory, header, cells):
    """Numbers that are read are finite, and come back from what is written."""
    folder = tmp_path_factory.getbasetemp()
    path = folder / "any.csv"
    path.write_text("\n".join([header, *(",".join(row) for row in cells)]), encoding="utf-8", errors="replace")
    try:
        dataset = read_data([path])
    except UserError as error:
        assert 0 < len(str(error)) < 3000  # noqa: PT017
        return
    write_csv(folder / "back.csv", dataset)
    for one, other in zip(dataset.records, read_data([folder / "back.csv"]).records, strict=True):
        assert (one.time == other.time).all()
        assert (one.input == other.input).all()
        assert (abs(one.output) < 1e101).all()
