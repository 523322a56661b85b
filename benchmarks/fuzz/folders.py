"""Results folders in which something is damaged: read, reported, or continued by `run`."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from functools import cache
from pathlib import Path
from typing import Any

import pandas as pd
from hypothesis import strategies as st

from benchmarks.fuzz.measurements import CELLS
from benchmarks.fuzz.study_files import data
from benchmarks.fuzz.target import Target, Wrong, scratch
from benchmarks.fuzz.trees import ODD, changed, places
from hysteresis_bench.diagnosis_study.results import read_cases
from hysteresis_bench.report.diagnosis_study.page import write_diagnosis_study_page
from hysteresis_bench.report.study import write_report
from hysteresis_bench.study.results import TRIALS, read_results
from hysteresis_bench.study.run import run_study
from hysteresis_bench.study.store import FILE

KEPT = Path(__file__).parents[2] / "results"
STUDY = """
title = "small"
seed = 1
trials = 2
budget = 30

[[problem]]
name = "p"
model = "bouc-wen"
data = ["one.csv", "two.csv"]
fitted = ["one"]
held_out = ["two"]
profile = ["alpha"]

[[optimizer]]
plugin = "pso"
settings = { particles = 10 }

[[optimizer]]
plugin = "random-search"
"""
COLUMNS = ("problem", "optimizer", "trial", "seed", "status", "reason", "evaluations", "fitness", "rmse",
           "relative_rms", "max_error", "held_out_rmse", "seconds", "parameters", "trace", "origin")  # fmt: skip
STORED = (
    None,
    "",
    "x",
    "done",
    0,
    -1,
    1e308,
    float("inf"),
    b"\x00\xff",
    b"PK\x03\x04",
    "{}",
    "[1]",
    '{"a": null}',
    "nan",
)

WAYS = ("cut", "flipped", "junk", "empty", "gone", "folder", "link", "text")
SPOILT = {
    ".toml": ((), ODD),
    ".json": (("tree",), ODD),
    ".csv": (("cell",), CELLS),
    ".sqlite": (("row", "table"), STORED),
}
"""Ways to spoil a kind of file besides, and what is put into it."""


@cache
def finished() -> Path:
    """A small study that has run."""
    path = data() / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    folder = run_study(path, jobs=1, out=data() / "finished")
    write_report(folder)
    return folder


def base(name: str) -> Path:
    return finished() if name == "finished" else KEPT / name


@cache
def files(name: str) -> list[str]:
    found = (file for file in base(name).rglob("*") if file.is_file() and file.suffix in SPOILT)
    return sorted(str(file.relative_to(base(name))) for file in found)


@st.composite
def damages(draw: st.DrawFn, names: tuple[str, ...]) -> tuple[str, list[tuple[str, str, tuple[Any, ...]]]]:
    """Which folder, and (file, how, with what) one or two times."""
    name = draw(st.sampled_from(names))
    found = []
    for _ in range(draw(st.sampled_from((1, 1, 2)))):
        file = draw(st.sampled_from(files(name)))
        inside, odd = SPOILT[Path(file).suffix]
        numbers = draw(st.tuples(st.integers(0, 10**6), st.integers(0, 10**6), st.integers(0, 255)))
        found.append((file, draw(st.sampled_from(WAYS + 8 * inside)), (*numbers, draw(st.sampled_from(odd)))))
    return name, found


def spoil(folder: Path, file: str, how: str, numbers: tuple[Any, ...]) -> None:
    """Damage one file; numbers : two that choose a place, a byte, and what is put there."""
    path = folder / file
    if not path.is_file():
        return
    where, which, byte, odd = numbers
    content = path.read_bytes()
    if how in ("tree", "cell", "row", "table"):
        {"tree": _spoil_json, "cell": _spoil_csv, "row": _spoil_store, "table": _drop}[how](path, where, which, odd)
    elif how == "cut":
        path.write_bytes(content[: where % (len(content) + 1)])
    elif how == "flipped" and content:
        place = where % len(content)
        path.write_bytes(content[:place] + bytes([byte]) + content[place + 1 :])
    elif how in ("junk", "empty", "text"):
        path.write_bytes({"junk": b"\x00\xff[{]}" * 50, "empty": b"", "text": b"[1, 2]\n"}[how])
    elif how in ("gone", "folder", "link"):
        path.unlink()
        if how == "folder":
            path.mkdir()
        if how == "link":
            path.symlink_to("/nowhere")


def _spoil_json(path: Path, where: int, which: int, odd: Any) -> None:
    try:
        tree = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return
    if every := list(places(tree)):
        how = ("odd", "without", "renamed")[which % 3]
        path.write_text(json.dumps(changed(tree, how, every[where % len(every)], odd)), encoding="utf-8")


def _spoil_csv(path: Path, where: int, which: int, odd: Any) -> None:
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    if not lines:
        return
    row = 0 if which % 3 == 0 else where % len(lines)
    cells = lines[row].split(",")
    cells[which % len(cells)] = str(odd)
    lines[row] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", errors="replace")


def _spoil_store(path: Path, where: int, which: int, odd: Any) -> None:
    try:
        with closing(sqlite3.connect(path)) as store, store:
            store.execute(
                f"UPDATE trials SET {COLUMNS[which % len(COLUMNS)]} = ? WHERE rowid = ?", (odd, 1 + where % 4)
            )
    except sqlite3.Error:
        return


def _drop(path: Path, where: int, which: int, odd: Any) -> None:
    try:
        with closing(sqlite3.connect(path)) as store, store:
            store.execute(("DROP TABLE trials", "DROP TABLE study", "ALTER TABLE trials DROP COLUMN trace")[which % 3])
    except sqlite3.Error:
        return


def damaged(given: Any) -> Path:
    """A copy of the folder with its damages."""
    name, found = given
    folder = scratch() / "damaged"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(base(name), folder)
    for damage in found:
        spoil(folder, *damage)
    return folder


def read(given: Any) -> None:
    read_results(damaged(given))


def report(given: Any) -> None:
    write_report(damaged(given))


def proceed(given: Any) -> None:
    """Continue the study; raises Wrong where its trials are others then."""
    folder = damaged(given)
    run_study(data() / "study.toml", jobs=1, out=folder)
    before, after = (pd.read_csv(each / TRIALS).drop(columns="seconds") for each in (finished(), folder))
    edited = any(how == "row" for file, how, _ in given[1] if file == FILE)
    if not edited and not after.equals(before):
        raise Wrong("other trials after the study went on")
    write_report(folder)


def cases(given: Any) -> None:
    folder = damaged(given)
    read_cases(folder)
    write_diagnosis_study_page(folder)


TRIED = ("finished", "sma", "pea", "gma_instances")
TARGETS = (
    Target("results folders, read", damages(TRIED), read, 10),
    Target("results folders, reported", damages(("finished",)), report, 1),
    Target("results folders, continued", damages(("finished",)), proceed, 1),
    Target("studies of diagnosis, reported", damages(("closing_the_loop",)), cases, 1),
)
