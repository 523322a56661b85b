"""Fit a model to a user's own records: box from the data, two searches, polish, standard errors, warnings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from html import escape
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Optimizer
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.fit.accuracy import error_table, response_table, simulated
from hysteresis_bench.fit.checks.advised import advice_with
from hysteresis_bench.fit.checks.agreement import agreement_of
from hysteresis_bench.fit.checks.asked import asked_faults
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.fit.checks.edges import at_edges, edges_reached
from hysteresis_bench.fit.checks.faulty_records import still, without_faults
from hysteresis_bench.fit.checks.settled_periods import SAID, settled_periods, unsettled
from hysteresis_bench.fit.checks.wanted_units import in_wanted_units
from hysteresis_bench.fit.identifiability.analysis import Identifiability, analyse_others
from hysteresis_bench.fit.least_squares import not_overlooked, polish
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.model_file import FittedModel, fitted_model
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.fit.settling import CLOSED, FIRST_REPEATS, MOST_REPEATS, gap_after, not_closed, open_loops, passed
from hysteresis_bench.fit.smooth.rough import solvable
from hysteresis_bench.fit.smooth.smoothing import SOLVED, Smoothing
from hysteresis_bench.fit.unseen.interval import interval
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.progress import Kept, OnStep, Step, quiet
from hysteresis_bench.signals import Dataset, Record


@dataclass(frozen=True)
class FitOptions:
    """How a fit is made: two searches from different starts, on records that are prepared. Where effects act, the
    first one begins at the fitted model without them as well.

    optimizer, optimizer_settings : a registered optimizer;  budget : evaluations of each search
    seed : of both searches
    input_offset, flip : the model sees (input - input_offset), times -1 with flip
    skip : seconds at the start of every record that are simulated and not scored
    settle : closed loops are repeated until they close before they are scored; None: where the fitted records say so
    on_step : called with where the fit is
    kept : searches of an earlier run that was stopped, which are not made again; every new one is given to it
    """

    optimizer: str = registry.SEARCH
    optimizer_settings: Mapping[str, Any] = field(default_factory=dict)
    budget: int = 15050
    seed: int = 0
    input_offset: float = 0.0
    flip: bool = False
    skip: float = 0.0
    settle: bool | None = None
    on_step: OnStep = field(default=quiet, compare=False, repr=False)
    kept: Kept | None = field(default=None, compare=False, repr=False)


DEFAULT = FitOptions()


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

    def _repr_html_(self) -> str:
        """For a notebook: the errors, the parameters, the sentences."""
        tables = (table.to_html(index=False, float_format="%.4g") for table in (self.records, self.parameters))
        name = " + ".join((self.model.model, *self.model.effects))
        sentences = (f"<p>{escape(text)}</p>" for text in (self.agreement, *self.warnings))
        return "".join((f"<p>{escape(name)}</p>", *tables, *sentences))


@dataclass(frozen=True, eq=False)
class _Searched:
    """dataset : as the problem sees it;  found : (dimension,) of each search, polished, in units;  losses : of them
    repeats : passes of every loop before it is scored, 0 where it is not;  gap : between the last two of them
    left_out : (scored samples,) errors of what a smooth law was solved without; None of one that was searched"""

    problem: Problem
    dataset: Dataset
    found: tuple[Array, ...]
    losses: tuple[float, ...]
    repeats: int
    gap: float = 0.0
    left_out: Array | None = None

    @property
    def values(self) -> Array:
        """The better one."""
        return self.found[int(np.argmin(self.losses))]


@economical()
def fit_records(
    dataset: Dataset,
    model: str,
    effects: Sequence[str] = (),
    *,
    settings: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    options: FitOptions = DEFAULT,
) -> Fit:
    """Fit a registered model, with effects around it, to the fitted records of a data set.

    effects : by name, innermost first;  settings : of the model
    bounds : by parameter's name, in units, replaces parts of the box that the model derives from the data
    fixed : parameters that are known, by name, in units
    Raises UserError telling what is wrong with the names, the data, the box or the parameters.
    """
    dataset, settings = without_faults(dataset, effects), settings or {}
    system = _system(model, settings, effects, {"fixed": fixed or {}, "bounds": bounds or {}}, options)
    dataset = in_wanted_units(dataset, system.parts, "the model's")
    preparation = Preparation(options.input_offset, options.flip, options.skip)
    if faults := preparation.faults(dataset.records):
        raise UserError("fit", faults)
    seen = dataset.map(preparation)
    _check(system, seen, bool(options.settle))
    told, off = () if options.settle is not None else (SAID,), unsettled(seen.fitted, options.settle)
    options = replace(options, settle=settled_periods(seen.fitted, options.settle))
    space = _space(system, seen.fitted, bounds or {})
    best = _searched(system, space, seen, options)
    problem, values = best.problem, best.values
    options.on_step(Step("what the data determine"))
    weights = system.linear if _smooth(system, options) else ()
    try:
        analysis, errors = analyse_others(problem, values, weights)
    except ValueError as error:
        raise UserError("fit", f"{error}.") from None
    ready, passed_as = best.dataset, replace(preparation, settle=best.repeats)
    fitted = fitted_model(problem, values, errors, dataset=ready, model=model, settings=settings, preparation=passed_as)
    fitted = replace(fitted, interval=interval(problem, values, ready.held_out, fitted.system, best.left_out))
    parameters = _parameter_table(problem, fitted)
    agrees, agreement = (True, SOLVED) if weights else agreement_of(problem, best.found, best.losses)
    responses = simulated(system, ready.records, values)
    return Fit(
        fitted,
        error_table(system, values, ready),
        response_table(dataset.map(preparation.skipped), {"simulated": responses}),  # the measured input
        parameters,
        analysis,
        agreement,
        agrees,
        (
            *advice_with(system.model, effects, seen.fitted),
            *off,
            *not_closed(best.gap, best.repeats),
            *at_edges(parameters[~parameters["name"].isin(weights)]),
            *analysis.sentences(),
        ),
        (*dataset.notes, *_notes(problem, options, best.repeats), *(told if best.repeats else ())),
    )


def _system(
    model: str, settings: Mapping[str, Any], effects: Sequence[str], asked: Mapping[str, Any], options: FitOptions
) -> System:
    """asked : fixed values, and bounds, by parameter's name"""
    faults = asked_faults(model, settings, effects)
    if faults := faults + registry.faults("optimizers", options.optimizer, options.optimizer_settings):
        raise UserError("fit", faults)
    built = registry.build("models", model, settings)
    system = System(built, registry.build_effects(built, effects))
    names = [parameter.name for parameter in system.parameters]
    every = [(what, name) for what, values in asked.items() for name in values]
    faults += [f'{what}: no parameter "{name}". {nearest(name, names)}' for what, name in every if name not in names]
    faults += [f"{name} is fixed and has bounds; give one of both." for name in {*asked["fixed"]} & {*asked["bounds"]}]
    known = replace(system, fixed=asked["fixed"])
    if faults := faults + [f"fixed {reason}" for reason in known.refusals()]:
        raise UserError("fit", faults)
    if not known.parameters:
        raise UserError("fit", "every parameter is fixed; leave one free to be found.")
    return known


