"""The paper audit: every statement about what is printed, checked by its own arithmetic."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.report.paper.expression import evaluate
from hysteresis_bench.report.paper.published import Audit, Published

SAMPLES = 200_000
SEED = 1
"""Points drawn for an entry with a `sample`, always the same ones."""


@dataclass(frozen=True)
class Finding:
    """One audited statement. value : what the arithmetic gives, None for a remark on words;
    borne_out : does it give what is expected? None where there is nothing to compute."""

    entry: Audit
    value: bool | float | None = None
    borne_out: bool | None = None
    fault: str = ""


def audit(published: Published) -> list[Finding]:
    """All entries in order. An entry whose arithmetic cannot be evaluated carries its fault."""
    return list(_findings(published))


def _findings(published: Published) -> Iterator[Finding]:
    names: dict[str, Any] = dict(published.values)
    names |= {name: table.columns for name, table in published.tables.items()}
    for entry in published.audit:
        if not entry.arithmetic:
            yield Finding(entry)
            continue
        try:
            value = _scalar(evaluate(entry.arithmetic, names | drawn(entry)))
        except ValueError as error:
            yield Finding(entry, fault=str(error), borne_out=False)
            continue
        if entry.name:
            names[entry.name] = value
        yield Finding(entry, value, _agrees(value, entry))


def drawn(entry: Audit) -> dict[str, Array]:
    """(SAMPLES,) for each name in the entry's sample, uniform in its box."""
    rng = np.random.default_rng(SEED)
    points = {name: rng.random(SAMPLES) for name in sorted(entry.sample)}
    found = {}
    for name, (low, high) in entry.sample.items():
        if entry.scaling == "log":
            found[name] = np.exp(np.log(low) + (np.log(high) - np.log(low)) * points[name])
        else:
            found[name] = low + (high - low) * points[name]
    return found


def _scalar(value: Any) -> bool | float:
    if np.ndim(value) != 0:
        raise ValueError(f"the arithmetic gives {np.size(value)} values where one is wanted; take a mean or a max")
    return bool(value) if isinstance(value, (bool, np.bool_)) else float(value)


def _agrees(value: bool | float, entry: Audit) -> bool | None:
    if entry.expects is None:
        return None
    if isinstance(entry.expects, bool) or isinstance(value, bool):
        return value is entry.expects
    return abs(value - entry.expects) <= entry.tolerance * abs(entry.expects)
