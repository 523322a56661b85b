"""Study files: a value changed anywhere in one of ours, or its text; and the problems of a small one built."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from benchmarks.fuzz.measurements import table, written
from benchmarks.fuzz.target import Target, scratch
from benchmarks.fuzz.trees import changed, changes
from hysteresis_bench.diagnosis_study.study_file import read_diagnosis_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.study.problems import build_problem, closing_dataset
from hysteresis_bench.study.study_file import Study, check_study, read_study

STUDIES = Path(__file__).parents[2] / "studies"
OURS = {path.name: tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(STUDIES.glob("*.toml"))}
PUBLISHED = {name: raw for name, raw in OURS.items() if name.endswith(".published.toml")}
TRIALS = {name: raw for name, raw in OURS.items() if name not in PUBLISHED and "kind" not in raw}
SMALL = """
title = "small"
seed = 1
trials = 2
budget = 30
timeout = "1 min"
published = "small.published.toml"
notes = ["a note"]

[[problem]]
name = "all"
model = "bouc-wen"
settings = { n = 1.0 }
effects = ["bias", "output-lag"]
data = ["one.csv", "two.csv"]
fitted = ["one"]
held_out = ["two"]
scaling = "linear"
loss = "rmse"
box = "data"
bounds = { alpha = [0.0, 2.0], d = [0.5, 2.5] }
fixed = { gamma = 0.3 }
profile = ["alpha"]
optimizers = ["pso"]
skip = "0.01 s"

[[problem]]
name = "two"
model = "hammerstein"
data = ["one.csv"]
settle = false

[[optimizer]]
plugin = "pso"
settings = { particles = 10, inertia = 0.7 }

[[optimizer]]
plugin = "random-search"
label = "random"
budget = 20

[closing]
model = "bouc-wen"
settings = { n = 1.0 }
fitted = ["one"]
held_out = ["two"]
effects = ["bias"]
after = "all"
says = "nothing"
"""


@cache
def data() -> Path:
    """The folder with the small study's data."""
    folder = scratch() / "study"
    folder.mkdir()
    for seed, name in enumerate(("one", "two")):
        (folder / f"{name}.csv").write_bytes(written(table(60, seed)))
    return folder


@st.composite
def spoilt(draw: st.DrawFn, trees: dict[str, Any]) -> tuple[str, Any]:
    """The name of a study, and its content with one change or two."""
    name = draw(st.sampled_from(sorted(trees)))
    tree = trees[name]
    for _ in range(draw(st.sampled_from((1, 1, 2)))):
        tree = changed(tree, *draw(changes(tree)))
        if not tree:
            break
    return name, tree


def check(given: tuple[str, Any]) -> None:
    check_study(given[1], given[0])


def check_tables(given: tuple[str, Any]) -> None:
    check_published(given[1])


def build(given: tuple[str, Any]) -> None:
    """What `run` does before its first trial."""
    study = check_study(given[1], "small.toml")
    if not _ours(study):
        raise UserError("small.toml", "asks for a rig, which is built elsewhere.")
    for spec in study.problem:
        build_problem(spec, study.seed, data())
    if study.closing:
        closing_dataset(study, data())


def _ours(study: Study) -> bool:
    return all(spec.rig is None for spec in study.problem)


def texts() -> st.SearchStrategy[tuple[str, bytes]]:
    """The bytes of a study file gone wrong."""

    def of(name: str) -> st.SearchStrategy[tuple[str, bytes]]:
        text = (STUDIES / name).read_bytes() if name in OURS else SMALL.encode()
        places = st.integers(0, len(text) - 1)
        flipped = st.tuples(places, st.binary(max_size=3)).map(lambda at: text[: at[0]] + at[1] + text[at[0] + 1 :])
        torn = st.tuples(places, places).map(lambda at: text[: at[0]] + text[at[1] :])
        return st.tuples(st.just(name), st.one_of(flipped, torn, st.binary(max_size=80)))

    return st.sampled_from([*OURS, "small.toml"]).flatmap(of)


def read(given: tuple[str, bytes]) -> None:
    path = scratch() / "bytes.toml"
    path.write_bytes(given[1])
    (read_diagnosis_study if "kind" in OURS.get(given[0], {}) else read_study)(path)


TARGETS = (
    Target("study files", spoilt(TRIALS), check, 10),
    Target("small studies, built", spoilt({"small.toml": tomllib.loads(SMALL)}), build, 10),
    Target("published tables", spoilt(PUBLISHED), check_tables, 3),
    Target("bytes of study files", texts(), read, 5),
)
