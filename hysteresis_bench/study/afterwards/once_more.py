"""What follows from the table of trials: the best fits' responses, or one of its trials run once more."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.accuracy import response_table, simulated
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.study.afterwards.best_fits import responses
from hysteresis_bench.study.afterwards.stages import run_stages
from hysteresis_bench.study.execution.trial import Ticket, prepare_trial
from hysteresis_bench.study.kept_files.trial_rows import FINISHED, FIRST
from hysteresis_bench.study.problems import Built, build_problem
from hysteresis_bench.study.results import RESPONSES, Results
from hysteresis_bench.study.store import Outcome
from hysteresis_bench.study.study_file import Study

DIGITS = 7
"""Significant ones with which the responses are written."""


def write_responses(
    folder: Path, study: Study, trials: pd.DataFrame, built: Mapping[str, Built], *, data: Path
) -> pd.DataFrame:
    """Write responses.csv into the folder; returns the rows of stages.csv.

    trials : of the first instance;  data : the folder where relative data files are looked for
    """
    rows, staged = run_stages(study, trials, built, folder=data)
    write_table(folder / RESPONSES, pd.concat([responses(trials, built), staged]), digits=DIGITS)
    return rows


@economical()
def responses_once_more(results: Results) -> bool:
    """Write responses.csv where it is not kept; False where a problem cannot be built from the folder alone, as its
    data lie elsewhere."""
    study = results.study
    try:
        built = {spec.name: build_problem(spec, study.seed, results.folder) for spec in study.problem}
    except (UserError, ValueError):
        return False
    first = results.trials[results.trials["instance"] == FIRST]
    write_responses(results.folder, study, first, built, data=results.folder)
    return True


@dataclass(frozen=True, eq=False)
class OnceMore:
    """A trial that was run again.

    kept : its row of trials.csv;  outcome : what it came to now
    responses : record, role, time, input, output, simulated, with the parameters of trials.csv
    """

    kept: pd.Series
    outcome: Outcome
    built: Built
    responses: pd.DataFrame

    @property
    def same(self) -> bool:
        """Whether it came to the same fitness, to the last bit, after as many evaluations."""
        found = self.outcome.fitness, self.outcome.evaluations
        return found == (float(self.kept["fitness"]), int(self.kept["evaluations"]))


@economical()
def trial_once_more(results: Results, seed: str) -> OnceMore:
    """Run a trial of a results folder again. seed : its seed in trials.csv, or how it begins

    Raises UserError where none or several begin so, the trial has no result, or its data are not there.
    """
    kept = _row(results, seed)
    study = results.study
    spec = next(spec for spec in study.problem if spec.name == kept["problem"])
    built = build_problem(spec, study.seed, results.folder, int(kept["instance"]))
    key = kept["problem"], kept["optimizer"], int(kept["trial"])
    ticket = Ticket(study.model_dump_json(), str(results.folder.resolve()), *key, instance=int(kept["instance"]))
    outcome = prepare_trial(ticket)()
    values = kept[[f"parameter.{name}" for name in built.problem.space.names]].to_numpy(dtype=float)
    system, dataset = built.problem.system, built.dataset
    table = response_table(dataset, {"simulated": simulated(system, dataset.records, values)})
    return OnceMore(kept, outcome, built, table)


def _row(results: Results, seed: str) -> pd.Series:
    """The trial with this seed."""
    rows = results.trials[results.trials["seed"].astype(str).str.startswith(seed)] if seed else results.trials
    if len(rows) != 1:
        many = f"{len(rows)} trials have a seed that begins so" if len(rows) else "no trial has such a seed"
        raise UserError(
            str(results.folder), f'--trial "{seed}": {many}. The column seed of trials.csv has all of them.'
        )
    row = rows.iloc[0]
    if row["status"] not in FINISHED:
        raise UserError(str(results.folder), f"trial {seed} has no result ({row['status']}): {row['reason']}")
    return row
