"""The results folder of a study of diagnosis: the study, a JSON file a finished case, and the tables of them all."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.data.csv_files import read_table, write_table
from hysteresis_bench.diagnosis_study.case import Case, CaseTicket
from hysteresis_bench.diagnosis_study.confusion import confusion
from hysteresis_bench.diagnosis_study.study_file import DiagnosisStudy, read_diagnosis_study
from hysteresis_bench.errors import UserError, told
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.study.kept_files.reader import UNREADABLE

STUDY, CASES, CONFUSION, FOLDER = "study.toml", "cases.csv", "confusion.csv", "cases"


LISTED = 3
"""Benches that are told by name, where they are not the same."""

ADDED = ("family", "sure", "ties", "told", "settled", "then")
"""Fields that older files lack."""

TEXTS = tuple(field.name for field in fields(Case) if field.type == "str")
"""Fields whose cells may look like numbers, such as the only probability of a case."""


def read_cases(folder: Path) -> list[Case]:
    """All finished cases, by bench, then by number; told from cases.csv where the folder of their files is not kept.

    Raises UserError naming the file that is damaged.
    """
    files = sorted((folder / FOLDER).glob("*.json"))
    found = [_read(file, lambda path: [_case(json.loads(path.read_text(encoding="utf-8")))]) for file in files]
    if not (folder / FOLDER).is_dir() and (folder / CASES).is_file():
        found = [_read(folder / CASES, lambda path: [_case(row) for row in read_table(path, TEXTS).to_dict("records")])]
    return sorted((case for cases in found for case in cases), key=lambda case: (case.bench, case.number))


def _read(path: Path, read: Callable[[Path], list[Case]]) -> list[Case]:
    try:
        return read(path)
    except (*UNREADABLE, TypeError, KeyError, AttributeError) as error:
        again = "Delete it and run the study again."
        raise UserError(str(path), f"is damaged ({told(error)}). {again}") from None


def _case(content: Mapping[str, Any]) -> Case:
    """A case as its file or its row holds it. Raises TypeError for what is none."""
    values: dict[str, Any] = {}
    for field in fields(Case):
        value, text = content.get(field.name, "") if field.name in ADDED else content[field.name], field.type == "str"
        if value is None or value != value:  # an empty cell
            value = "" if text else None
        kinds: tuple[type, ...] = (str,) if text else (int,) if field.type == "int" else (int, float, type(None))
        if not isinstance(value, kinds) or isinstance(value, bool):
            raise TypeError(f"{field.name} is {value!r}")
        values[field.name] = value
    case = Case(**values)
    if sorted(f"{case.named} {case.tied} {case.missed}".split()) != sorted(case.hidden.split()):
        raise TypeError("what is hidden is neither named, tied nor missed")
    claimed = set(case.claimed.split())
    if not set(case.extra.split()) <= claimed or not all(claimed & set(e.split("|")) for e in case.named.split()):
        raise TypeError("what is named or extra is not claimed")
    return case


def is_finished(folder: Path, ticket: CaseTicket) -> bool:
    """Is the case's file there?"""
    return (folder / FOLDER / ticket.file).is_file()


def write_case(folder: Path, ticket: CaseTicket, case: Case) -> None:
    """Keep one finished case; a killed run leaves no half of it."""
    whole = folder / FOLDER / f"{ticket.file}.part"
    whole.write_text(json.dumps(asdict(case), indent=1) + "\n", encoding="utf-8")
    whole.rename(folder / FOLDER / ticket.file)


def write_tables(folder: Path, cases: Sequence[Case]) -> None:
    """cases.csv, a row a case, and confusion.csv."""
    write_table(
        folder / CASES,
        pd.DataFrame(
            [{**asdict(case), "right": case.right, "right_by_family": case.right_by_family} for case in cases]
        ),
    )
    write_table(folder / CONFUSION, confusion(cases), index=True)


def check_same(folder: Path, study: DiagnosisStudy) -> None:
    """Raises UserError where the folder holds another study; `trials`, words and more benches make no other."""
    if not (folder / STUDY).is_file():
        return
    before, _ = read_diagnosis_study(folder / STUDY)
    now = {bench.name: bench for bench in study.bench}
    other = [f'"{b.name}"' for b in before.bench if now.get(b.name, b) != b]
    are = "benches are" if len(other) > 1 else "bench is"
    faults = [f"{len(other)} {are} not the same there: {listed(other, LISTED)}."] if other else []
    if before.seed != study.seed:
        faults.append(f"seed was {before.seed} there and is {study.seed} here.")
    if faults:
        raise UserError(str(folder), f"holds another study: {' '.join(faults)} Choose another folder.")


def keep_tables(folder: Path, kept: Path) -> Path:
    """Copy the study and its tables to a folder, without a file a case; returns that folder.

    Raises UserError where another study is kept there, or a file of a case is damaged.
    """
    study, text = read_diagnosis_study(folder / STUDY)
    check_same(kept, study)
    kept.mkdir(parents=True, exist_ok=True)
    (kept / STUDY).write_text(text, encoding="utf-8")
    write_tables(kept, read_cases(folder))
    return kept
