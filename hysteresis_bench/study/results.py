"""A results folder as it is read: the study, its trials with their traces, the best fits' responses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.kept_files.closing_files import Closing, read_closing
from hysteresis_bench.study.kept_files.courses import COURSES, read_courses
from hysteresis_bench.study.kept_files.json_forms import check_provenance
from hysteresis_bench.study.kept_files.reader import Reader
from hysteresis_bench.study.kept_files.trial_rows import FINISHED as FINISHED
from hysteresis_bench.study.kept_files.trial_rows import STATUSES as STATUSES
from hysteresis_bench.study.kept_files.trial_rows import check_rows, with_instances
from hysteresis_bench.study.origin import Trial, mixed
from hysteresis_bench.study.store import COLUMNS, DAMAGED, FILE, Store
from hysteresis_bench.study.study_file import Study, read_study

STUDY, PUBLISHED, PROVENANCE = "study.toml", "published.toml", "provenance.json"
TRIALS, SUMMARY, RESPONSES, REPORT = "trials.csv", "summary.csv", "responses.csv", "report.html"
IDENTIFIABILITY, STAGES, STAGED_TRIALS = "identifiability.json", "stages.csv", "staged-trials.csv"

RESPONSE_COLUMNS = ("problem", "optimizer", "record", "role", "time", "input", "output", "simulated")
STAGE_COLUMNS = ("stage", "quantity", "name", "value")
STAGED_COLUMNS = ("stage", "optimizer", "instance", "trial", "made_of", "fault")


@dataclass(frozen=True, eq=False)
class Results:
    """What a study left behind. Nothing here is computed, all of it is read.

    published : the paper's tables and claims as parsed TOML, empty without
    provenance : versions, machine, and for every optimizer label its plugin, settings, summary and
        evaluations_per_iteration (an integer or null)
    trials : one row a trial with the columns of trials.csv, ordered by problem, optimizer, instance, trial
    traces : (problem, optimizer, instance, trial) -> best-so-far trace, of trials that have a result; where they are
        kept in courses.csv.xz, losses with seven digits, and the points of a few trials only
    responses : problem, optimizer, record, role (fitted or held-out), time, input, output, simulated; of the first
        instance, for the best trial of every optimizer on every problem, and for what was staged (problem: its name)
    identifiability : a problem's names, units, values, standard_errors, rank, sentences and profiles at the best
        of all trials of the first instance, or its "fault"
    stages : one row a quantity of a stage with the columns of stages.csv, empty without stages
    staged : one row a trial that a stage follows, of every instance, see staged_trials; empty without
    origins : what every trial was made with: package versions, the processor; where the store is kept
    damages : sentences on what could not be read
    closing : the diagnosis at the end; None where the study asks for none, or none was tried
    """

    folder: Path
    study: Study
    published: Mapping[str, Any]
    provenance: Mapping[str, Any]
    trials: pd.DataFrame
    traces: Mapping[Trial, Trace]
    responses: pd.DataFrame
    identifiability: Mapping[str, Any]
    stages: pd.DataFrame
    closing: Closing | None = None
    damages: tuple[str, ...] = ()
    origins: Mapping[Trial, Mapping[str, str]] = field(default_factory=dict)
    staged: pd.DataFrame = field(default_factory=pd.DataFrame)

    @property
    def kept_small(self) -> bool:
        """Whether this is what is left of a study without trials.sqlite: its tables, as they are kept in git."""
        return not (self.folder / FILE).is_file()

    @property
    def mixed(self) -> tuple[str, ...]:
        """A sentence for each thing in which trials differ that should not: package versions, processors."""
        return mixed(self.origins)

    def _repr_html_(self) -> str:
        """For a notebook: by problem and optimizer, the trials, how many have a result, and the median error."""
        rows = self.trials.assign(finished=self.trials["status"].isin(FINISHED))
        table = rows.groupby(["problem", "optimizer"], sort=False).agg(
            trials=("trial", "size"), finished=("finished", "sum"), median_relative_rms=("relative_rms", "median")
        )
        return f"<p>{escape(self.study.title)}</p>{table.to_html(float_format='%.4g')}"


def read_results(folder: Path) -> Results:
    """What can be read of a results folder; what cannot is named in `damages`.

    Where trials.sqlite is not kept, the trials come from trials.csv, and their traces from courses.csv.xz, or from
    nowhere.
    Raises UserError where the folder holds no study.
    """
    if not (folder / STUDY).is_file():
        raise UserError(str(folder), f"holds no results: there is no {STUDY} in it.")
    study, _ = read_study(folder / STUDY)
    reader = Reader(folder)
    trials, traces, origins = _trials(reader)
    closing = read_closing(reader) if study.closing else None
    staged = reader.csv(STAGED_TRIALS, STAGED_COLUMNS)
    return Results(
        folder,
        study,
        reader.toml(PUBLISHED),
        reader.json(PROVENANCE, check_provenance),
        trials,
        traces,
        reader.csv(RESPONSES, RESPONSE_COLUMNS),
        reader.json(IDENTIFIABILITY),
        reader.csv(STAGES, STAGE_COLUMNS),
        closing,
        tuple(reader.damages),
        origins,
        staged,
    )


def _trials(
    reader: Reader,
) -> tuple[pd.DataFrame, Mapping[Trial, Trace], Mapping[Trial, Mapping[str, str]]]:
    """The trials, their traces, and with which versions and processor they were made."""
    if (reader.folder / FILE).is_file():
        try:
            with Store.reading(reader.folder) as store:
                trials, traces, origins = store.table(), store.traces(), store.origins()
            if not trials.empty:
                return trials, traces, origins
        except DAMAGED as error:
            reader.said(FILE, error)
    columns = [name for name in COLUMNS if name != "instance"]
    trials = reader.csv(TRIALS, columns, lambda table: check_rows(with_instances(table)))
    if trials.empty:
        return pd.DataFrame(columns=list(COLUMNS)), {}, {}
    trials = with_instances(trials)
    return trials.assign(reason=trials["reason"].astype(object).fillna("").astype(str)), _courses(reader), {}


def _courses(reader: Reader) -> Mapping[Trial, Trace]:
    """As they are kept beside trials.csv; none where they are not."""
    if (reader.folder / COURSES).is_file():
        try:
            return read_courses(reader.folder / COURSES)
        except DAMAGED as error:
            reader.said(COURSES, error)
    reader.damages.append(
        f"The course of the searches is not kept here ({FILE}): trials are told from {TRIALS}, without convergence."
    )
    return {}
