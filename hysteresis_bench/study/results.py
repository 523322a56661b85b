"""A results folder as it is read: the study, its trials with their traces, the best fits' responses."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.afterwards.closing_files import Closing, read_closing
from hysteresis_bench.study.origin import mixed
from hysteresis_bench.study.store import Store
from hysteresis_bench.study.study_file import Study, check_study

STUDY, PUBLISHED, PROVENANCE = "study.toml", "published.toml", "provenance.json"
TRIALS, SUMMARY, RESPONSES, REPORT = "trials.csv", "summary.csv", "responses.csv", "report.html"
IDENTIFIABILITY, STAGES = "identifiability.json", "stages.csv"

STATUSES = (
    "done",
    "finished-early",
    "no-finite-loss",
    "raised",
    "timed-out",
    "crashed",
    "out-of-memory",
    "killed",
    "not-started",
)
FINISHED = ("done", "finished-early")
"""Statuses of a trial that has a result."""


@dataclass(frozen=True, eq=False)
class Results:
    """What a study left behind. Nothing here is computed, all of it is read.

    published : the paper's tables and claims as parsed TOML, empty without
    provenance : versions, machine, and for every optimizer label its plugin, settings, summary and
        evaluations_per_iteration (an integer or null)
    trials : one row a trial with the columns of trials.csv, ordered by problem, optimizer, trial
    traces : (problem, optimizer, trial) -> best-so-far trace, of trials that have a result
    responses : problem, optimizer, record, role (fitted or held-out), time, input, output, simulated;
        for the best trial of every optimizer on every problem, and for what was staged (problem: the stage's name)
    identifiability : a problem's names, units, values, standard_errors, rank, sentences and profiles at the best
        of all trials, or its "fault"
    stages : one row a quantity of a stage with the columns of stages.csv, empty without stages
    mixed : a sentence for each thing in which trials differ that should not: package versions, processors
    closing : the diagnosis at the end; None where the study asks for none, or none was tried
    """

    folder: Path
    study: Study
    published: Mapping[str, Any]
    provenance: Mapping[str, Any]
    trials: pd.DataFrame
    traces: Mapping[tuple[str, str, int], Trace]
    responses: pd.DataFrame
    identifiability: Mapping[str, Any]
    stages: pd.DataFrame
    closing: Closing | None = None
    mixed: tuple[str, ...] = ()

    def _repr_html_(self) -> str:
        """For a notebook: by problem and optimizer, the trials, how many have a result, and the median error."""
        rows = self.trials.assign(finished=self.trials["status"].isin(FINISHED))
        table = rows.groupby(["problem", "optimizer"], sort=False).agg(
            trials=("trial", "size"), finished=("finished", "sum"), median_relative_rms=("relative_rms", "median")
        )
        return f"<p>{escape(self.study.title)}</p>{table.to_html(float_format='%.4g')}"


def read_results(folder: Path) -> Results:
    """Raises UserError where the folder holds no study."""
    if not (folder / STUDY).is_file():
        raise UserError(str(folder), f"holds no results: there is no {STUDY} in it.")
    study = check_study(tomllib.loads((folder / STUDY).read_text(encoding="utf-8")), str(folder / STUDY))
    published = folder / PUBLISHED
    with Store(folder) as store:
        trials, traces, origins = store.table(), store.traces(), store.origins()
    return Results(
        folder,
        study,
        tomllib.loads(published.read_text(encoding="utf-8")) if published.is_file() else {},
        _json(folder / PROVENANCE),
        trials,
        traces,
        _csv(folder / RESPONSES),
        _json(folder / IDENTIFIABILITY),
        _csv(folder / STAGES),
        read_closing(folder) if study.closing else None,
        mixed(origins),
    )


def _csv(path: Path) -> pd.DataFrame:
    return pd.read_csv(path) if path.is_file() else pd.DataFrame()


def _json(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
