"""Files of measured data: cells, headers and bytes gone wrong, beside a twin that reads them cell by cell."""

from __future__ import annotations

import csv
import io

import numpy as np
from hypothesis import strategies as st

from benchmarks.fuzz.target import Target, Wrong, scratch
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.trajectory_file import read_trajectory
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset

Rows = list[list[str]]

CELLS = (
    "", " ", "nan", "NaN", "NA", "null", "inf", "-inf", "1e999", "1.7e308", "1e101", "5e-324", "1,5", "1_0", "0x10",
    "\u0661", "1.0.0", "--1", "-", "=1+1", "@x", "'1", '"', '"1', "'=1", "\x00", "\x1b[31m", " 1 ", "1e", "True", "1;2",
    "\ufeff1", "\u2212 1", "1 000", "1.5 V", "\u00e9" * 300, "0", "-1", "1e-3", "7", "+1", ".5", "1.",
)  # fmt: skip
HEADERS = (
    "", "time", "input", "output", "Time [s]", "TIME", "time [ms]", "time [sample]", "time [V]", "input [kV]",
    "input [mV]", "input [", "input []", "input [V", "[V]", "input V]", "input [V] [V]", "output [banana]",
    "output [9^9^9]", "output [a.u.]", "output [\u00b5m]", "run", "history", "temperature [degC]", "temperature [K]",
    "x" * 300, "=input", "'input", "in\nput", "in\x1bput", "\ufefftime", "reference", "reference [nm]", "0", "1.5",
)  # fmt: skip


CHANGES = ("cell", "cell", "header", "text", "swap", "double", "drop", "cut", "more", "blank")


def table(samples: int, seed: int, runs: int = 0) -> Rows:
    """A file as it should be: time, input, output, perhaps a temperature and runs."""
    rng = np.random.default_rng(seed)
    time = np.cumsum(rng.uniform(0.001, 0.1, samples))
    drive = 5.0 * np.sin(3.0 * time) + rng.uniform(-1.0, 1.0, samples)
    columns = {"time [s]": time, "input [V]": drive, "output [um]": np.tanh(drive), "temperature [degC]": 20.0 + time}
    rows = [list(columns), *([f"{value:.9g}" for value in row] for row in zip(*columns.values(), strict=True))]
    if runs:
        rows[0].append("run")
        for number, row in enumerate(rows[1:]):
            row.append(f"part {number * runs // samples}")
    return rows


def written(rows: Rows, comma: str = ",", end: str = "\n") -> bytes:
    stream = io.StringIO(newline="")
    csv.writer(stream, delimiter=comma, lineterminator=end).writerows(rows)
    return stream.getvalue().encode("utf-8", "surrogatepass")


@st.composite
def spoilt(draw: st.DrawFn) -> bytes:
    """A file with cells, headers, rows or bytes changed; often with nothing left that is right."""
    rows = table(draw(st.integers(1, 12)), draw(st.integers(0, 99)), draw(st.sampled_from([0, 0, 2])))
    for _ in range(draw(st.integers(0, 2))):
        row = draw(st.integers(0, len(rows) - 1))
        column = draw(st.integers(0, 3))
        other = draw(st.integers(0, len(rows) - 1))
        match draw(
            st.sampled_from(("cell", "cell", "header", "text", "swap", "double", "drop", "cut", "more", "blank"))
        ):
            case "cell" if column < len(rows[row]):
                rows[row][column] = draw(st.sampled_from(CELLS))
            case "header" if column < len(rows[0]):
                rows[0][column] = draw(st.sampled_from(HEADERS))
            case "text" if column < len(rows[row]):
                rows[row][column] = draw(st.text(max_size=8))
            case "swap":
                rows[row], rows[other] = rows[other], rows[row]
            case "double":
                rows.insert(row, list(rows[row]))
            case "drop" if len(rows) > 1:
                del rows[row]
            case "cut":
                del rows[row][column:]
            case "more":
                rows[row].append(draw(st.sampled_from(CELLS)))
            case "blank":
                rows.insert(row, draw(st.sampled_from([[], [""], ["", "", ""], ["# a remark"]])))
    text = written(
        rows, draw(st.sampled_from(",,,,,,,,;\t|")), draw(st.sampled_from(("\n",) * 4 + ("\r\n", "\r", "\n\r")))
    )
    match draw(st.sampled_from(("plain",) * 6 + ("bom", "utf-16", "latin-1", "cut", "flipped", "junk"))):
        case "bom":
            return b"\xef\xbb\xbf" + text
        case "utf-16":
            return text.decode("utf-8", "replace").encode("utf-16", "surrogatepass")
        case "latin-1":
            return text.decode("utf-8", "replace").encode("latin-1", "replace")
        case "cut":
            return text[: draw(st.integers(0, len(text)))]
        case "flipped":
            place = draw(st.integers(0, max(0, len(text) - 1)))
            return text[:place] + bytes([draw(st.integers(0, 255))]) + text[place + 1 :]
        case "junk":
            return draw(st.binary(max_size=200))
    return text


