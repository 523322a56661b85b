"""How many ties one advised experiment settles, and how often that was expected rightly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.report.diagnosis_study.sure import tone
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import percent, whole
from hysteresis_bench.statistics import wilson

EDGES = (0.0, 0.5, 0.8, 0.95)
"""Lower bounds of the bins of the probability that was told."""


@dataclass(frozen=True)
class Fate:
    """Of a tie: with what probability it was expected to be settled, where one was told, and what became of it, as in
    `Case.settled`. apart : what was foretold came true: the effect that was adopted is told from all the others"""

    told: float | None
    became: str
    apart: bool


def fates(cases: Sequence[Case]) -> list[Fate]:
    """Of all ties of cases whose bench measures what is advised."""
    found = []
    for case in (case for case in cases if case.status == "done"):
        later = case.then.split()
        for names, told, became in zip(case.ties.split(), case.told.split(), case.settled.split(), strict=True):
            apart = became == "right" or (became != "open" and names.split("~")[0] not in later)
            found.append(Fate(None if told == "-" else float(told), became, apart))
    return found


def settled_section(cases: Sequence[Case]) -> list[Section]:
    """Nothing where no bench measures, or nothing was tied."""
    ties = fates(cases)
    if not ties:
        return []
    header = ["Probability told", "Ties", "Mean told", "Told apart", "95\u202f% interval", "Settled", "Wrongly"]
    note = (
        "Told apart, as was foretold: the effect that was adopted from all the others. Settled: the hidden one alone "
        "is claimed after the experiment; wrongly: one is claimed that is not hidden. The intervals are Wilson's."
    )
    table = Table("Ties by the probability told", header, _rows(_foretold(ties)), note)
    return [Section("settled", "What one advised experiment settles", [words(ties), table])]


def words(ties: Sequence[Fate]) -> str:
    """The counts, as sentences."""
    became = [tie.became for tie in ties]
    said = (
        f"One advised experiment settled {became.count('right')} of {len(ties)} ties rightly and narrowed "
        f"{became.count('narrowed')}; {became.count('open')} stayed open, {became.count('wrong')} went wrong, of "
        f"{became.count('gone')} none is claimed any more, and in {became.count('void')} nothing hidden was tied."
    )
    told = _foretold(ties)
    if not told:
        return said
    mean = sum(tie.told or 0.0 for tie in told) / len(told)
    share = sum(tie.apart for tie in told) / len(told)
    return (
        f"{said} Of the {len(told)} ties that it was made for and that had a hidden one among them, {percent(mean, 2)} "
        f"of the adopted effects were expected to be told from all the others, and {percent(share, 2)} were."
    )


def _foretold(ties: Sequence[Fate]) -> list[Fate]:
    """Those with a probability, which takes one of the tied effects to be there."""
    return [tie for tie in ties if tie.told is not None and tie.became != "void"]


def _rows(ties: Sequence[Fate]) -> list[list[str | Cell]]:
    rows: list[list[str | Cell]] = []
    for low, high in zip(EDGES, (*EDGES[1:], 1.01), strict=True):
        inside = [tie for tie in ties if tie.told is not None and low <= tie.told < high]
        if not inside:
            continue
        mean = sum(tie.told or 0.0 for tie in inside) / len(inside)
        apart = sum(tie.apart for tie in inside)
        least, most = wilson(apart, len(inside))
        wrong = sum(tie.became == "wrong" for tie in inside)
        rows.append(
            [
                f"{percent(low)} to {percent(min(high, 1.0))}",
                whole(len(inside)),
                percent(mean, 2),
                Cell(percent(apart / len(inside), 2), tone(mean, least, most)),
                f"{percent(least, 2)} to {percent(most, 2)}",
                whole(sum(tie.became == "right" for tie in inside)),
                Cell(whole(wrong), "bad" if wrong else ""),
            ]
        )
    return rows
