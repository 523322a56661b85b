"""Run a study: trials into the store as they finish, then the tables. Run again, and it continues."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.fit.seeds import seed_of
from hysteresis_bench.study.afterwards.best_fits import identifiability, responses
from hysteresis_bench.study.afterwards.stages import run_stages
from hysteresis_bench.study.execution.pool import Pool, Work
from hysteresis_bench.study.execution.trial import (
    Ticket,
    needs_own_process,
    prepare_trial,
    rehearsals,
    seed_key,
    tickets_of,
)
from hysteresis_bench.study.lock import alone
from hysteresis_bench.study.problems import build_problem, closing_dataset
from hysteresis_bench.study.provenance import describe
from hysteresis_bench.study.results import IDENTIFIABILITY, RESPONSES, STAGES, TRIALS
from hysteresis_bench.study.store import Outcome, Store
from hysteresis_bench.study.study_file import Study, read_study


@dataclass(frozen=True)
class Progress:
    """How far a study is, after every trial, and once before the first (outcome None)."""

    done: int
    total: int
    outcome: Outcome | None


def run_study(
    path: Path | str,
    *,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    on_progress: Callable[[Progress], None] = lambda progress: None,
) -> Path:
    """Run every trial of a study that is not in its results folder yet, then its tables; returns that folder.

    trials : overrides the file's number; jobs : worker processes, all cores by default;
    out : the results folder, see default_folder
    Raises UserError for a fault in the file, the data, or the folder.
    """
    path = Path(path)
    study, text = read_study(path)
    folder = Path(out) if out else default_folder(path)
    built = {spec.name: build_problem(spec, study.seed, path.parent) for spec in study.problem}
    if study.closing:
        closing_dataset(study, path.parent)  # its faults are told before the trials, not after them
    folder.mkdir(parents=True, exist_ok=True)
    with alone(folder):
        units = {name: one.dataset.units for name, one in built.items()}
        describe(folder, path, study=study, text=text, units=units)
        with Store(folder) as store:
            store.begin(study.title)
            tickets = tickets_of(study, path.parent, trials or study.trials)
            _run_missing(store, study, tickets, jobs or os.cpu_count() or 1, on_progress)
            table, traces = store.table(), store.traces()
    write_table(folder / TRIALS, table)
    staged, staged_responses = run_stages(study, table, built, folder=path.parent)
    if study.stage:
        write_table(folder / STAGES, staged)
    parts = [responses(table, built), staged_responses]
    write_table(folder / RESPONSES, pd.concat(parts), digits=7)
    determined = json.dumps(identifiability(study, table, built, traces=traces), indent=1, allow_nan=False)
    (folder / IDENTIFIABILITY).write_text(determined + "\n", encoding="utf-8")
    return folder


def default_folder(study: Path) -> Path:
    """runs/NAME, in the project for a file in its studies folder, beside the file otherwise."""
    home = study.resolve().parent
    return (home.parent if home.name == "studies" else home) / "runs" / study.stem


def _run_missing(
    store: Store, study: Study, tickets: Sequence[Ticket], jobs: int, on_progress: Callable[[Progress], None]
) -> None:
    present = store.keys()
    missing = [ticket for ticket in tickets if ticket.key not in present]
    done = len(tickets) - len(missing)
    on_progress(Progress(done, len(tickets), None))
    if not missing:
        return
    work = Work(prepare_trial, study.timeout, rehearsals(missing), needs_own_process)
    with Pool(work, jobs) as pool:
        for ticket, outcome, status, reason in pool.run(missing):
            seed = seed_of(*seed_key(study, ticket))[:16]
            ended = outcome or Outcome(*ticket.key, seed=seed, status=status, reason=reason)
            store.add(ended)
            done += 1
            on_progress(Progress(done, len(tickets), ended))
