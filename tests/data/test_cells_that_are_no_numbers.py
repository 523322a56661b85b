"""What is said of cells and rows that cannot be read: where, what, and what would be right, in words of our own."""

import numpy as np
import pytest

from hysteresis_bench.data.data_files import SHORTEST, read_data
from hysteresis_bench.data.layout import Layout
from hysteresis_bench.data.readers.samples import LARGEST
from hysteresis_bench.errors import UserError

ROWS = [[f"{k / 100}", f"{np.sin(k / 9):.6f}", f"{np.cos(k / 9):.6f}"] for k in range(100)]


def refused(folder, rows, header="time [s],input [V],output [um]", name="bench.csv", **layout):
    path = folder / name
    path.write_text("\n".join([header, *(",".join(row) for row in rows)]), encoding="utf-8")
    with pytest.raises(UserError) as error:
        read_data([path], layout=Layout(**layout))
    return str(error.value)


def changed(column, cell, where=lambda row: row == 9):
    """The rows with this in the place of some cells of a column."""
    return [[cell if at == column and where(k) else old for at, old in enumerate(row)] for k, row in enumerate(ROWS)]


def scaled(column, factor):
    return [[f"{float(old) * factor:.6g}" if at == column else old for at, old in enumerate(row)] for row in ROWS]


def test_a_number_beyond_all_numbers_has_no_unit_to_take_out(tmp_path):
    for cell in ("1e400", "-1.5E+999"):
        said = refused(tmp_path, changed(1, cell))
        assert f'row 11, column "input": "{cell}" is too large to work with, beyond 1e+70. Empty the cell' in said
    assert "Take the unit out" in refused(tmp_path, changed(1, "4 V"))


def test_too_many_empty_cells_are_told_with_the_limit_and_a_remedy(tmp_path):
    for cell in ("nan", ""):
        said = refused(tmp_path, changed(2, cell, lambda row: row % 2 == 0))
        assert "50 of 100 cells hold no number; up to a fifth of them may" in said
        assert "give another column with --output NAME" in said


def test_fourth_powers_of_what_is_accepted_are_numbers(tmp_path):
    assert np.isfinite(LARGEST**4 * 1e14)
    assert np.finfo(float).tiny < SHORTEST**4
    assert "Give the column in a larger unit" in refused(tmp_path, scaled(2, 1e80))


@pytest.mark.parametrize(("column", "role"), [(1, "input"), (2, "output")])
def test_what_hardly_moves_is_not_said_to_be_constant(tmp_path, column, role):
    said = refused(tmp_path, scaled(column, 3e-150))
    assert f'column "{role}": it moves by 6e-150 in all, too little to work with' in said
    assert "give it in a smaller unit" in said
    assert "constant" not in said


def test_a_ragged_row_is_told_without_the_readers_own_words(tmp_path):
    said = refused(tmp_path, [*ROWS[:9], [*ROWS[9], "7"], *ROWS[10:]])
    assert 'row 11 has 4 cells, where 3 are expected. Take out what is too much; a cell that holds ","' in said
    assert "decimal commas" in refused(tmp_path, [*ROWS[:9], [*ROWS[9], *ROWS[9]], *ROWS[10:]])
    said = refused(tmp_path, changed(1, '"0.5'))
    assert "a quote that begins in row 11 does not end" in said
    assert "C error" not in said


def test_a_run_column_that_is_partly_empty_is_a_fault_with_rows(tmp_path):
    header = "time,input,output,run"
    rows = [[*row, "" if k in (3, 4, 5, 7, 9) else "a"] for k, row in enumerate(ROWS)]
    assert 'column "run": empty in rows 5, 6, 7, 9 and 1 more' in refused(tmp_path, rows, header)
    path = tmp_path / "none.csv"
    path.write_text("\n".join([header, *(",".join([*row, ""]) for row in ROWS)]), encoding="utf-8")
    assert read_data([path]).names == ("none",)


def test_text_that_is_called_an_archive(tmp_path):
    for name in ("text.npz", "text.npy"):
        said = refused(tmp_path, ROWS, name=name)
        assert "is no file of NumPy's arrays" in said
        assert "pickle" not in said
        assert not said.endswith("..")


def test_sheets_and_positions_that_are_not_there(tmp_path):
    assert "this file has none to choose from. Leave --sheet out" in refused(tmp_path, ROWS, sheet="foo")
    assert "A position is a number from 1 to 3." in refused(tmp_path, ROWS, output="9")
    assert "A position is a number from 1 to 3." in refused(tmp_path, ROWS, time="0")


def test_the_only_sheet_of_a_workbook_goes_by_its_name(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.title = "Loop"
    for row in (["time", "input", "output"], *([float(cell) for cell in row] for row in ROWS)):
        book.active.append(row)
    book.save(tmp_path / "bench.xlsx")
    assert read_data([tmp_path / "bench.xlsx"], layout=Layout(sheet="Loop")).names == ("bench",)
    with pytest.raises(UserError, match="Known: Loop"):
        read_data([tmp_path / "bench.xlsx"], layout=Layout(sheet="Lop"))
