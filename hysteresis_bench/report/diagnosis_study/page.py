"""The page of a study of diagnosis: who was named, who was missed, what was claimed of clean data."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.diagnosis_study.confusion import NOTHING, confusion
from hysteresis_bench.diagnosis_study.results import CASES, CONFUSION, STUDY, read_cases
from hysteresis_bench.diagnosis_study.study_file import read_diagnosis_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.diagnosis_study.figures import confusion_matrix, reliability_diagram
from hysteresis_bench.report.diagnosis_study.reliability import Bin, reliability
from hysteresis_bench.report.diagnosis_study.settled import settled_section
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Figures, Heading, Table
from hysteresis_bench.report.shared.page import Page, Section, files_beside
from hysteresis_bench.report.shared.text import NONE, listed, number, percent, whole
from hysteresis_bench.statistics import wilson

FILE = "report.html"

OWN, ANOTHER = "Where the hysteresis is the model's own", "Where the hysteresis is not the model's own"

GOOD = 1.15
"""RMSE over noise up to which records that were neither fitted nor held out count as predicted."""

SEEN = 2.0
"""RMSE of the bare model over noise from which what is hidden is big enough to be asked for."""


def write_diagnosis_study_page(folder: Path) -> Path:
    """Write report.html and figures/*.svg into the results folder of a study of diagnosis; returns the page.

    Raises UserError where no case is there.
    """
    study, _ = read_diagnosis_study(folder / STUDY)
    known, others = _halves(folder)
    cases = [*known, *others]
    if not cases:
        raise UserError(
            str(folder), f"holds no cases: neither its folder cases nor {CASES} has any. Run the study again."
        )
    confusions = _confusion(folder, "known", known) + _confusion(folder, "rigs", others)
    benches = _benches([bench.name for bench in study.bench], cases)
    wrong = _wrong([case for case in cases if case.status == "done" and not case.right_by_family])
    failures = _failures([case for case in cases if case.status != "done"])
    sections = [
        Section("confusion", "What was hidden, and what was claimed", confusions),
        *_sure(folder, cases),
        *settled_section(cases),
        Section("benches", "The error, before and after", [benches]),
        *([Section("wrong", "Where it went wrong", [wrong])] if wrong.rows else []),
        *([Section("failures", "What did not finish", [failures])] if failures.rows else []),
        _how(study.notes),
    ]
    page = Page(study.title, f"A study of diagnosis, {len(cases)} cases", sections, _answer(known, others))
    return page.write(folder / FILE)


def answer(folder: Path) -> list[str]:
    """The answer in sentences."""
    return _answer(*_halves(folder))


def _sure(folder: Path, cases: Sequence[Case]) -> list[Section]:
    """Were the probabilities right? No section where none was told."""
    bins = reliability(cases)
    if not bins:
        return []
    count = sum(one.claims for one in bins)
    error = sum(one.claims * abs(one.right / one.claims - one.told) for one in bins) / count
    header = ["Probability told", "Claims", "Mean told", "Right", "95\u202f% interval"]
    rows = [_bin(one) for one in bins]
    note = (
        "Right: of the claims, those whose effect was hidden, or one tied with it, or of whose family one was hidden "
        "where the family was told with its curve. Intervals are Wilson's."
    )
    told = f"{count} claims; the mean gap between what was told and what was right is {percent(error, 2)}."
    return [
        Section(
            "sure",
            "How sure, and how right",
            [told, Figures([reliability_diagram(folder, bins)]), Table("Claims by probability", header, rows, note)],
        )
    ]


def _bin(one: Bin) -> list[str | Cell]:
    low, high = wilson(one.right, one.claims)
    share = Cell(percent(one.right / one.claims), "good" if low <= one.told <= high else "bad")
    bounds = f"{percent(one.low)} to {percent(one.high)}"
    return [bounds, whole(one.claims), percent(one.told), share, f"{percent(low)} to {percent(high)}"]


def _how(notes: Sequence[str]) -> Section:
    blocks: list[Block] = [Bullets(notes)] if notes else []
    blocks += [
        "A case is right when every hidden effect is named, or tied with a claimed one, and nothing else is claimed; "
        "it is right by family when for some of them the free form of their family is claimed. "
        "Intervals are Wilson’s. The noise is the one that was put in, where the rig tells it, otherwise its estimate "
        "from the data.",
        files_beside({CASES: "a row a case", CONFUSION: "hidden against claimed", STUDY: "the study"}),
    ]
    return Section("definitions", "How it was made", blocks)


def _answer(known: Sequence[Case], others: Sequence[Case]) -> list[str]:
    found = []
    for where, cases in ((OWN, known), (ANOTHER, others)):
        done = [case for case in cases if case.status == "done"]
        hidden = [case for case in done if case.hidden]
        if not done:
            continue
        clean = [case for case in done if not case.hidden]
        parts = []
        if hidden:
            parts.append(
                f"in {_share([case.right for case in hidden])} of the cases with something hidden every effect was "
                "named, or tied with one that these data cannot tell from it, and nothing else was claimed"
            )
            if any(case.family for case in hidden):
                parts.append(
                    "counting those where no formula fits and the right family was named with its curve, in "
                    f"{_share([case.right_by_family for case in hidden])}"
                )
            big = [case for case in hidden if (case.unfitted or 0.0) >= SEEN]
            if len(big) < len(hidden):
                parts.append(f"of those that at least double the bare model's error, {_share([c.right for c in big])}")
        if clean:
            parts.append(
                f"where nothing is hidden something was claimed in {_share([bool(case.claimed) for case in clean])}"
            )
        fresh = [case.fresh for case in done if case.fresh is not None]
        if fresh:
            parts.append(
                f"records that were neither fitted nor held out were predicted to within {GOOD:g} times the noise in "
                f"{_share([value <= GOOD for value in fresh])}"
            )
        found.append(f"{where}: {'; '.join(parts)}.")
    return found or ["No case has finished."]


def _share(hits: Sequence[bool]) -> str:
    """12 of 13 (92 %, 67 to 99 %), with Wilson's interval."""
    if not hits:
        return "none of none"
    low, high = wilson(sum(hits), len(hits))
    mean = sum(hits) / len(hits)
    shares = [f"{100 * share:.0f}\u202f%" for share in (mean, low, high)]
    return f"{sum(hits)} of {len(hits)} ({shares[0]}; 95\u202f% interval {shares[1]} to {shares[2]})"


def _confusion(folder: Path, name: str, cases: Sequence[Case]) -> list[Block]:
    """Figure and table under their heading; nothing without a case that is done."""
    table = confusion(cases)
    if table.empty:
        return []
    rows = sorted(table.index, key=lambda effect: (effect == NOTHING, effect))
    columns = sorted(table.columns, key=lambda effect: (effect == NOTHING, effect))
    counts = {(row, column): int(table.at[row, column]) for row in rows for column in columns if table.at[row, column]}
    heading = OWN if name == "known" else ANOTHER
    drawn = confusion_matrix(folder, f"confusion-{name}", counts, rows=rows, columns=columns)
    lines: list[list[str | Cell]] = [
        [row, *(_count(row, column, counts.get((row, column), 0)) for column in columns)] for row in rows
    ]
    note = "An effect that was missed stands under what was claimed in its place, or under nothing."
    counted = Table("Hidden (rows) against claimed (columns)", ["Hidden", *columns], lines, note)
    return [Heading(heading), Figures([drawn]), counted]


def _count(row: str, column: str, count: int) -> Cell:
    if not count:
        return Cell(NONE, "quiet")
    return Cell(str(count), "good" if column in row.split("|") else "bad")


def _benches(names: Sequence[str], cases: Sequence[Case]) -> Table:
    rows: list[list[str | Cell]] = []
    for name in names:
        mine = [case for case in cases if case.bench == name and case.status == "done"]
        if mine:
            right, family = sum(case.right for case in mine), sum(case.right_by_family for case in mine)
            rows.append(
                [
                    name,
                    Cell(f"{right} of {len(mine)}", "good" if right == len(mine) else "bad"),
                    Cell(f"{family} of {len(mine)}", "good" if family == len(mine) else "bad"),
                    *(number(_median([getattr(c, key) for c in mine]), 3) for key in ("before", "after", "fresh")),
                    whole(_median([case.seconds for case in mine])),
                ]
            )
    header = [
        "Bench",
        "Right",
        "Right, or its family",
        "Held out, before",
        "Held out, after",
        "Fresh, after",
        "Seconds",
    ]
    return Table("Bench by bench", header, rows, note="Median RMSE over the noise; 1 is as good as it gets.")


def _median(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else None


def _wrong(cases: Sequence[Case]) -> Table:
    rows: list[list[str | Cell]] = [
        [
            f"{case.bench}, {case.number}",
            *(Cell(_names(text), "prose") for text in (case.hidden, case.claimed)),
            Cell(_names(case.missed), "bad" if case.missed else ""),
            Cell(_names(case.extra), "bad" if case.extra else ""),
            case.verdict,
            number(case.unfitted, 3),
            number(case.after, 3),
        ]
        for case in cases
    ]
    header = ["Case", "Hidden", "Claimed", "Missed", "Extra", "Verdict", "Bare, over noise", "Held out, over noise"]
    return Table("Cases that went wrong", header, rows)


def _names(text: str) -> str:
    return listed(text.split()) if text else NONE


def _failures(cases: Sequence[Case]) -> Table:
    rows: list[list[str | Cell]] = [
        [f"{case.bench}, {case.number}", case.status, Cell(case.reason, "prose")] for case in cases
    ]
    return Table("Cases without a diagnosis", ["Case", "Status", "Reason"], rows)


def _halves(folder: Path) -> tuple[list[Case], list[Case]]:
    """Cases where the hysteresis is the model's own, as the rig is built with that model, and the others."""
    benches = {bench.name: bench for bench in read_diagnosis_study(folder / STUDY)[0].bench}
    own = {name for name, bench in benches.items() if bench.settings.get("model") == bench.model}
    cases = [case for case in read_cases(folder) if case.bench in benches]
    return [case for case in cases if case.bench in own], [case for case in cases if case.bench not in own]