def _check(system: System, dataset: Dataset, settle: bool) -> None:
    reasons = {name: effect.inapplicable(dataset.fitted) for name, effect in system.effects}
    faults = [f"effect {name}: {reason}" for name, reason in reasons.items() if reason]
    faults += [words for record in dataset.fitted if (words := still(record, "identify"))]
    faults += open_loops(dataset.records) if settle else []
    samples = sum(record.measured.size for record in dataset.fitted)
    if samples <= len(system.parameters):
        faults.append(f"{samples} samples cannot determine {len(system.parameters)} parameters.")
    if faults := faults or broken_promises(system, dataset.fitted):
        raise UserError("fit", faults)


def _space(system: System, records: Sequence[Record], bounds: Mapping[str, tuple[float, float]]) -> Space:
    boxes = system.box(records)
    faults, parameters = list[str](), list[Parameter]()
    for parameter in boxes:
        lower, upper = bounds.get(parameter.name, (parameter.lower, parameter.upper))
        parameters.append(parameter.bounded(lower, upper))
        faults += [f"bounds {fault}" for fault in parameters[-1].faults()]
    if faults:
        raise UserError("fit", faults)
    return Space(tuple(parameters))


def _best(problem: Problem, *, optimizer: Optimizer, options: FitOptions, run: int, said: str) -> Array:
    """What one search finds, (dimension,) in units."""

    def counted(evaluations: int) -> None:
        options.on_step(Step(said, evaluations, options.budget))

    key = (options.seed, "fit", run)
    start, rng = shared_start(problem.space.dimension, *key), generator(*key)
    return search(problem, optimizer, budget=options.budget, start=start, rng=rng, on_evaluated=counted).values


