"""Fit a model to a user's own records: box from the data, two searches, polish, standard errors, warnings."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from importlib.metadata import version
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Optimizer
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.identifiability import Identifiability, analyse
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.model_file import Estimate, FittedModel, Preparation
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.search import generator, polish, search, shared_start
from hysteresis_bench.fit.settling import CLOSED, FIRST_REPEATS, MOST_REPEATS, gap_after, not_closed, open_loops
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Dataset, Record

DEFAULT_BUDGET = 15050
AGREE = 0.01
"""Two searches agree when neither's RMSE is more than 1 % above the other's, and their simulated outputs
differ by less than 1 % of the measured range (RMS)."""
AT_BOUND = 1e-3
"""A parameter within this fraction of its (scaled) box from an edge is said to lie at its bound."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A fitted model and how good it is.

    model : ready to predict and to be written
    records : one row a record: record, role, rmse, relative_rms, max_error
    responses : record, role, time, input, output, simulated, over the scored samples
    parameters : one row a parameter: name, value, standard_error, unit, at_bound
    agreement : a sentence on whether two searches with other starts agree
    warnings : sentences on what the model cannot follow, or what the data cannot tell
    notes : how the fit was made
    """

    model: FittedModel
    records: pd.DataFrame
    responses: pd.DataFrame
    parameters: pd.DataFrame
    identifiability: Identifiability
    agreement: str
    agrees: bool
    warnings: tuple[str, ...]
    notes: tuple[str, ...]


def fit_records(
    dataset: Dataset,
    model: str,
    effects: Sequence[str] = (),
    *,
    settings: Mapping[str, Any] | None = None,
    optimizer: str = registry.SEARCH,
    optimizer_settings: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    budget: int = DEFAULT_BUDGET,
    seed: int = 0,
    settle: bool = False,
    input_offset: float = 0.0,
    flip: bool = False,
) -> Fit:
    """Fit a registered model, with effects around it, to the fitted records of a data set.

    bounds : replaces parts of the box that the model derives from the data
    settle : closed loops are repeated until they close before they are scored
    input_offset, flip : the model sees (input - input_offset), times -1 with flip
    Raises UserError telling every fault at once.
    """
    preparation = Preparation(input_offset, flip)
    seen = dataset.map(preparation)
    system = _system(model, settings or {}, effects, fixed or {}, optimizer, optimizer_settings or {})
    _check(system, seen, settle)
    space = _space(system, seen.fitted, bounds or {})
    built = registry.build("optimizers", optimizer, optimizer_settings)
    repeats = FIRST_REPEATS
    while True:
        ready = seen.map(lambda record, n=repeats: record.settled(n)) if settle else seen
        problem = Problem(system, ready.fitted, space, LOSSES["rmse"])
        found = [polish(problem, _search(problem, built, budget, seed, run)) for run in (0, 1)]
        losses = [float(problem.losses(space.to_unit(values[:, None]))[0]) for values in found]
        values = found[int(np.argmin(losses))]
        gap = gap_after(system, ready.records, values, repeats) if settle else 0.0
        if gap < CLOSED or repeats >= MOST_REPEATS:
            break
        repeats *= 2
    try:
        analysis = analyse(problem, values)
    except ValueError as error:
        raise UserError("fit", f"{error}.") from None
    model_settings = {"settings": settings or {}, "preparation": preparation}
    fitted = fitted_model(problem, values, analysis.standard_errors, dataset, ready, model, **model_settings)
    parameters = _parameter_table(problem, fitted)
    records, responses = _record_tables(system, values, dataset, ready)
    agrees, agreement = _agreement(problem, found, losses)
    warnings = (
        *system.model.advice(seen.fitted),
        *not_closed(gap, repeats),
        *_edges(parameters),
        *analysis.sentences(),
    )
    notes = _notes(space, optimizer, budget, seed, repeats if settle else 0)
    return Fit(fitted, records, responses, parameters, analysis, agreement, agrees, warnings, notes)


def _system(
    model: str,
    settings: Mapping[str, Any],
    effects: Sequence[str],
    fixed: Mapping[str, float],
    optimizer: str,
    optimizer_settings: Mapping[str, Any],
) -> System:
    faults = registry.faults("models", model, settings) + registry.faults("optimizers", optimizer, optimizer_settings)
    for effect in effects:
        faults += registry.effect_faults(effect, model)
    if faults:
        raise UserError("fit", faults)
    built = registry.build("models", model, settings)
    system = System(built, registry.build_effects(built, effects))
    names = [parameter.name for parameter in system.parameters]
    unknown = [f'fixed: no parameter "{name}". {nearest(name, names)}' for name in fixed if name not in names]
    known = replace(system, fixed=fixed)
    if unknown or known.refusals():
        raise UserError("fit", unknown + [f"fixed {reason}" for reason in known.refusals()])
    return known


def _check(system: System, dataset: Dataset, settle: bool) -> None:
    faults = []
    for name, effect in system.effects:
        if reason := effect.inapplicable(dataset.fitted):
            faults.append(f"effect {name}: {reason}")
    for record in dataset.fitted:
        if np.ptp(record.measured) == 0:
            faults.append(f"record {record.name}: the output is constant; there is nothing to identify.")
    faults += open_loops(dataset.records) if settle else []
    samples = sum(record.measured.size for record in dataset.fitted)
    if samples <= len(system.parameters):
        faults.append(f"{samples} samples cannot determine {len(system.parameters)} parameters.")
    if faults:
        raise UserError("fit", faults)


def _space(system: System, records: Sequence[Record], bounds: Mapping[str, tuple[float, float]]) -> Space:
    boxes = system.box(records)
    names = [parameter.name for parameter in boxes]
    faults = [f'bounds: no parameter "{name}". {nearest(name, names)}' for name in bounds if name not in names]
    parameters: list[Parameter] = []
    for parameter in boxes:
        lower, upper = bounds.get(parameter.name, (parameter.lower, parameter.upper))
        scaling = "linear" if lower <= 0 else parameter.scaling
        parameters.append(parameter.within(lower, upper, scaling))
        faults += [f"bounds {fault}" for fault in parameters[-1].faults()]
    if faults:
        raise UserError("fit", faults)
    return Space(tuple(parameters))


def _search(problem: Problem, optimizer: Optimizer, budget: int, seed: int, run: int) -> Array:
    start = shared_start(problem.space.dimension, seed, "fit", run)
    return search(problem, optimizer, budget, start, generator(seed, "fit", run)).values


def _agreement(problem: Problem, found: Sequence[Array], losses: Sequence[float]) -> tuple[bool, str]:
    points = [problem.space.to_unit(values[:, None])[:, 0] for values in found]
    difference = problem.residuals(points[0]) - problem.residuals(points[1])
    spread = max(float(np.ptp(record.measured)) for record in problem.records) or 1.0
    apart = float(np.sqrt(np.mean(difference**2))) / spread
    ratio = max(losses) / (min(losses) or 1e-300)
    if ratio > 1 + AGREE and max(losses) > 1e-9 * problem.scale:
        return False, (
            f"Two searches from other starts do NOT agree: their RMSE differ by {100 * (ratio - 1):.3g} %. "
            f"The better one is shown; a larger budget or narrower bounds may find a better one still."
        )
    if apart > AGREE:
        return False, (
            f"Two searches from other starts fit equally well but do NOT agree: their outputs differ by "
            f"{100 * apart:.2g} % of the range (RMS)."
        )
    close = f"their outputs differ by {100 * apart:.2g} % of the range (RMS)" if apart > 1e-6 else "they found the same"
    return True, f"Two searches from other starts agree: {close}."


def _edges(parameters: pd.DataFrame) -> list[str]:
    return [
        f"{row.name} lies at the edge of its box ({row.value:.4g}): the optimum may lie outside, and its standard "
        f"error means little."
        for row in parameters[parameters["at_bound"]].itertuples(index=False)
    ]


def _notes(space: Space, optimizer: str, budget: int, seed: int, repeats: int) -> tuple[str, ...]:
    box = "; ".join(f"{p.name} {p.lower:.3g} to {p.upper:.3g} ({p.scaling})" for p in space.parameters)
    settled = f" Every loop was passed {repeats} times before it was scored." if repeats else ""
    return (
        f"Two searches by {optimizer} from other starts, {budget} evaluations each, seed {seed}, each finished by a "
        f"local least-squares polish.{settled}",
        f"Search box: {box}.",
        "Standard errors come from the Jacobian at the optimum and grow with the residuals' autocorrelation.",
    )


def _record_tables(
    system: System, values: Array, dataset: Dataset, ready: Dataset
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Errors and responses a record. dataset : as measured; ready : the same records as the model sees them."""
    records, responses = [], []
    for record, seen in zip(dataset.records, ready.records, strict=True):
        named = {"record": record.name, "role": "held-out" if record.name in dataset.held_out_names else "fitted"}
        records.append({**named, **accuracy(system, [seen], values).as_dict()})
        columns = {
            "time": record.time[record.scored],
            "input": record.input[record.scored],
            "output": record.measured,
            "simulated": system.respond(seen, values[:, None])[seen.scored, 0],
        }
        responses.append(pd.DataFrame({**named, **columns}))
    return pd.DataFrame(records), pd.concat(responses, ignore_index=True)


