"""The answer of a study of diagnosis: a plain sentence, and the shares with their intervals as a small table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.report.diagnosis_study.sure import sure_in_words
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import NONE, percent
from hysteresis_bench.statistics import wilson

OWN, ANOTHER = "made with the law asked about", "made with another law"

GOOD = 1.15
"""RMSE over noise up to which records that were neither fitted nor held out count as predicted."""

SEEN = 2.0
"""RMSE of the bare model over noise from which what is hidden is big enough to be asked for."""


@dataclass(frozen=True)
class Halves:
    """Cases by the law that made their data: the one that is asked about, or another."""

    own: Sequence[Case]
    another: Sequence[Case]

    @property
    def named(self) -> list[tuple[str, Sequence[Case]]]:
        """Those of which any case has finished, finished ones only."""
        halves = ((OWN, self.own), (ANOTHER, self.another))
        done = [(where, [case for case in cases if case.status == "done"]) for where, cases in halves]
        return [(where, cases) for where, cases in done if cases]


@dataclass(frozen=True)
class Share:
    """A row of the table. hits : whether each case that is asked is one, of finished cases"""

    words: str
    hits: Callable[[Sequence[Case]], list[bool]]


SHARES = (
    Share("Named: everything hidden, and nothing else", lambda cases: [c.right for c in cases if c.hidden]),
    Share(
        "The same, a family told with its curve included",
        lambda cases: [c.right_by_family for c in cases if c.hidden],
    ),
    Share(
        "Named, of what at least doubles the bare model's error",
        lambda cases: [c.right for c in cases if c.hidden and (c.unfitted or 0.0) >= SEEN],
    ),
    Share("Something claimed, where nothing is hidden", lambda cases: [bool(c.claimed) for c in cases if not c.hidden]),
    Share(
        f"Other records predicted to within {GOOD:g} times the noise",
        lambda cases: [c.fresh <= GOOD for c in cases if c.fresh is not None],
    ),
)


def answer_in_words(title: str, halves: Halves) -> list[str]:
    """How often names are right, and whether the probabilities are; the latter first where the title asks for them."""
    if not halves.named:
        return ["No case has finished."]
    said = [*_names(halves), sure_in_words([*halves.own, *halves.another])]
    return [words for words in (said[::-1] if "probabilit" in title.lower() else said) if words]


def shares_table(halves: Halves) -> Table | None:
    """A row a share that any case is asked for, a column a half; None where no case has finished."""
    shown = halves.named
    rows: list[list[str | Cell]] = [
        [Cell(share.words, "prose"), *(_share(share.hits(cases)) for _, cases in shown)]
        for share in SHARES
        if any(share.hits(cases) for _, cases in shown)
    ]
    note = (
        "Cases, with 95 % intervals (Wilson). Named includes tied with one that these data cannot tell from it. Other "
        "records were neither fitted nor held out."
    )
    header = ["Cases", *(f"{where[:1].upper()}{where[1:]}" for where, _ in shown)]
    return Table("How often it is right", header, rows, note) if rows else None


def _names(halves: Halves) -> list[str]:
    """One sentence on what was named, and on what was claimed of clean data."""
    named, clean = [], []
    for where, cases in halves.named:
        right, family = (SHARES[place].hits(cases) for place in (0, 1))
        more = sum(family) - sum(right)
        curves = f" ({sum(family)} where a family told with its curve counts too)" if more else ""
        named += [f"{sum(right)} of {len(right)} cases {where}{curves}"] if right else []
        wrong = SHARES[3].hits(cases)
        clean += [f"{sum(wrong)} of {len(wrong)} {where}"] if wrong else []
    said = [f"everything hidden was named, and nothing else, in {' and in '.join(named)}"] if named else []
    said += [f"where nothing is hidden, something was claimed in {' and in '.join(clean)}"] if clean else []
    words = "; ".join(said)
    return [f"{words[:1].upper()}{words[1:]}."]


def _share(hits: Sequence[bool]) -> str:
    """12 of 13 (67 % to 99 %)."""
    if not hits:
        return NONE
    low, high = wilson(sum(hits), len(hits))
    return f"{sum(hits)} of {len(hits)} ({percent(low, 2)} to {percent(high, 2)})"
