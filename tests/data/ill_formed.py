"""Files as instruments, loggers and spreadsheets write them: what is read from each, or what is said of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import csc_matrix

TIME = np.arange(50) / 100.0
INPUT = 5.0 * np.sin(2 * np.pi * TIME / 0.5)
OUTPUT = 1.5 + 0.5 * np.sin(2 * np.pi * TIME / 0.5 - 0.2)
COLUMNS = np.column_stack([TIME, INPUT, OUTPUT])

Write = Callable[[Path], None]


@dataclass(frozen=True)
class Case:
    """said : a part of the one sentence, empty where the file is read right;  layout : what the user says
    told : a part of a note
    units : of the columns, as far as they are stated;  lost : samples left out as gaps;  records : how many"""

    write: Write
    said: str = ""
    layout: Mapping[str, Any] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    lost: tuple[int, ...] = ()
    records: int = 1
    suffix: str = ".csv"
    told: str = ""


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


def minutes(lines: list[str]) -> list[str]:
    return [f"59:{59 + second:06.3f},{line.partition(',')[2]}" for second, line in zip(TIME, lines, strict=True)]


def late(lines: list[str]) -> list[str]:
    clocks = [f"23:59:59.{510 + 10 * number}" for number in range(49)]
    return [f"{one}{line[8:]}" for one, line in zip([*clocks, "00:00:00.000"], lines, strict=True)]


def half_days(lines: list[str]) -> list[str]:
    return [f"12:59:59.{int(1000 * second):03d} PM{line[8:]}" for second, line in zip(TIME, lines, strict=True)]


def dotted(lines: list[str]) -> list[str]:
    return [f"06.05.2024 {line}" for line in clock([line.replace(",", ";") for line in lines])]


def grouped(mark: str) -> Callable[[list[str]], list[str]]:
    """A further column with blanks or the like between thousands."""
    return lambda lines: [f"{line};1{mark}200.5" for line in lines]


def counted(lines: list[str]) -> list[str]:
    """Samples by their number in the place of their time."""
    return [f"{number},{line.partition(',')[2]}," for number, line in enumerate(lines)]


def single(mark: str) -> Callable[[list[str]], list[str]]:
    return lambda lines: [mark.join(f"'{cell}'" for cell in line.split(mark)) for line in lines]


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


def cells(*tables: Any) -> Any:
    made = np.empty(len(tables), dtype=object)
    made[:] = tables
    return made


def mat_73(path: Path) -> None:
    """As MATLAB writes cells: references into a group of their own."""
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        tables = [file.create_dataset(f"#refs#/{name}", data=COLUMNS.T) for name in "ab"]
        file["runs"] = np.array([table.ref for table in tables], dtype=h5py.ref_dtype)
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")


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
    "nothing": Case(lambda path: path.write_bytes(b""), "is empty"),
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
    "LabVIEW's preamble": Case(
        text("X_Value\tVoltage\tDisplacement\tComment", "\t", before=[
            "LabVIEW Measurement\t", "Separator\tTab", "***End_of_Header***\t", "\t", "Channels\t2\t",
            "Samples\t50\t50", "X0\t0.0\t0.0", "Delta_X\t0.01\t0.01", "***End_of_Header***\t\t"]),
        layout={"time": "X_Value", **NAMED}, suffix=".lvm",
    ),
    "LabVIEW's preamble, not told": Case(
        text("X_Value\tVoltage\tDisplacement\tComment", "\t", before=["Samples\t50\t50"]),
        "displacement, voltage, x_value", suffix=".lvm",
    ),
    "units in words": Case(text("x-axis,1,2\nsecond,Volt,Volt"), units={"time": "second", "input": "Volt"},
                           layout={"time": "x-axis", "input": "1", "output": "2"}),
    "a word below the header": Case(text("time,input,output\nSequence,Volt,0.0"), "begin it with #"),
    "a unit behind a bar": Case(text("t / s,input / V,output in um"), units=SI),
    "a unit in the time's name": Case(text("time_s,input,output"), units={"time": "s"}),
    "time in volts": Case(text("time [V],input,output"), "no unit of time; is it the right column"),
    "names with blanks": Case(
        text("Time (s)  Voltage (V)   Displacement (um)", "  "), layout={"time": "Time", **NAMED}, units=SI
    ),
    "more names than columns": Case(text("time s input V output um", " "), "only 3 columns. Give its position"),
    "minutes and seconds": Case(text("time,input,output", edit=minutes)),
    "past midnight": Case(text("time,input,output", edit=late)),
    "half days": Case(text("time,input,output", edit=half_days)),
    "dates with dots": Case(text("time;input;output", ";", edit=dotted)),
    "a coarse clock": Case(text("time,input,output", columns=COLUMNS * [0, 1, 1]), "too coarse, give --rate HZ"),
    "no-break blanks between thousands": Case(text("time;input;output;load", ";", edit=grouped("\u202f"))),
    "UTF-16 without a mark": Case(text("time,input,output", encoding="utf-16-le")),
    "zeros behind the end": Case(text("time,input,output", edit=lambda lines: [*lines, "\0" * 99])),
    "a mark of an old end": Case(text("time,input,output", edit=lambda lines: [*lines, "\x1a"])),
    "bytes": Case(lambda path: path.write_bytes(bytes(range(1, 99)) * 9), "is not text", suffix=".dat"),
    "JSON": Case(lambda path: path.write_text('{"time": [1, 2]}'), "it is JSON"),
    "packed": Case(lambda path: path.write_bytes(b"\x1f\x8b"), "unpack it first", suffix=".csv.gz"),
    "an instrument's missing reading": Case(text("time,input,output", edit=at(9, "0.09,9.91E+37,1.5")), lost=(9,)),
    "an instrument's overflow": Case(text("time,input,output", edit=at(9, "0.09,9.9E+37,1.5")), "for an overflow"),
    "a word for an overflow": Case(text("time,input,output", edit=at(9, "0.09,OVER,1.5")), "Empty the cell"),
    "a compiler's missing number": Case(text("time,input,output", edit=at(9, "0.09,-1.#IND,1.5")), lost=(9,)),
    "units in the cells": Case(
        text("time;input;output", ";", edit=lambda lines: [f"{one} um" for one in lines]), "Take the unit out of"
    ),
    "a decimal point, said to be a comma": Case(
        text("time;input;output", ";"), "Is it a decimal point?", layout={"decimal": ","}
    ),
    "records parted by empty lines": Case(
        text("time,input,output", edit=lambda lines: [*lines, "", *lines]), records=2
    ),
    "records that nothing parts": Case(
        text("time,input,output", edit=lambda lines: [*lines, *lines]), "or an empty line between them"
    ),
    "two inputs": Case(text("time,input,input,output", columns=COLUMNS[:, [0, 1, 1, 2]]), "--input 2 or --input 3"),
    "two notes": Case(text("time,input,output,note,note", columns=COLUMNS[:, [0, 1, 2, 2, 2]])),
    "npz with objects": Case(npz(**RECORD, bench=cells({"number": 3})), suffix=".npz"),
    "npz with dates": Case(
        npz(**RECORD | {"time": np.datetime64("2024-05-06") + (1e9 * TIME).astype("m8[ns]")}), suffix=".npz"
    ),
    "mat with cells": Case(
        mat(runs=cells(COLUMNS, COLUMNS)), layout={"time": "1", "input": "2", "output": "3"}, records=2, suffix=".mat"
    ),
    "mat with columns apart": Case(
        mat(rec={"X": {"Data": TIME}, "Y": cells({"Name": "u", "Data": INPUT}, {"Name": "y", "Data": OUTPUT})}),
        layout={"time": "rec/X/Data", "input": "rec/Y/1/Data", "output": "rec/Y/2/Data"}, suffix=".mat",
    ),
    "xlsx with formulas without values": Case(
        xlsx(Sheet1=[["time", "input", "output"], *[["=ROW()", u, y] for _, u, y in ROWS]]),
        "open it there and save it", suffix=".xlsx",
    ),
    "an oscilloscope's start and increment": Case(
        text("X,CH1,CH2,Start,Increment,\nSequence,Volt,VOLT,-2.0e-01,1.0e-02,", edit=counted),
        layout={"input": "CH1", "output": "CH2"}, units={"time": "s", "input": "Volt", "output": "volt"},
    ),
    "a start and an increment beside the names": Case(
        text("CH1V,CH2V,t0 =-2.0e-01, tInc = 1.0e-02,", edit=lambda lines: [f"{one}," for one in lines],
             columns=COLUMNS[:, 1:]), layout={"input": "CH1V", "output": "CH2V"}, units={"time": "s"},
    ),
    "a start and an increment beside times": Case(
        text("Time(s),CH1(V),CH2(V),t0 =0.0, tInc = 1.0e-02,"), layout={"input": "CH1", "output": "CH2"}
    ),
    "an increment without a number": Case(text("X,CH1,CH2,Start,Increment", edit=counted), '"time"'),
    "single quotes": Case(text("'time [s]','input [V]','output [um]'", edit=single(",")), units=SI),
    "single quotes and decimal commas": Case(text("'time';'input';'output'", ";", ",", edit=single(";"))),
    "single quotes about names": Case(text("'time','input','output'")),
    "a header in several lines": Case(text('"time\n[s]","input\n[V]","output\n[um]"'), units=SI),
    "quoted names between blanks": Case(text('"time" "input" "output"', " "), suffix=".dat"),
    "several trailing delimiters": Case(text("time,input,output", edit=lambda lines: [f"{one},,," for one in lines])),
    "npz with what is no column": Case(
        npz(**RECORD, spectrum=np.fft.fft(OUTPUT), image=np.zeros((9, 9, 9))), suffix=".npz",
        told="left out: spectrum (complex numbers), image (3 dimensions)",
    ),
    "npz with a complex output": Case(npz(**RECORD | {"output": OUTPUT + 1j}), "but complex numbers", suffix=".npz"),
    "npz with a complex output that is real": Case(npz(**RECORD | {"output": OUTPUT + 0j}), suffix=".npz"),
    "npz without a column": Case(npz(a=np.ones(9) * 1j), "only a (complex numbers)", suffix=".npz"),
    "mat with sparse matrices": Case(
        mat(**RECORD | {"output": csc_matrix(OUTPUT[:, None])}, weights=csc_matrix(np.eye(99))), suffix=".mat",
        told="left out: weights (a sparse matrix of 99 columns)",
    ),
    "an old spreadsheet": Case(lambda path: path.write_bytes(b"\xd0\xcf\0"), "save it as .xlsx", suffix=".xls"),
    "a broken spreadsheet": Case(lambda path: path.write_bytes(b"PK"), "cannot be read as a spre", suffix=".xlsx"),
}  # fmt: skip
