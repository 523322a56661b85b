"""Run a study of diagnosis: every case that is not in the results folder yet, in worker processes.

A case is a bench (a rig with effects switched on or off) and a number. A study goes on where it stopped; a case that
failed is a row like any other.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hysteresis_bench.diagnosis_study.case import Case, CaseTicket, run_case
from hysteresis_bench.diagnosis_study.results import (
    FOLDER,
    STUDY,
    check_same,
    is_finished,
    read_cases,
    write_case,
    write_tables,
)
from hysteresis_bench.diagnosis_study.study_file import read_diagnosis_study
from hysteresis_bench.study.execution.pool import Pool, Work, at_once
from hysteresis_bench.study.run import default_folder


@dataclass(frozen=True)
class CaseProgress:
    """How far a study is, after every case, and once before the first (case None)."""

    done: int
    total: int
    case: Case | None


def run_diagnosis_study(
    path: Path | str,
    *,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    on_progress: Callable[[CaseProgress], None] = lambda progress: None,
) -> Path:
    """Run every case that is not in the results folder yet, and write the tables; returns that folder.

    trials : cases of every bench, times its share; default the file's. jobs : worker processes, all cores by default
    Raises UserError for a fault in the file or a folder that holds another study.
    """
    path = Path(path)
    study, text = read_diagnosis_study(path)
    folder = Path(out) if out else default_folder(path)
    (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    check_same(folder, study)
    (folder / STUDY).write_text(text, encoding="utf-8")
    content = study.model_dump_json()
    tickets = [
        CaseTicket(content, bench.name, number)
        for bench in study.bench
        for number in bench.numbers(trials or study.trials)
    ]
    missing = [ticket for ticket in tickets if not is_finished(folder, ticket)]
    done = len(read_cases(folder))
    total = done + len(missing)
    on_progress(CaseProgress(done, total, None))
    models = {bench.name: bench.model for bench in study.bench}
    with Pool(Work(at_once(run_case), study.timeout), jobs or os.cpu_count() or 1) as pool:
        for ticket, case, status, reason in pool.run(missing):
            ended = case or Case(ticket.bench, models[ticket.bench], ticket.number, status, reason)
            write_case(folder, ticket, ended)
            done += 1
            on_progress(CaseProgress(done, total, ended))
    write_tables(folder, read_cases(folder))
    return folder
