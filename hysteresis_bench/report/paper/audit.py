"""The paper audit: every statement about what is printed, checked by its own arithmetic."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.report.paper.expression import evaluate
from hysteresis_bench.report.paper.published import Audit, Published
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, number

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


def section(findings: Sequence[Finding]) -> Section | None:
    """None without an audited statement."""
    if not findings:
        return None
    computed = [finding for finding in findings if finding.entry.arithmetic]
    wrong = [finding for finding in computed if finding.borne_out is False]
    verdict = "all of them are borne out" if not wrong else f"{len(wrong)} are not borne out"
    count = f"{len(findings)} statements, {len(computed)} with arithmetic that was evaluated for this page: {verdict}."
    what = "What is printed and cannot be so, what is misprinted, and what follows from the printed numbers."
    return Section("audit", "Paper audit", [f"{what} {count}", _table(findings)])


def _table(findings: Sequence[Finding]) -> Table:
    rows: list[list[str | Cell]] = []
    for found in findings:
        entry = found.entry
        how = f" (box sampled on a {entry.scaling} scale)" if entry.sample else ""
        rows.append(
            [
                entry.where,
                entry.printed,
                Cell(entry.says, "prose"),
                Cell(entry.kind, strong=True),
                Cell(f"{entry.arithmetic}{how} = {_gives(found)}", "code") if entry.arithmetic else NONE,
                _checked(found),
            ]
        )
    header = ["Where", "Printed", "What follows", "Kind", "Arithmetic", "Checked"]
    return Table("Statements about the paper, each checked by its arithmetic", header, rows)


def _gives(found: Finding) -> str:
    if found.fault:
        return found.fault
    if isinstance(found.value, bool):
        return "true" if found.value else "false"
    return number(found.value)


def _checked(found: Finding) -> Cell:
    if found.borne_out is None:
        return Cell("computed" if found.entry.arithmetic else "by reading", "quiet")
    return Cell("borne out", "good") if found.borne_out else Cell("not borne out", "bad")
