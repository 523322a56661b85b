"""One round of the search: what was tried on top of a system."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.nested_test import NestedTest


@dataclass(frozen=True, eq=False)
class Round:
    """On top of `current`: hypotheses and tests by candidate; `chosen` is empty where none passed."""

    current: Hypothesis
    hypotheses: Mapping[str, Hypothesis]
    tests: Mapping[str, NestedTest]
    chosen: str
