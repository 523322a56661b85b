"""Files as instruments, loggers and spreadsheets write them: what is read from each, or what is said of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

TIME = np.arange(50) / 100.0
INPUT = 5.0 * np.sin(2 * np.pi * TIME / 0.5)
OUTPUT = 1.5 + 0.5 * np.sin(2 * np.pi * TIME / 0.5 - 0.2)
COLUMNS = np.column_stack([TIME, INPUT, OUTPUT])

Write = Callable[[Path], None]


@dataclass(frozen=True)
class Case:
    """said : a part of the one sentence, empty where the file is read right;  layout : what the user says
    units : of the columns, as far as they are stated;  lost : samples left out as gaps;  records : how many"""

    write: Write
    said: str = ""
    layout: Mapping[str, Any] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    lost: tuple[int, ...] = ()
    records: int = 1
    suffix: str = ".csv"


def text(header: str, mark: str = ",", decimal: str = ".", encoding: str = "utf-8", **change: Any) -> Write:
    """columns : in their order;  before : lines above the header;  end : of a line;  edit : the lines, changed"""

    def write(path: Path) -> None:
        columns = change.get("columns", COLUMNS)
        lines = [mark.join(f"{value:.6f}" for value in row) for row in columns]
        lines = [line.replace(".", decimal) for line in lines]
        lines = change.get("edit", lambda same: same)(lines)
        whole = [*change.get("before", []), *([header] if header else []), *lines]
        end = change.get("end", "\n")
        path.write_bytes((end.join(whole) + end).encode(encoding))

    return write


def at(index: int, line: str) -> Callable[[list[str]], list[str]]:
    return lambda lines: [*lines[:index], line, *lines[index + 1 :]]


def clock(lines: list[str]) -> list[str]:
    return [f"12:00:{second:06.3f};{line.partition(';')[2]}" for second, line in zip(TIME, lines, strict=True)]


def stamped(lines: list[str]) -> list[str]:
    return [f"2024-05-0{6} 23:59:59.{int(second * 1000):03d},{line.partition(',')[2]}"
            for second, line in zip(TIME, lines, strict=True)]  # fmt: skip


def scientific(lines: list[str]) -> list[str]:
    return [",".join(f"{float(cell):.8E}" for cell in line.split(",")) for line in lines]


def npz(**arrays: Any) -> Write:
    return lambda path: np.savez(path, **arrays)


def mat(**arrays: Any) -> Write:
    def write(path: Path) -> None:
        from scipy.io import savemat

        savemat(path, arrays)

    return write


def h5(groups: Mapping[str, Mapping[str, Any]], units: Mapping[str, str]) -> Write:
    def write(path: Path) -> None:
        import h5py

        with h5py.File(path, "w") as file:
            for group, arrays in groups.items():
                for name, values in arrays.items():
                    made = file.require_group(group).create_dataset(name, data=values)
                    if name in units:
                        made.attrs["units"] = units[name]

    return write


def xlsx(**sheets: list[list[Any]]) -> Write:
    def write(path: Path) -> None:
        import openpyxl

        book = openpyxl.Workbook()
        book.remove(book.active)
        for title, rows in sheets.items():
            page = book.create_sheet(title)
            for row in rows:
                page.append(row)
        book.save(path)

    return write


SI = {"time": "s", "input": "V", "output": "um"}
STATED = "time [s],input [V],output [um]"
NAMED = {"input": "Voltage", "output": "Displacement"}
RECORD = {"time": TIME, "input": INPUT, "output": OUTPUT}
ROWS = COLUMNS.tolist()
THOUSANDS = np.column_stack([TIME, INPUT * 1e3, OUTPUT * 1e3])

CASES: dict[str, Case] = {
    "semicolons": Case(text(STATED.replace(",", ";"), ";"), units=SI),
    "semicolons and decimal commas": Case(text("time;input;output", ";", ",")),
    "tabs": Case(text("time\tinput\toutput", "\t"), suffix=".tsv"),
    "tabs and decimal commas": Case(text("time\tinput\toutput", "\t", ","), suffix=".txt"),
    "bars": Case(text("time|input|output", "|")),
    "blanks": Case(text("time   input   output", "  "), suffix=".dat"),
    "blanks and decimal commas": Case(text("time input output", " ", ","), suffix=".dat"),
    "quoted decimal commas": Case(
        text("time,input,output", '","', ",", edit=lambda lines: [f'"{line}"' for line in lines])
    ),
    "comments": Case(
        text("# bench 3\n# 2024\ntime,input,output", edit=lambda lines: [*lines[:7], "# lamp lit", *lines[7:]])
    ),
    "header in a comment": Case(text("# time input output", " "), suffix=".dat"),
    "per cent comments": Case(text("% made by hand\ntime,input,output")),
    "an oscilloscope's preamble": Case(
        text("Time,CH1,CH2", before=["Model,TDS1002", "Firmware,1.2", "", "Sample Interval,0.01"]),
        layout={"input": "CH1", "output": "CH2"},
    ),
    "a line of units": Case(text("time;input;output\ns;V;um", ";"), units=SI),
    "a line of units in round brackets": Case(text("Time,Input,Output\n(s),(V),(um)"), units=SI),
    "units in round brackets": Case(text("time (s),input (V),output (um)"), units=SI),
    "names of its own": Case(text("t (s),Voltage (V),Displacement (um)"), layout=NAMED, units=SI),
    "names that are not told": Case(text("t (s),Voltage (V),Displacement (um)"), "--input NAME"),
    "a round bracket that is no unit": Case(text("time,input (raw),output"), layout={"input": "input (raw)"}),
    "a byte-order mark": Case(text("time,input,output", encoding="utf-8-sig")),
    "UTF-16": Case(text("time\tinput\toutput", "\t", encoding="utf-16")),
    "Windows letters": Case(text("time [s],input [V],output [µm]", encoding="cp1252"), units=SI | {"output": "µm"}),
    "Windows line ends": Case(text(STATED, end="\r\n"), units=SI),
    "no header": Case(text(""), layout={"time": "1", "input": "2", "output": "3"}),
    "no header, not told": Case(text(""), "there is no header, only 3 columns. Give its position with --time"),
    "no time column": Case(text("input,output", columns=COLUMNS[:, 1:]), layout={"rate": 100.0}),
    "no time column, not told": Case(text("input,output", columns=COLUMNS[:, 1:]), "give --rate HZ"),
    "columns in another order": Case(text("output,time,input", columns=COLUMNS[:, [2, 0, 1]])),
    "a trailing delimiter": Case(text("time;input;output;", ";", edit=lambda lines: [f"{one};" for one in lines])),
    "one row without numbers": Case(text("time,input,output", edit=at(9, "0.09,NaN,NaN")), lost=(9,)),
    "empty cells": Case(text("time;input;output", ";", ",", edit=at(9, "0,09;;1,5")), lost=(9,)),
    "a cut last line": Case(text("time,input,output", edit=lambda lines: [*lines[:-1], "0.49"]), lost=(49,)),
    "a gap and a rate": Case(
        text("input,output", columns=COLUMNS[:, 1:], edit=at(9, "--,--")), layout={"rate": 100.0}, lost=(9,)
    ),
    "times of day": Case(text("time;input;output", ";", edit=clock)),
    "dates": Case(text("time,input,output", edit=stamped)),
    "dates of a country": Case(
        text("time,input,output", edit=lambda lines: [f"05/06/2024 {line}" for line in lines]), "--rate HZ"
    ),
    "thousands or decimals": Case(
        text("time;input;output", ";", edit=lambda lines: [f"{n};1,{n:03d};2,{n:03d}" for n in range(50)]),
        '"1,000" may be a decimal comma or thousands; give --decimal',
    ),
    "comma and point": Case(text("time;input;output", ";", edit=at(4, "0,04;2.5;1.5")), "decimal comma and point"),
    "decimal commas between commas": Case(text("time,input,output", ",", ","), "semicolons"),
    "text in a number's place": Case(text("time,input,output", edit=at(4, "0.04,OVERLOAD,1.5")), "row 6, column"),
    "two outputs": Case(text("time,input,output,output", columns=COLUMNS[:, [0, 1, 2, 2]]), 'called "output"'),
    "a spreadsheet's line on its delimiter": Case(text("sep=;\ntime;input;output", ";")),
    "old line ends": Case(text(STATED, end="\r"), units=SI),
    "every other line empty": Case(text("time,input,output", end="\n\n")),
    "a quoted header": Case(text('"time [s]","input [V]","output [um]"'), units=SI),
    "exponents": Case(text("time,input,output", edit=scientific)),
    "Fortran's exponents": Case(
        text("time,input,output", edit=lambda lines: [one.replace("E", "D") for one in scientific(lines)])
    ),
    "typeset minus": Case(text("time,input,output", edit=lambda lines: [one.replace("-", "−") for one in lines])),
    "apostrophes between thousands": Case(
        text("time;input;output;load", ";", edit=lambda lines: [f"{one};1'200.5" for one in lines])
    ),
    "a line at the end": Case(text("time,input,output", edit=lambda lines: [*lines, "End of data"]), "begin it with #"),
    "the header again": Case(
        text("time,input,output", edit=lambda lines: [*lines[:20], "time,input,output", *lines[20:]]), "begin it with #"
    ),
    "an overflow": Case(text("time,input,output", edit=at(9, "0.09,inf,1.5")), 'row 11, column "input": "inf" is not'),
    "nothing": Case(lambda path: path.write_bytes(b""), "No columns"),
    "a header only": Case(lambda path: path.write_text("time,input,output\n"), "no samples"),
    "one sample": Case(lambda path: path.write_text("time,input,output\n0,1,2\n"), "at least 2"),
    "time that runs back": Case(text("time,input,output", columns=COLUMNS[::-1]), "must strictly increase"),
    "a time twice": Case(text("time,input,output", edit=at(9, "0.08,1.0,1.5")), "row 11"),
    "a resting input": Case(text("time,input,output", columns=COLUMNS * [1, 0, 1]), "does not move"),
    "zeros in the text": Case(text("time,input,output", edit=at(9, "\0" * 20)), "is not text"),
    "npz": Case(npz(**RECORD), suffix=".npz"),
    "npz without time": Case(
        npz(voltage=INPUT, x=OUTPUT), layout={"rate": 100.0, "input": "voltage", "output": "x"}, suffix=".npz"
    ),
    "npz with a table": Case(
        npz(loop=COLUMNS.T), layout={"time": "1", "input": "2", "output": "3"}, suffix=".npz"
    ),
    "mat": Case(mat(**RECORD, note="bench"), suffix=".mat"),
    "mat with structures": Case(mat(slow=RECORD, fast=RECORD), records=2, suffix=".mat"),
    "h5": Case(h5({"/": RECORD}, SI), units=SI, suffix=".h5"),
    "h5 with groups": Case(h5({"slow": RECORD, "fast": RECORD}, SI), units=SI, records=2, suffix=".h5"),
    "xlsx": Case(xlsx(Sheet1=[["time (s)", "input (V)", "output (um)"], *ROWS]), units=SI, suffix=".xlsx"),
    "xlsx with sheets": Case(
        xlsx(Notes=[["made", "by hand"]], slow=[["time", "input", "output"], *ROWS],
             fast=[["Bench 3"], [], ["time", "input", "output"], ["s", "V", "um"], *ROWS]),
        records=2, suffix=".xlsx",
    ),
    "xlsx with numbers as text": Case(
        xlsx(Sheet1=[["time", "input", "output"], *[[t, f"{u:.6f}".replace(".", ","), y] for t, u, y in ROWS]]),
        suffix=".xlsx",
    ),
    "xlsx with thousands or decimals": Case(
        xlsx(Sheet1=[["time", "input", "output"], *[[n, f"1,{n:03d}", 1.5] for n in range(50)]]),
        '"1,000" may be a decimal comma or thousands; give --decimal', suffix=".xlsx",
    ),
    "a text that is a spreadsheet": Case(lambda path: path.write_bytes(b"PK\3\4\0\0"), "is not text"),
    "an old spreadsheet": Case(lambda path: path.write_bytes(b"\xd0\xcf\0"), "save it as .xlsx", suffix=".xls"),
    "a broken spreadsheet": Case(lambda path: path.write_bytes(b"PK"), "cannot be read as a spre", suffix=".xlsx"),
}  # fmt: skip