def _searched(system: System, space: Space, dataset: Dataset, options: FitOptions) -> _Searched:
    """Both searches, each polished, or the smooth law; with `settle` loops are passed until the model closes them."""
    smooth = _smooth(system, options)
    optimizer = registry.build("optimizers", options.optimizer, options.optimizer_settings)
    repeats = FIRST_REPEATS
    while True:
        ready = dataset.map(lambda record, n=repeats: passed(record, n)) if options.settle else dataset
        problem = Problem(system, ready.fitted, space, LOSSES["rmse"])
        solved = Smoothing(problem).searched(judged(problem.records, ready)) if smooth else None
        found = [solved.values] if solved else []
        for run in () if smooth else (0, 1):
            asked = ("search", run, repeats)
            if options.kept is not None and (values := options.kept.get(asked)) is not None:
                found.append(values)
                continue
            said = f"search {run + 1} of 2{f', {repeats} passes of every loop' if options.settle else ''}"
            options.on_step(Step(said, 0, options.budget))
            best = partial(_best, optimizer=optimizer, options=options, run=run, said=said)
            found.append(best(problem) if run else not_overlooked(problem, best(problem), best))
            if options.kept is not None:
                options.kept[asked] = found[-1]
        options.on_step(Step("to the nearest optimum"))
        polished = np.column_stack(found) if smooth else polish(problem, np.column_stack(found))
        losses = problem.losses(space.to_unit(polished))
        left_out = solved.left_out if solved else None
        searched = _Searched(problem, ready, tuple(polished.T), tuple(losses.tolist()), repeats, left_out=left_out)
        if not options.settle:
            return replace(searched, repeats=0)
        gap = gap_after(system, ready.records, searched.values, repeats=repeats)
        if gap < CLOSED or repeats >= MOST_REPEATS:
            return replace(searched, gap=gap)
        repeats *= 2


def _smooth(system: System, options: FitOptions) -> bool:
    """Is it solved for? Not where another optimizer than the usual one was asked for."""
    return solvable(system) and options.optimizer == registry.SEARCH


def _notes(problem: Problem, options: FitOptions, repeats: int) -> tuple[str, ...]:
    box = "; ".join(f"{p.name} {p.lower:.3g} to {p.upper:.3g} ({p.scaling})" for p in problem.space.parameters)
    bare = " The first one began at the model without its effects as well." if problem.system.effects else ""
    settled = f" Every loop was passed {repeats} times before it was scored." if repeats else ""
    runs = f"{options.optimizer} from other starts, {options.budget} evaluations each at most, seed {options.seed}"
    how = f"Two searches by {runs}, each finished by a local least-squares polish.{bare}"
    return (
        f"{SOLVED if _smooth(problem.system, options) else how}{settled}",
        f"Search box: {box}.",
        "Standard errors come from the Jacobian at the optimum and grow with the residuals' autocorrelation.",
    )


def _parameter_table(problem: Problem, fitted: FittedModel) -> pd.DataFrame:
    table = pd.DataFrame([{"name": name, **asdict(estimate)} for name, estimate in fitted.parameters.items()])
    return table.assign(at_bound=edges_reached(problem, fitted.values))
