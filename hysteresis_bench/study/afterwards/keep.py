"""What is kept of a study: its tables and the course of its searches, small enough for git."""

from __future__ import annotations

import shutil
from collections.abc import Collection
from pathlib import Path

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.kept_files.closing_files import CLOSING
from hysteresis_bench.study.kept_files.courses import COURSES, write_courses
from hysteresis_bench.study.results import (
    IDENTIFIABILITY,
    PROVENANCE,
    PUBLISHED,
    STAGED_TRIALS,
    STAGES,
    STUDY,
    TRIALS,
    Results,
)
from hysteresis_bench.study.store import FILE
from hysteresis_bench.study.strict import read_toml

KEPT = (STUDY, PUBLISHED, PROVENANCE, TRIALS, IDENTIFIABILITY, STAGES, STAGED_TRIALS)
CLOSED = ("closing.json", "diagnosis.json", "model.json", "responses.csv")
"""Of the diagnosis at its end; its page, and what only that shows, are written from these."""


def check_kept(results: Path, folder: Path) -> None:
    """Raises UserError where a folder other than the results' own holds something that is no kept study."""
    if not folder.is_dir() or folder.resolve() == results.resolve() or not any(folder.iterdir()):
        return
    if not (folder / STUDY).is_file() or (folder / FILE).exists():
        what = "the trials of a study" if (folder / STUDY).is_file() else "something that is no kept study"
        raise UserError(str(folder), f"holds {what}, with which what is kept would be mixed. Choose another folder.")


def keep_small(results: Results, folder: Path, moving: Collection[str] = ()) -> Path:
    """Copy what a page follows from into a folder; returns it. moving : optimizers whose parameters are kept along the
    search

    Raises UserError where the course of the searches is not there to be kept, or the folder keeps another study.
    """
    if not results.traces:
        raise UserError(
            str(results.folder), "has no course of its searches to keep: neither trials.sqlite nor " + COURSES
        )
    there = read_toml(folder / STUDY)[0].get("title") if (folder / STUDY).is_file() else results.study.title
    if there != results.study.title:
        raise UserError(str(folder), f'keeps another study, "{there}". Choose another folder.')
    folder.mkdir(parents=True, exist_ok=True)
    _copy(results.folder, folder, KEPT)
    if (results.folder / CLOSING).is_dir():
        (folder / CLOSING).mkdir(exist_ok=True)
        _copy(results.folder / CLOSING, folder / CLOSING, CLOSED)
    write_courses(folder, results.traces, moving)
    return folder


def _copy(here: Path, there: Path, names: Collection[str]) -> None:
    for name in names:
        if (here / name).is_file() and here.resolve() != there.resolve():
            shutil.copyfile(here / name, there / name)
