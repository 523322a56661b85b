"""The same measurement written in another way: `predict` must answer the same numbers, or a sentence; where the unit is
another one, also a word on that."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
import pandas as pd
from click.testing import CliRunner
from hypothesis import strategies as st

from benchmarks.fuzz.measurements import CELLS, Rows, table, written
from benchmarks.fuzz.target import Target, Wrong, scratch
from hysteresis_bench.cli import USER_AT_FAULT, main
from hysteresis_bench.data.csv_files import is_number
from hysteresis_bench.errors import UserError

MODEL = {
    "schema": 2,
    "model": "bouc-wen",
    "settings": {},
    "units": {"time": "s", "input": "V", "output": "um"},
    "parameters": {
        "alpha": {"value": 0.4, "standard_error": None, "unit": "1"},
        "beta": {"value": 0.8, "standard_error": None, "unit": "1/V"},
        "gamma": {"value": 0.2, "standard_error": None, "unit": "1/V"},
        "d": {"value": 1.5, "standard_error": None, "unit": "um/V"},
    },
    "effects": [
        {
            "effect": "output-lag",
            "settings": {},
            "parameters": {"time_constant": {"value": 0.05, "standard_error": None, "unit": "s"}},
        }
    ],
    "fixed": {},
    "preparation": {"input_offset": 0.0, "flip": False, "skip": 0.0, "settle": 0},
    "data": {},
    "error": {},
    "created_by": {},
}
SCALES = {
    "time": {"ms": 1e3, "us": 1e6, "min": 1 / 60, "h": 1 / 3600, "seconds": 1.0},
    "input": {"mV": 1e3, "kV": 1e-3, "uV": 1e6, "\u00b5V": 1e6, "volt": 1.0, "MV": 1e-6},
    "output": {"nm": 1e3, "mm": 1e-3, "m": 1e-6, "\u00b5m": 1.0, "micrometer": 1.0, "inch": 1 / 25400},
}  # fmt: skip
STRANGE = ("A", "N", "K", "bar", "banana", "a.u.", "V^2", "s/V", "sample", "%", "dB")
SAME, REFUSED, EITHER, TOLD = "same", "refused", "same or refused", "same, and told"
WAYS = {
    "scaled": TOLD, "strange unit": REFUSED, "no unit": SAME, "columns permuted": SAME, "rows shuffled": REFUSED,
    "odd cell": EITHER, "no number": REFUSED, "time repeated": REFUSED, "capitals": SAME, "blanks": SAME,
    "quoted": SAME, "byte order mark": SAME, "line ends": SAME, "blank lines": SAME, "remarks": SAME, "runs": SAME,
    "semicolons": EITHER, "decimal commas": REFUSED, "doubled column": REFUSED, "cell missing": REFUSED,
    "cell too many": REFUSED, "header again": REFUSED, "further column": SAME, "no output": SAME,
}  # fmt: skip
"""What must come of each."""


@st.composite
def rewritings(draw: st.DrawFn) -> dict[str, Any]:
    column = draw(st.sampled_from(sorted(SCALES)))
    return {
        "samples": draw(st.integers(3, 15)),
        "seed": draw(st.integers(0, 99)),
        "way": draw(st.sampled_from(sorted(WAYS))),
        "column": column,
        "unit": draw(st.sampled_from(sorted(SCALES[column]))),
        "strange": draw(st.sampled_from(STRANGE)),
        "cell": draw(st.sampled_from(CELLS)),
        "row": draw(st.integers(0, 100)),
        "order": draw(st.permutations(range(4))),
    }


def rewritten(rows: Rows, given: dict[str, Any]) -> bytes:
    """The measurement in that way."""
    place = ("time", "input", "output").index(given["column"])
    row = 1 + given["row"] % (len(rows) - 1)
    rng = np.random.default_rng(given["row"])
    header, cells = rows[0], rows[1:]
    match given["way"]:
        case "scaled":
            header[place] = f"{given['column']} [{given['unit']}]"
            for each in cells:
                each[place] = repr(float(each[place]) * SCALES[given["column"]][given["unit"]])
        case "strange unit":
            header[place] = f"{given['column']} [{given['strange']}]"
        case "no unit":
            header[:] = [name.split(" [")[0] for name in header]
        case "columns permuted":
            rows = [[each[index] for index in given["order"]] for each in rows]
        case "rows shuffled":
            order = np.roll(np.arange(len(cells)), 1 + given["row"] % (len(cells) - 1))
            rows = [header, *(cells[index] for index in order)]
        case "odd cell":
            rows[row][place] = given["cell"]
        case "no number":
            rows[row][min(place, 1)] = ("nan", "inf", "", "x", "NA")[given["row"] % 5]
        case "time repeated":
            rows[row][0] = rows[row - 1 if row > 1 else row + 1][0]
        case "capitals":
            header[:] = [name.split(" [")[0].upper() + f" [{name.split(' [')[1]}" for name in header]
        case "blanks":
            rows = [[f"  {cell} " for cell in each] for each in rows]
        case "blank lines":
            rows = [header, *(line for each in cells for line in (each, []))]
        case "remarks":
            rows = [[*each, "remark" if each is header else "a word"] for each in rows]
        case "runs":
            rows = [[*each, "run" if each is header else "only"] for each in rows]
        case "doubled column":
            rows = [[*each, each[place]] for each in rows]
        case "cell missing":
            del rows[row][1:]
        case "cell too many":
            rows[row].insert(0, "1")
        case "header again":
            rows.insert(row, list(header))
        case "further column":
            rows = [[*each, "pressure [bar]" if each is header else f"{rng.normal():g}"] for each in rows]
        case "no output":
            rows = [[*each[:2], each[3]] for each in rows]
        case "decimal commas":
            return written([header, *([cell.replace(".", ",") for cell in each] for each in cells)], ";")
        case "semicolons":
            return written(rows, ";")
        case "quoted":
            return "\n".join(",".join(f'"{cell}"' for cell in each) for each in rows).encode()
        case "byte order mark":
            return b"\xef\xbb\xbf" + written(rows)
        case "line ends":
            return written(rows, end="\r\n")
    return written(rows)


def predicted(content: bytes) -> tuple[pd.DataFrame, str]:
    """By the command, and what it said. Raises UserError for a sentence."""
    folder = scratch()
    (folder / "model.json").write_text(json.dumps(MODEL), encoding="utf-8")
    (folder / "data.csv").write_bytes(content)
    paths = [str(folder / name) for name in ("model.json", "data.csv", "out.csv")]
    done = CliRunner().invoke(main, ["predict", *paths[:2], "--out", paths[2], "--force"])
    if done.exit_code == USER_AT_FAULT:
        raise UserError("predict", done.output)
    if done.exception is not None:
        raise done.exception
    return pd.read_csv(paths[2]), done.output


@cache
def as_it_is(samples: int, seed: int) -> pd.DataFrame:
    try:
        return predicted(written(table(samples, seed)))[0]
    except UserError as error:
        raise Wrong(f"as it is: refused: {error}") from None


def ask(given: dict[str, Any]) -> None:
    """Raises Wrong for other numbers, and for no word on another unit."""
    way, expected = given["way"], as_it_is(given["samples"], given["seed"])
    try:
        found, said = predicted(rewritten(table(given["samples"], given["seed"]), given))
    except UserError:
        if WAYS[way] in (SAME, TOLD):
            raise Wrong(f"{way}: refused") from None
        raise
    if WAYS[way] == REFUSED:
        raise Wrong(f"{way}: answered")
    if way == "scaled" and SCALES[given["column"]][given["unit"]] != 1.0 and "was converted to" not in said:
        raise Wrong(f"{way}: not told")
    if way == "odd cell" and is_number(given["cell"]):
        return  # another measurement
    columns = ["time [s]", "input [V]", "output [um]"]
    if list(found.columns[:3]) != columns or not np.allclose(found[columns], expected[columns], rtol=1e-9, atol=1e-12):
        raise Wrong(f"{way}: other numbers")


TARGETS = (Target("data rewritten", rewritings(), ask, 15),)
