"""model.json with something changed in it: it predicts as before, or with a word, or a sentence refuses it."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
from hypothesis import strategies as st

from benchmarks.fuzz.measurements import table, written
from benchmarks.fuzz.rewritten import MODEL
from benchmarks.fuzz.target import Target, Wrong, scratch
from benchmarks.fuzz.trees import Place, changed, changes, holder
from hysteresis_bench.arrays import Array
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import read_model
from hysteresis_bench.signals import Dataset

PREPARED = {
    **MODEL,
    "effects": [
        *MODEL["effects"],
        {
            "effect": "record-offset",
            "settings": {"default": 0.25},
            "parameters": {},
        },
    ],
    "preparation": {"input_offset": 0.5, "flip": True, "skip": 0.01, "settle": 3},
    "data": {"fitted": ["a"], "held_out": [], "ranges": {"input": [-5.0, 5.0], "output": [-9.0, 9.0]}},
    "created_by": {"hysteresis-bench": "0.1.0"},
}


@cache
def records() -> Dataset:
    path = scratch() / "measured.csv"
    path.write_bytes(written([row[:2] for row in table(12, 3)]))
    return read_data([path], output_needed=False)


def predicted(text: bytes) -> tuple[list[Array], tuple[str, ...]]:
    path = scratch() / "model.json"
    path.write_bytes(text)
    found = read_model(path).predict(records())
    return [record.output for record in found.records if record.output is not None], found.notes


@cache
def as_it_is() -> tuple[list[Array], tuple[str, ...]]:
    try:
        return predicted(json.dumps(PREPARED).encode())
    except UserError as error:
        raise Wrong(f"as it is: refused: {error}") from None


def ask(given: tuple[str, Place, Any]) -> None:
    """Raises Wrong for what is not finite, and for other numbers that nobody asked for."""
    how, place, what = given
    outputs, told = as_it_is()
    found, notes = predicted(json.dumps(changed(PREPARED, how, place, what)).encode())
    if not all(np.all(np.isfinite(output)) for output in found):
        raise Wrong(f"not finite after {given}")
    same = all(np.array_equal(one, other) for one, other in zip(found, outputs, strict=True))
    if not same and notes == told and not _is_another_model(how, place, what):
        raise Wrong(f"other numbers after {how} at {place}")
    if place[-1] == "unit" and what != holder(PREPARED, place)[place[-1]] and how in ("odd", "other"):
        raise Wrong(f"the same numbers in another unit, after {how} at {place}")


def _is_another_model(how: str, place: Place, what: Any) -> bool:
    """Whether the file says so itself, and says it well: a number for a number, a whole effect or parameter."""
    if len(place) == 2 and place[0] == "effects":
        return True
    number = isinstance(what, (int, float)) and not isinstance(what, bool)
    right = isinstance(what, bool) if place[-1] == "flip" else number or (isinstance(what, dict) and "value" in what)
    return how in ("odd", "other") and right


def spoilt() -> st.SearchStrategy[bytes]:
    """Bytes gone wrong."""
    text = json.dumps(PREPARED, indent=1).encode()
    flipped = st.tuples(st.integers(0, len(text) - 1), st.binary(min_size=1, max_size=3)).map(
        lambda at: text[: at[0]] + at[1] + text[at[0] + 1 :]
    )
    return st.one_of(flipped, st.integers(0, len(text)).map(lambda end: text[:end]), st.binary(max_size=60))


def ask_bytes(given: bytes) -> None:
    """Raises Wrong for what is not finite."""
    if not all(np.all(np.isfinite(output)) for output in predicted(given)[0]):
        raise Wrong("not finite")


TARGETS = (Target("model files", changes(PREPARED), ask, 12), Target("bytes of model files", spoilt(), ask_bytes, 3))