def _parameter_table(problem: Problem, fitted: FittedModel) -> pd.DataFrame:
    points = problem.space.to_unit(fitted.values[:, None])[:, 0]
    rows = [
        {"name": name, **asdict(estimate), "at_bound": bool(point < AT_BOUND or point > 1 - AT_BOUND)}
        for (name, estimate), point in zip(fitted.parameters.items(), points, strict=True)
    ]
    return pd.DataFrame(rows)


def fitted_model(
    problem: Problem, values: Array, errors: Array, dataset: Dataset, ready: Dataset, model: str, **more: Any
) -> FittedModel:
    """The model of a problem at `values` (dimension,), ready to predict and to be written.

    errors : (dimension,) standard errors, inf where the data cannot tell
    dataset : as measured;  ready : the same records as the model sees them
    """
    system, units = problem.system, dataset.units
    offsets = np.array([[float(o[0]) for o in system.offsets(r, values[:, None])] for r in ready.fitted])
    remembered = {
        name: effect.remembered(list(offsets[:, index])) for index, (name, effect) in enumerate(system.effects)
    }
    error = {"fitted": accuracy(system, ready.fitted, values).as_dict()}
    if ready.held_out:
        error["held_out"] = accuracy(system, ready.held_out, values).as_dict()
    return FittedModel(
        model,
        effects=tuple(remembered),
        effect_settings={name: asdict(effect) for name, effect in remembered.items()},  # type: ignore[call-overload]
        units=units,
        parameters={
            parameter.name: Estimate(
                float(value), float(error) if np.isfinite(error) else None, parameter.unit_in(units)
            )
            for parameter, value, error in zip(problem.space.parameters, values, errors, strict=True)
        },
        fixed=system.fixed,
        data={"fitted": [r.name for r in dataset.fitted], "held_out": [r.name for r in dataset.held_out]},
        error=error,
        created_by={"hysteresis-bench": version("hysteresis-bench"), "python": platform.python_version()},
        **more,
    )
