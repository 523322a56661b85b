"""The page of a study of diagnosis: who was named, who was missed, what was claimed of clean data."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.diagnosis_study.results import CASES, CONFUSION, STUDY, read_cases
from hysteresis_bench.diagnosis_study.study_file import read_diagnosis_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.diagnosis_study.answer import ANOTHER, OWN, Halves, answer_in_words, shares_table
from hysteresis_bench.report.diagnosis_study.confused import confusion_blocks
from hysteresis_bench.report.diagnosis_study.figures import shown
from hysteresis_bench.report.diagnosis_study.settled import settled_section
from hysteresis_bench.report.diagnosis_study.sure import sure_section
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Table
from hysteresis_bench.report.shared.page import Page, Section, files_beside
from hysteresis_bench.report.shared.text import NONE, listed, number, sentence, whole

FILE = "report.html"


def write_diagnosis_study_page(folder: Path) -> Path:
    """Write report.html and figures/*.svg into the results folder of a study of diagnosis; returns the page.

    Raises UserError where no case is there.
    """
    study, _ = read_diagnosis_study(folder / STUDY)
    halves = _halves(folder)
    cases = [*halves.own, *halves.another]
    if not cases:
        raise UserError(
            str(folder), f"holds no cases: neither its folder cases nor {CASES} has any. Run the study again."
        )
    confusions = confusion_blocks(folder, "known", sentence(OWN).rstrip("."), halves.own)
    confusions += confusion_blocks(folder, "rigs", sentence(ANOTHER).rstrip("."), halves.another)
    benches = _benches([bench.name for bench in study.bench], cases)
    wrong = _wrong([case for case in cases if case.status == "done"])
    failures = _failures([case for case in cases if case.status != "done"])
    sections = [
        Section("confusion", "What was hidden, and what was claimed", confusions),
        *sure_section(folder, cases),
        *settled_section(cases),
        Section("benches", "The error, before and after", [benches]),
        *([Section("wrong", "Where it went wrong", [wrong])] if wrong.rows else []),
        *([Section("failures", "What did not finish", [failures])] if failures.rows else []),
        _how(study.notes),
    ]
    shares = shares_table(halves)
    said: list[Block] = [*answer_in_words(study.title, halves), *([shares] if shares else [])]
    page = Page(study.title, f"A study of diagnosis, {len(cases)} cases", sections, said)
    return page.write(folder / FILE)


def answer(folder: Path) -> list[str]:
    """The answer in sentences."""
    return answer_in_words(read_diagnosis_study(folder / STUDY)[0].title, _halves(folder))


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
        "Held-out records, before",
        "Held-out records, after",
        "Other records, after",
        "Seconds",
    ]
    note = (
        "RMSE over the noise, medians; about 1: at the noise, a little below it by chance. Other records were neither "
        "fitted nor held out."
    )
    return Table("Bench by bench", header, rows, note=note)


def _median(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else None


def _wrong(cases: Sequence[Case]) -> Table:
    """What is right neither by name nor by family; the note counts those that are right by family alone."""
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
        if not case.right_by_family
    ]
    header = ["Case", "Hidden", "Claimed", "Missed", "Extra", "Verdict"]
    header += ["Fitted records, bare model", "Held-out records, after"]
    note = "The last two: RMSE over the noise; about 1: at the noise."
    if by_family := sum(case.right_by_family and not case.right for case in cases):
        note += (
            f" Not listed: {whole(by_family)} more that are wrong by name and right by family, told with its curve; "
            f"they are in {CASES}."
        )
    return Table("Cases that went wrong", header, rows, note)


def _names(text: str) -> str:
    return listed([shown(name) for name in text.split()]) if text else NONE


def _failures(cases: Sequence[Case]) -> Table:
    rows: list[list[str | Cell]] = [
        [f"{case.bench}, {case.number}", case.status, Cell(case.reason, "prose")] for case in cases
    ]
    return Table("Cases without a diagnosis", ["Case", "Status", "Reason"], rows)


def _halves(folder: Path) -> Halves:
    """Cases where the hysteresis is the model's own, as the rig is built with that model, and the others."""
    benches = {bench.name: bench for bench in read_diagnosis_study(folder / STUDY)[0].bench}
    own = {name for name, bench in benches.items() if bench.settings.get("model") == bench.model}
    cases = [case for case in read_cases(folder) if case.bench in benches]
    return Halves(
        [case for case in cases if case.bench in own],
        [case for case in cases if case.bench not in own],
    )
