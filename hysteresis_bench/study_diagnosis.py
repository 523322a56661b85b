"""A study from its first trial to its last section: the trials, what follows them, then one diagnosis.

The diagnosis runs in a worker process and is kept as files; what was done already is not done again.
"""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.findings.diagnosis_file import write_diagnosis
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.execution.pool import Pool, Work, at_once
from hysteresis_bench.study.kept_files.closing_files import CLOSING, DONE, OUTCOME, read_closing
from hysteresis_bench.study.kept_files.reader import Reader
from hysteresis_bench.study.lock import alone
from hysteresis_bench.study.problems import closing_dataset
from hysteresis_bench.study.run import Progress, RunOptions, run_study
from hysteresis_bench.study.study_file import Study, read_study

LIMIT = 1800.0
"""Seconds after which a diagnosis is stopped."""

NO_EFFECTS = ("noise", "parameters")
"""What a rig tells of itself under `hidden` beside its effects."""


@dataclass(frozen=True)
class ClosingTicket:
    """Which diagnosis to run, in how many processes (which changes no number), and the folder that it writes.
    The study travels as text."""

    study: str
    data: str
    out: str
    jobs: int | None = None


@dataclass(frozen=True)
class DiagnosisEnd:
    """How the worker ended; what it found is in the files."""

    status: str
    reason: str = ""


def run_with_diagnosis(
    path: Path | str,
    *,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    options: RunOptions | None = None,
    on_progress: Callable[[Progress], None] = lambda progress: None,
) -> Path:
    """Run or continue a study, and the diagnosis that its [closing] asks for; returns its results folder.

    Arguments and errors as of study.run.run_study.
    """
    folder = run_study(path, trials=trials, jobs=jobs, out=out, options=options, on_progress=on_progress)
    study, _ = read_study(Path(path))
    if study.closing and not (options and options.shard):
        with alone(folder):
            write_closing(study, Path(path).parent, folder, jobs)
    return folder


def write_closing(study: Study, data: Path, results: Path, jobs: int | None = None) -> None:
    """Diagnose what the study's [closing] asks for, into the sub-folder closing/ of its results.

    data : the folder where relative data files are looked for;  jobs : processes, as of DiagnosisOptions
    A diagnosis that failed is tried again by the next run, one that is there is kept as long as the same is asked.
    A failure ends no study: closing.json tells it.
    """
    asked = asked_for(study)
    before = read_closing(Reader(results))
    if before and before.finished and before.outcome.get("asked") == asked:
        return
    out = results / f"{CLOSING}.part"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    begun = time.monotonic()
    ticket = ClosingTicket(study.model_dump_json(), str(data.resolve()), str(out.resolve()), jobs)
    with Pool(Work(at_once(run_closing), LIMIT), 1) as pool:
        ((_, _, status, reason),) = pool.run([ticket])
    outcome = {
        "asked": asked,
        "hidden": hidden_names(closing_dataset(study, data)),
        "status": status,
        "reason": reason,
        "seconds": round(time.monotonic() - begun, 1),
    }
    (out / OUTCOME).write_text(json.dumps(outcome, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    shutil.rmtree(results / CLOSING, ignore_errors=True)
    out.rename(results / CLOSING)  # a killed run leaves no half a diagnosis


def asked_for(study: Study) -> dict[str, Any]:
    """All that the numbers of the diagnosis depend on, words left out; with the same, it is the same diagnosis."""
    assert study.closing is not None
    after = next(spec for spec in study.problem if spec.name == (study.closing.after or study.problem[0].name))
    source = {"rig", "rig_settings", "data", "skip", "settle"}
    asked = study.closing.model_dump(mode="json", exclude={"says", "after"})
    return {**asked, **after.model_dump(mode="json", include=source), "seed": study.seed}


def hidden_names(dataset: Dataset) -> list[str]:
    """What a rig is built with, as it names it, with its own words where it has some; nothing of measurements."""
    hidden: Mapping[str, Any] = dataset.hidden
    effects = {name.replace("_", "-"): value for name, value in hidden.items() if value and name not in NO_EFFECTS}
    return [f"{name} ({value})" if isinstance(value, str) else name for name, value in effects.items()]


def run_closing(ticket: ClosingTicket) -> DiagnosisEnd:
    """Diagnose and write diagnosis.json, model.json and responses.csv."""
    study = Study.model_validate_json(ticket.study)
    assert study.closing is not None
    spec, out = study.closing, Path(ticket.out)
    seen = closing_dataset(study, Path(ticket.data))
    blind = Dataset(seen.records, seen.held_out_names)
    try:
        options = DiagnosisOptions(seed=study.seed, jobs=ticket.jobs)
        asked = Question(spec.model, spec.effects, spec.settings, options=options)
        found = diagnose(blind, asked)
    except UserError as error:
        return DiagnosisEnd("raised", " ".join(error.faults))
    write_diagnosis(out, found)
    return DiagnosisEnd(DONE)