def twin(content: bytes, gaps: bool) -> dict[str, list[tuple[float, ...]]]:
    """What a plain reader finds: by run, (time, input) as they stand there. Raises ValueError where it finds none.

    gaps : rows without a number are left out, as is said where the reader does so
    """
    text = _decoded(content)
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    for delimiter in ",;\t|":
        rows = [row for row in csv.reader(lines, delimiter=delimiter) if any(cell.strip() for cell in row)]
        header = [cell.strip().removeprefix("'").split("[")[0].strip().lower() for cell in rows[0]]
        if {"time", "input"} <= {*header}:
            break
    places = [header.index("time"), header.index("input")]
    run = header.index("run") if "run" in header else None
    found: dict[str, list[tuple[float, ...]]] = {}
    for row in rows[1:]:
        padded = row + [""] * (len(header) - len(row))
        try:
            sample = tuple(float(padded[place]) for place in places)
            if gaps and "output" in header and not np.isfinite(float(padded[header.index("output")])):
                continue
        except ValueError:
            if not gaps:
                raise
            continue
        found.setdefault("" if run is None else padded[run], []).append(sample)
    return found


def _decoded(content: bytes) -> str:
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def ask(given: bytes) -> None:
    """Raises Wrong where what is read is not what a plain reader finds."""
    path = scratch() / "bad.csv"
    path.write_bytes(given)
    for output_needed in (True, False):
        try:
            found = read_data([path], output_needed)
        except UserError:
            if output_needed:
                continue
            raise
        _compare(found, given)


def _compare(found: Dataset, given: bytes) -> None:
    try:
        gaps = any(row["gaps"] != "0" for row in found.understood)
        expected = list(twin(given, gaps).values())
    except (ValueError, IndexError) as error:
        raise Wrong(f"reads what a plain reader does not: {type(error).__name__}") from None
    read = [list(zip(record.time.tolist(), record.input.tolist(), strict=True)) for record in found.records]
    if read != expected:
        raise Wrong("reads other numbers than a plain reader")
    for record in found.records:
        output = [] if record.output is None else [record.output]
        if not all(np.all(np.isfinite(values)) for values in (*output, *record.columns.values())):
            raise Wrong("reads what is not finite")


def trajectory(given: bytes) -> None:
    """As `control --reference` reads it."""
    path = scratch() / "reference.csv"
    path.write_bytes(given)
    (record,) = read_trajectory(path, {"time": "s", "input": "V", "output": "um"}).records
    if not np.all(np.isfinite(record.measured)):
        raise Wrong("reads what is not finite")


TARGETS = (
    Target("data files", spoilt(), ask, 20),
    Target("trajectories", spoilt(), trajectory, 5),
)
