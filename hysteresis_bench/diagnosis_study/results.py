"""The results folder of a study of diagnosis: the study, a JSON file a finished case, and the tables of them all."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import pandas as pd

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.diagnosis_study.case import Case, CaseTicket
from hysteresis_bench.diagnosis_study.confusion import confusion
from hysteresis_bench.diagnosis_study.study_file import DiagnosisStudy, read_diagnosis_study
from hysteresis_bench.errors import UserError

STUDY, CASES, CONFUSION, FOLDER = "study.toml", "cases.csv", "confusion.csv", "cases"


def read_cases(folder: Path) -> list[Case]:
    """All finished cases, by bench, then by number."""
    found = [Case(**json.loads(file.read_text(encoding="utf-8"))) for file in (folder / FOLDER).glob("*.json")]
    return sorted(found, key=lambda case: (case.bench, case.number))


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
    write_table(folder / CASES, pd.DataFrame([{**asdict(case), "right": case.right} for case in cases]))
    write_table(folder / CONFUSION, confusion(cases), index=True)


def check_same(folder: Path, study: DiagnosisStudy) -> None:
    """Raises UserError where the folder holds another study; `trials`, words and more benches make no other."""
    if not (folder / STUDY).is_file():
        return
    before, _ = read_diagnosis_study(folder / STUDY)
    now = {bench.name: bench for bench in study.bench}
    faults = [f'bench "{b.name}" is not the same.' for b in before.bench if now.get(b.name, b) != b]
    if before.seed != study.seed:
        faults.append(f"seed was {before.seed} there and is {study.seed} here.")
    if faults:
        raise UserError(f"{folder} holds another study", [*faults, "Choose another folder with --out."])
