"""What follows a static problem: its linear section by least squares, and the whole model on further records."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.control.bench import FEED_FORWARD, PRINTED, bench_of
from hysteresis_bench.control.comparison import AMPLITUDE, RATE, compare, course, stepped_rig
from hysteresis_bench.control.references import static_reference
from hysteresis_bench.fit.accuracy import accuracy, response_table, simulated
from hysteresis_bench.fit.model_file import Estimate, FittedModel
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record
from hysteresis_bench.study.afterwards.best_fits import best_of
from hysteresis_bench.study.afterwards.linear_section import fitted
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.problems import Built, build_problem, build_system
from hysteresis_bench.study.results import FINISHED, RESPONSE_COLUMNS
from hysteresis_bench.study.study_file import StageSpec, Study

COLUMNS = ("stage", "optimizer", "way", "quantity", "name", "controller", "value", "standard_error", "unit", "fault")
STAGED, HELD, FITTED, LARGEST, RMSE = "staged", "held", "fitted", "largest error", "rmse"
TRACKING = {"t_error": "largest tracking error", "t_rmse": "tracking rmse"}
BEST, CONTROL = "best of all", "control: "


@dataclass(frozen=True, eq=False)
class Whole:
    """A whole model that came about in one of two ways: staged, or all at once (the problem's name).

    rows : what stages.csv says of its parameters;  fault : why it cannot be used, or an empty string
    """

    optimizer: str
    way: str
    system: System
    values: Array
    rows: tuple[dict[str, Any], ...]
    fault: str = ""


def run_stages(
    study: Study, trials: pd.DataFrame, built: Mapping[str, Built], *, folder: Path
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Every stage of the study: one row a quantity (COLUMNS), and the staged models' responses; of a closed loop the
    reference is the output, what is reached the simulated one, and the role CONTROL with the controller behind it.

    folder : where relative data files are looked for. An absent number is None: the errors of a section that
    is unstable, a standard error that the data cannot tell. Errors are in units of the output.
    """
    rows: list[dict[str, Any]] = []
    parts: list[pd.DataFrame] = []
    for stage in study.stage:
        data = stage_data(stage, study, folder)
        for whole in _wholes(stage, trials, built, data):
            about = {"stage": stage.name, "optimizer": whole.optimizer, "way": whole.way, "fault": whole.fault}
            rows += [about | row for row in whole.rows]
            if whole.fault:
                rows += [about | row for record in data.dataset.records for row in _errors(record, None)]
                continue
            rows += [about | row for row in errors_on(whole, data)]
            if whole.way == STAGED:
                found = simulated(whole.system, data.dataset.records, whole.values)
                table = response_table(data.dataset, {"simulated": found})
                checked = table[table["record"].isin(stage.check)]
                named = checked.assign(problem=stage.name, optimizer=whole.optimizer, role="check")
                parts.append(named[list(RESPONSE_COLUMNS)])
            if whole.optimizer in stage.control and whole.way == STAGED:
                tracked, courses = _tracked(stage, study, whole, data)
                rows += [about | row for row in tracked]
                parts.append(courses)
    return pd.DataFrame(rows, columns=list(COLUMNS)), pd.concat(parts) if parts else pd.DataFrame()


def stage_data(stage: StageSpec, study: Study, folder: Path, instance: int = FIRST) -> Built:
    """The records of the stage, of one instance, and the whole model on those that it fits."""
    after = next(spec for spec in study.problem if spec.name == stage.after)
    changed: dict[str, Any] = {"name": stage.name, "model": stage.model, "settings": stage.settings}
    changed |= {"effects": [], "fixed": {}, "bounds": {}, "scaling": None, "profile": [], "box": "model"}
    changed |= {"fitted": stage.fitted, "held_out": stage.check}
    return build_problem(after.model_copy(update=changed), study.seed, folder, instance)


def _wholes(stage: StageSpec, trials: pd.DataFrame, built: Mapping[str, Built], data: Built) -> Iterator[Whole]:
    for label, found in _best(trials, stage.after, built, stage.optimizers):
        yield section_behind(stage, label, found, built[stage.after].problem.system, data)
    if stage.beside is None:
        return
    of = built[stage.beside].problem
    for label, found in _best(trials, stage.beside, built, stage.optimizers):
        values = np.array([found[name] for name in of.space.names])
        known = [(HELD, name, value) for name, value in of.system.fixed.items()]
        known += [(FITTED, name, value) for name, value in found.items()]
        units = _units(data)
        rows = tuple(_row(quantity, name, value, units.get(name, "1")) for quantity, name, value in known)
        yield Whole(label, stage.beside, of.system, values, rows)


def _best(
    trials: pd.DataFrame, problem: str, built: Mapping[str, Built], labels: list[str]
) -> Iterator[tuple[str, dict[str, float]]]:
    """(label, parameters) of the best trial of each of the optimizers, then of all."""
    finished = trials[(trials["problem"] == problem) & trials["status"].isin(FINISHED)]
    names = built[problem].problem.space.names
    for label in [*labels, BEST]:
        rows = finished if label == BEST else finished[finished["optimizer"] == label]
        if not rows.empty:
            winner, values = best_of(rows, names)
            yield f"{BEST} ({winner})" if label == BEST else label, dict(zip(names, map(float, values), strict=True))


def section_behind(stage: StageSpec, label: str, found: Mapping[str, float], static: System, data: Built) -> Whole:
    """Hold what the static trial found, fit the linear section behind it."""
    every = {**static.fixed, **found}
    held = {name: every[name] for name in data.problem.space.names if name not in stage.fit}
    system = build_system(stage.model, stage.settings, fixed=held)
    column = np.array(list(found.values()))[:, None]
    inputs = [static.simulate(record.signal, column)[:, 0] for record in data.dataset.fitted]
    section = fitted(replace(data.problem, system=system, space=Space(system.parameters)), inputs)
    units = _units(data)
    rows = [_row(HELD, name, value, units[name]) for name, value in held.items()]
    for name, value, error in zip(stage.fit, section.values, section.standard_errors, strict=True):
        rows.append(_row(FITTED, name, value, units[name], error))
    return Whole(label, STAGED, system, section.values, tuple(rows), section.fault)


def _tracked(stage: StageSpec, study: Study, whole: Whole, data: Built) -> tuple[list[dict[str, Any]], pd.DataFrame]:
    """Every controller along every reference, on the rig, and the courses of the stage's, or of the paper's, and of the
    feed-forward alone along a slow sine; a row with the fault where the model allows none."""
    after = next(spec for spec in study.problem if spec.name == stage.after)
    assert after.rig is not None
    try:
        rig = stepped_rig(after.rig, after.rig_settings)
        model = model_of(stage, whole, data)
        found = compare(model, rig, after.rig, seed=study.seed)
        static = static_reference(AMPLITUDE, RATE)
        alone = bench_of(model, rig, after.rig, rate=RATE, amplitude=AMPLITUDE).run(FEED_FORWARD, static, study.seed)
    except ValueError as fault:
        row = _row(TRACKING["t_rmse"], "every reference", None, data.dataset.units["output"])
        return [row | {"fault": str(fault)}], pd.DataFrame()
    rows = [
        _row(quantity, score["reference"], score[key], score["unit"]) | {"controller": score["controller"]}
        for score in found.scores.to_dict("records")
        for key, quantity in TRACKING.items()
    ]
    closed = found.responses[found.responses["controller"].isin(stage.controllers or [PRINTED])]
    courses = pd.concat([closed, course(alone).assign(reference=static.name, controller=FEED_FORWARD)])
    names = {"reference": "record", "voltage": "input", "wanted": "output", "displacement": "simulated"}
    named = courses.rename(columns=names).assign(problem=stage.name, optimizer=whole.optimizer)
    return rows, named.assign(role=CONTROL + named["controller"])[list(RESPONSE_COLUMNS)]


def model_of(stage: StageSpec, whole: Whole, data: Built) -> FittedModel:
    """As a controller takes it."""
    found = {row["name"]: row for row in whole.rows}
    estimates = {name: Estimate(row["value"], row["standard_error"], row["unit"]) for name, row in found.items()}
    error = {"fitted": accuracy(whole.system, data.dataset.fitted, whole.values).as_dict()}
    return FittedModel(stage.model, stage.settings, (), {}, data.dataset.units, estimates, error=error)


def errors_on(whole: Whole, data: Built) -> list[dict[str, Any]]:
    """The errors on every record of the stage."""
    found = simulated(whole.system, data.dataset.records, whole.values)
    pairs = zip(data.dataset.records, found, strict=True)
    return [row for record, response in pairs for row in _errors(record, response)]


def _errors(record: Record, response: Array | None) -> list[dict[str, Any]]:
    """response : (scored samples,), None where there is none"""
    unit = record.units.get("output", "1")
    if response is None:
        return [_row(quantity, record.name, None, unit) for quantity in (LARGEST, RMSE)]
    error = response - record.measured
    return [
        _row(LARGEST, record.name, float(np.max(np.abs(error))), unit),  # PEA paper (12)
        _row(RMSE, record.name, float(np.sqrt(np.mean(error**2))), unit),  # PEA paper (13)
    ]


def _row(quantity: str, name: str, value: float | None, unit: str, error: float = np.inf) -> dict[str, Any]:
    numbers = {"value": value, "standard_error": error}
    known = {
        key: None if number is None or not np.isfinite(number) else float(number) for key, number in numbers.items()
    }
    return {"quantity": quantity, "name": name, **known, "unit": unit}


def _units(data: Built) -> dict[str, str]:
    return {parameter.name: parameter.unit_in(data.dataset.units) for parameter in data.problem.space.parameters}
