"""Parts of a study that run where they cannot see each other, and their results put together again."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.execution.trial import Ticket
from hysteresis_bench.study.kept_files.json_forms import check_provenance
from hysteresis_bench.study.kept_files.reader import Reader
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.lock import PART
from hysteresis_bench.study.origin import Trial
from hysteresis_bench.study.provenance import differences
from hysteresis_bench.study.results import FINISHED, PROVENANCE, PUBLISHED, STUDY
from hysteresis_bench.study.store import DAMAGED, Outcome, Store
from hysteresis_bench.study.study_file import Study, read_study


@dataclass(frozen=True)
class Shard:
    """One of several parts of equal size, counted from 1."""

    number: int
    of: int

    @classmethod
    def read(cls, text: str) -> Shard:
        """From "2/8". Raises UserError."""
        match = re.fullmatch(r"(\d+)/(\d+)", text)
        if not match or not 1 <= int(match[1]) <= int(match[2]):
            raise UserError("--shard", f'"{text}" is no part of a whole such as 2/8, the second of eight.')
        return cls(int(match[1]), int(match[2]))

    def __str__(self) -> str:
        return f"{self.number}-of-{self.of}"

    def of_tickets(self, tickets: Sequence[Ticket]) -> list[Ticket]:
        """Its share of them, in the order of tickets_of: of every optimizer, as they differ in the time they take."""
        a_round = sum(ticket.trial == 0 and ticket.instance == FIRST for ticket in tickets)
        turn = 1 if a_round % self.of == 0 else 0  # without a turn, each part would always get the same optimizers
        turns = [turn * (ticket.trial + ticket.instance - FIRST) for ticket in tickets]
        return [t for index, t in enumerate(tickets) if (index + turns[index]) % self.of == self.number - 1]


def merge(folders: Sequence[Path], out: Path) -> int:
    """Put the trials of results folders of one study into a new folder; returns how many there are.

    Of a trial that several folders hold, one that has a result is kept. Tables and report are written by `run` into
    the new folder, which runs what is missing first.
    Raises UserError where a folder is named twice, or holds no study or another one, two results contradict each other,
    or `out` exists.
    """
    if out.exists():
        raise UserError(str(out), "exists already. Choose another folder with --out.")
    places = [folder.resolve() for folder in folders]
    if twice := [place for index, place in enumerate(places) if place in places[:index]]:
        named = dict.fromkeys(f"{place} is named twice; name every part once." for place in twice)
        raise UserError("merge", list(named))
    study = _same_study(folders)
    found: dict[Trial, tuple[Path, Outcome]] = {}
    for folder in folders:
        for outcome in _outcomes(folder):
            before = found.setdefault(outcome.key, (folder, outcome))
            if before[1].status not in FINISHED:
                found[outcome.key] = folder, outcome
            elif outcome.status in FINISHED and outcome.fitness != before[1].fitness:
                trial = " · ".join(map(str, outcome.key))
                raise UserError("merge", f"{trial} has one result in {before[0]} and another in {folder}.")
    part = out.with_name(f"{out.name}{PART}")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    with Store(part) as store:
        store.begin(study.title)
        store.extend(outcome for _, outcome in found.values())
    for name in (STUDY, PUBLISHED, PROVENANCE):
        if (folders[0] / name).is_file():
            shutil.copyfile(folders[0] / name, part / name)
    os.replace(part, out)
    return len(found)


def _outcomes(folder: Path) -> list[Outcome]:
    try:
        with Store.reading(folder) as store:
            return list(store.outcomes())
    except DAMAGED as error:
        raise UserError(str(folder), f"its trials cannot be read: {error}.") from None


def _same_study(folders: Sequence[Path]) -> Study:
    faults = [f"{folder} holds no study." for folder in folders if not (folder / STUDY).is_file()]
    if faults:
        raise UserError("merge", faults)
    study, text = read_study(folders[0] / STUDY)
    whole = _provenance(folders[0])
    for folder in folders[1:]:
        other, its_text = read_study(folder / STUDY)
        found = differences(study.identity(), other.identity(), whole, _provenance(folder))
        if not found and its_text != text:
            found = ["its study file is not the same."]
        faults += [f"{folder}: {fault}" for fault in found]
    if faults:
        raise UserError(f"merge with {folders[0]}", faults)
    return study


def _provenance(folder: Path) -> dict[str, Any]:
    reader = Reader(folder)
    found = reader.json(PROVENANCE, check_provenance)
    if not found:
        raise UserError(str(folder / PROVENANCE), reader.damages or "is missing.")
    return found
