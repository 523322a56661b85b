"""Run a study: trials into the store as they finish, then the tables. Run again, and it continues."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.errors import UserError, told
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.study.afterwards.best_fits import identifiability
from hysteresis_bench.study.afterwards.once_more import write_responses
from hysteresis_bench.study.afterwards.staged_trials import run_staged_trials
from hysteresis_bench.study.execution.cluster import Cluster
from hysteresis_bench.study.execution.pool import MACHINE, Pool, Work
from hysteresis_bench.study.execution.shards import Shard
from hysteresis_bench.study.execution.trial import (
    Ticket,
    needs_own_process,
    prepare_trial,
    rehearsals,
    tickets_of,
)
from hysteresis_bench.study.kept_files.reader import Reader
from hysteresis_bench.study.kept_files.trial_rows import FIRST, as_kept
from hysteresis_bench.study.lock import alone, write_whole
from hysteresis_bench.study.problems import build_problem, closing_dataset
from hysteresis_bench.study.provenance import describe
from hysteresis_bench.study.results import IDENTIFIABILITY, STAGED_COLUMNS, STAGED_TRIALS, STAGES, TRIALS
from hysteresis_bench.study.store import DAMAGED, FILE, Outcome, Store
from hysteresis_bench.study.study_file import Study, read_study


@dataclass(frozen=True)
class RunOptions:
    """Where and what of a study is run.

    retry : do again what failed by the machine's fault: trials killed from outside, out of memory, or not started
    scheduler : the address of a Dask scheduler whose workers run the trials, instead of processes here
    shard : run this part of the trials only, into a folder of its own
    instances : overrides the number of every problem on a rig
    """

    retry: bool = False
    scheduler: str | None = None
    shard: Shard | None = None
    instances: int | None = None

    def study(self, study: Study) -> Study:
        """With the number of instances that was asked for."""
        if self.instances is None:
            return study
        specs = [spec.model_copy(update={"instances": None}) for spec in study.problem]
        return study.model_copy(update={"instances": self.instances, "problem": specs})


@dataclass(frozen=True)
class Progress:
    """How far a study is, after every trial, and once before the first (outcome None).

    notes : what was done to the data, and what else the user should know, a sentence each; before the first trial
    """

    done: int
    total: int
    outcome: Outcome | None
    notes: tuple[str, ...] = ()


@economical()
def run_study(
    path: Path | str,
    *,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    options: RunOptions | None = None,
    on_progress: Callable[[Progress], None] = lambda progress: None,
) -> Path:
    """Run every trial of a study that is not in its results folder yet, then its tables; returns that folder.

    trials : overrides the file's number; jobs : worker processes, all cores by default;
    out : the results folder, see default_folder
    A shard writes no tables but the trials'.
    Raises UserError for a fault in the file, the data, or the folder.
    """
    path = Path(path)
    options = options or RunOptions()
    study, text = read_study(path)
    study = options.study(study)
    folder = Path(out) if out else default_folder(path, options.shard)
    built = {spec.name: build_problem(spec, study.seed, path.parent) for spec in study.problem}
    if study.closing:
        closing_dataset(study, path.parent)  # its faults are told before the trials, not after them
    folder.mkdir(parents=True, exist_ok=True)
    with alone(folder):
        notes = describe(folder, path, study=study, text=text, built=built)
        with _opened(folder) as store:
            store.begin(study.title)
            if options.retry:
                store.forget(MACHINE)
            tickets = tickets_of(study, path.parent, trials or study.trials)
            tickets = options.shard.of_tickets(tickets) if options.shard else tickets
            present = store.keys()
            missing = [ticket for ticket in tickets if ticket.key not in present]
            done = len(tickets) - len(missing)
            on_progress(Progress(done, len(tickets), None, notes))
            for outcome in _outcomes(study, missing, jobs, options.scheduler):
                store.add(outcome)
                done += 1
                on_progress(Progress(done, len(tickets), outcome))
            table, traces = store.table(), store.traces()
        write_table(folder / TRIALS, as_kept(table))
    if options.shard:
        return folder
    if study.stage:
        kept = Reader(folder).csv(STAGED_TRIALS, STAGED_COLUMNS)
        rows = run_staged_trials(study, table, built, folder=path.parent, kept=kept)
        write_table(folder / STAGED_TRIALS, rows, digits=7)
    table = table[table["instance"] == FIRST]  # what follows the trials is told of the rig as it stands
    staged = write_responses(folder, study, table, built, data=path.parent)
    if study.stage:
        write_table(folder / STAGES, staged)
    determined = json.dumps(identifiability(study, table, built, traces=traces), indent=1, allow_nan=False)
    write_whole(folder / IDENTIFIABILITY, determined + "\n")
    return folder


def default_folder(study: Path, shard: Shard | None = None) -> Path:
    """runs/NAME, in the project for a file in its studies folder, beside the file otherwise; a shard has its own."""
    home = study.resolve().parent
    name = f"{study.stem}.{shard}" if shard else study.stem
    return (home.parent if home.name == "studies" else home) / "runs" / name


def _opened(folder: Path) -> Store:
    """The store of a results folder. Raises UserError where what it holds cannot be read."""
    try:
        store = Store(folder)
        store.table()
        store.traces()
    except DAMAGED as error:
        again = "Move it elsewhere and run the study again, from its first trial."
        raise UserError(str(folder / FILE), f"is damaged ({told(error)}). {again}") from None
    return store


def _outcomes(study: Study, missing: Sequence[Ticket], jobs: int | None, scheduler: str | None) -> Iterator[Outcome]:
    """Of the tickets, as they end, in no order."""
    if not missing:
        return
    work = Work(prepare_trial, study.timeout, rehearsals(missing), needs_own_process)
    with Cluster(work, scheduler) if scheduler else Pool(work, jobs or os.cpu_count() or 1) as workers:
        for ticket, outcome, status, reason in workers.run(missing):
            yield outcome or ticket.ended(study, status, reason)
