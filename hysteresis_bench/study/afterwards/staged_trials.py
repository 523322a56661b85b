"""What follows a static problem, on every trial of every instance: the tables of a stage with a spread.

Each static trial gets its own linear section, its own check on the other signals and its own closed loops, on the
actuator it was fitted to: one row a trial. What was computed for the same trial before is kept.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.control.bench import SLIDING, bench_of
from hysteresis_bench.control.comparison import AMPLITUDE, RATE, stepped_rig
from hysteresis_bench.control.references import published_references
from hysteresis_bench.study.afterwards.stages import (
    FITTED,
    LARGEST,
    RMSE,
    Whole,
    errors_on,
    model_of,
    section_behind,
    stage_data,
)
from hysteresis_bench.study.instances import drawn_constants
from hysteresis_bench.study.kept_files.trial_rows import FINISHED, FIRST
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.results import STAGED_COLUMNS
from hysteresis_bench.study.study_file import StageSpec, Study

KEY = STAGED_COLUMNS[:-1]
CHECK = {LARGEST: "check_error", RMSE: "check_rmse"}
"""Means over the check's records; with a record's name behind it, of that record."""
TRACKING = {"t_error": "tracking_error", "t_rmse": "tracking_rmse"}
"""With a controller behind it the mean over the references, with a reference behind that, of this one."""
TUNED = {"convergence": "tuned.C", "epsilon": "tuned.epsilon", "rho": "tuned.rho"}
"""The constants of (15), as the PEA paper's Table 5 calls them; tuned on what the trial found."""


def run_staged_trials(
    study: Study, trials: pd.DataFrame, built: Mapping[str, Built], *, folder: Path, kept: pd.DataFrame
) -> pd.DataFrame:
    """One row a stage, optimizer, instance and trial: STAGED_COLUMNS, then the section by the model's names, CHECK,
    TUNED and TRACKING; an absent number is NaN.

    folder : where relative data files are looked for
    kept : such a table of an earlier run; `made_of` says whether a row of it is of the same stage and parameters
    """
    known = {tuple(row[name] for name in KEY): row for row in kept.to_dict("records")}
    rows = []
    for stage in study.stage:
        static = built[stage.after].problem
        after = trials[(trials["problem"] == stage.after) & trials["status"].isin(FINISHED)]
        chosen = after[after["optimizer"].isin(stage.optimizers)]
        for instance, here in chosen.groupby("instance"):
            data = None
            for _, trial in here.sort_values(["optimizer", "trial"]).iterrows():
                found = {name: float(trial[f"parameter.{name}"]) for name in static.space.names}
                made_of = _made_of(study, stage, found)
                key = stage.name, trial["optimizer"], int(instance), int(trial["trial"]), made_of
                if key in known:
                    rows.append(known[key])
                    continue
                data = data or stage_data(stage, study, folder, int(instance))
                whole = section_behind(stage, trial["optimizer"], found, static.system, data)
                about = dict(zip(KEY, key, strict=True)) | {"fault": whole.fault}
                rows.append(about | _numbers(stage, study, whole, data, instance=int(instance)))
    return pd.DataFrame(rows) if rows else pd.DataFrame(columns=list(STAGED_COLUMNS))


def _made_of(study: Study, stage: StageSpec, found: Mapping[str, float]) -> str:
    """Of the stage and of what the trial found."""
    after = next(spec for spec in study.problem if spec.name == stage.after)
    words = f"{study.seed}|{after.rig}|{after.rig_settings}|{after.ranges}|{stage.model_dump_json()}|{found}"
    return f"h{hashlib.sha256(words.encode()).hexdigest()[:8]}"  # a letter ahead: no table takes it for a number


def _numbers(stage: StageSpec, study: Study, whole: Whole, data: Built, *, instance: int) -> dict[str, Any]:
    numbers = {row["name"]: row["value"] for row in whole.rows if row["quantity"] == FITTED}
    if whole.fault:
        return numbers
    checked = [row for row in errors_on(whole, data) if row["name"] in stage.check]
    for quantity, name in CHECK.items():
        of_records = {row["name"]: row["value"] for row in checked if row["quantity"] == quantity}
        if of_records:
            numbers[name] = float(np.mean(list(of_records.values())))
        numbers |= {f"{name}.{record}": value for record, value in of_records.items()}
    if whole.optimizer not in stage.control or not stage.controllers:
        return numbers
    try:
        return numbers | _tracked(stage, study, whole, data, instance=instance)
    except ValueError as fault:
        return numbers | {"fault": str(fault)}


def _tracked(stage: StageSpec, study: Study, whole: Whole, data: Built, *, instance: int) -> dict[str, float]:
    """Closed loops on the actuator that was fitted; its sensor's noise is another one than in the records."""
    after = next(spec for spec in study.problem if spec.name == stage.after)
    assert after.rig is not None
    rig = stepped_rig(after.rig, {**after.rig_settings, **drawn_constants(after, study.seed, instance)})
    bench = bench_of(model_of(stage, whole, data), rig, after.rig, rate=RATE, amplitude=AMPLITUDE)
    references = published_references(AMPLITUDE, RATE)
    found: dict[str, float] = {
        name: value for key, value in bench.tuning.get(SLIDING, {}).items() if (name := TUNED.get(key))
    }
    for controller in stage.controllers:
        scores = {each.name: bench.run(controller, each, study.seed + instance - FIRST).scores() for each in references}
        for score, name in TRACKING.items():
            found[f"{name}.{controller}"] = float(np.mean([run[score] for run in scores.values()]))
            found |= {f"{name}.{controller}.{reference}": run[score] for reference, run in scores.items()}
    return found
