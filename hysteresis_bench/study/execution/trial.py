"""One trial in a worker process: a study, a problem, an optimizer, a number in; an outcome out."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model, Optimizer
from hysteresis_bench.errors import UserError, told
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.checks.behaviour import BrokenPromise, broken_promises
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, seed_of, shared_start
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record, Signal
from hysteresis_bench.study.instances import instance_key
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.origin import Trial, origin, plugins_of_problem, plugins_of_trial
from hysteresis_bench.study.problems import Built, build_problem
from hysteresis_bench.study.store import Outcome
from hysteresis_bench.study.study_file import Study


@dataclass(frozen=True)
class Ticket:
    """Which trial to run. The study travels as text, so that a worker parses it once.

    alone : in a process of its own, as it runs a plugin of another distribution
    """

    study: str
    folder: str
    problem: str
    optimizer: str
    trial: int
    alone: bool = False
    instance: int = FIRST

    @property
    def key(self) -> Trial:
        return self.problem, self.optimizer, self.instance, self.trial

    def ended(self, study: Study, status: str, reason: str = "") -> Outcome:
        """Its outcome, as far as it has no result."""
        seed = seed_of(*seed_key(study, self))[:16]
        return Outcome(self.problem, self.optimizer, self.trial, seed, status, reason, instance=self.instance)


class NoInstance(Exception):
    """An instance of a problem that its constants make impossible: every trial on it fails, on any machine."""


def seed_key(study: Study, ticket: Ticket) -> tuple[object, ...]:
    """What the optimizer's random numbers depend on."""
    return study.seed, ticket.problem, ticket.optimizer, *instance_key(ticket.instance), ticket.trial


def prepare_trial(ticket: Ticket) -> Callable[[], Outcome]:
    """Everything that a trial needs but its search: the study, the data, the compiled problem, the optimizer."""
    study = _study(ticket.study)
    built = _built(ticket.study, ticket.folder, ticket.problem, ticket.instance)
    spec = next(spec for spec in study.optimizer if spec.name == ticket.optimizer)
    optimizer = registry.build("optimizers", spec.plugin, spec.settings)
    return partial(run_trial, ticket, built, optimizer, study.budget_of(spec))


def run_trial(ticket: Ticket, built: Built, optimizer: Optimizer, budget: int) -> Outcome:
    """Search, then measure the best point on the fitted and on the held-out records."""
    study, problem = _study(ticket.study), built.problem
    dimension, instance = problem.space.dimension, instance_key(ticket.instance)
    start = shared_start(dimension, study.seed, ticket.problem, *instance, ticket.trial)
    key = seed_key(study, ticket)

    begun = time.process_time()  # of this process alone: what else the machine does is not the optimizer's cost
    found = search(problem, optimizer, budget=budget, start=start, rng=generator(*key))
    seconds = time.process_time() - begun

    early = "" if found.spent else f"returned after {found.evaluations} of {budget} evaluations"
    ended = replace(
        ticket.ended(study, "finished-early" if early else "done", early),
        evaluations=found.evaluations,
        seconds=seconds,
        origin=_origin(ticket.study, ticket.problem, ticket.optimizer),
    )
    if not found.loss < problem.ceiling:
        return replace(ended, status="no-finite-loss", reason=f"none of {found.evaluations} simulations was finite")
    fitted = accuracy(problem.system, built.dataset.fitted, found.values)
    held_out = built.dataset.held_out
    unseen = accuracy(problem.system, held_out, found.values).rmse if held_out else None
    return replace(
        ended,
        reason=ended.reason if unseen is None or np.isfinite(unseen) else "the held-out records simulate to no number",
        fitness=found.loss,
        rmse=fitted.rmse,
        relative_rms=fitted.relative_rms,
        max_error=fitted.max_error,
        held_out_rmse=unseen if unseen is not None and np.isfinite(unseen) else None,
        parameters=dict(zip(problem.space.names, map(float, found.values), strict=True)),
        trace=found.trace,
    )


def tickets_of(study: Study, data: Path, trials: int) -> list[Ticket]:
    """Every trial of a study, one trial of everything after the other, on every instance before the next: one that is
    stopped has as much of all.

    data : the folder where relative data files are looked for
    """
    text, folder = study.model_dump_json(), str(data.resolve())
    optimizers = {spec.name: spec for spec in study.optimizer}
    strange = {
        (problem.name, label): not all(plugin.shipped for plugin in plugins_of_trial(problem, optimizers[label]))
        for problem in study.problem
        for label in problem.optimizers or study.labels
    }
    instances = {spec.name: study.instances_of(spec) for spec in study.problem}
    most = {spec.name: study.trials_of(spec, trials) for spec in study.problem}
    return [
        Ticket(text, folder, problem, label, trial, alone, instance)
        for trial in range(trials)
        for instance in range(FIRST, FIRST + max(instances.values()))
        for (problem, label), alone in strange.items()
        if instance - FIRST < instances[problem] and trial < most[problem]
    ]


def needs_own_process(ticket: Ticket) -> bool:
    return ticket.alone


def rehearsals(tickets: Sequence[Ticket]) -> list[Callable[[], object]]:
    """What trials have in common and plugins of other distributions have no part in, done once before any trial."""
    first = tickets[0]
    study = _study(first.study)
    strange = {spec.name for spec in study.problem if not all(plugin.shipped for plugin in plugins_of_problem(spec))}
    problems = dict.fromkeys(ticket.problem for ticket in tickets if ticket.problem not in strange)
    wanted = {ticket.optimizer for ticket in tickets}
    optimizers = [spec for spec in study.optimizer if spec.name in wanted]
    ours = [spec for spec in optimizers if registry.load("optimizers", spec.plugin).shipped]
    return [
        partial(_study, first.study),
        partial(origin, ()),
        *(partial(_built, first.study, first.folder, problem, FIRST) for problem in problems),
        *(partial(_rehearse, spec.plugin, spec.settings) for spec in ours),
    ]


class _Line(Model):
    """y = a u + b, to rehearse on."""

    parameters = (Parameter("a", 0.0, 1.0), Parameter("b", 0.0, 1.0))

    def simulate(self, signal: Signal, p: Any) -> Array:
        line: Array = p.a * signal.input + p.b
        return line


def _rehearse(plugin: str, settings: Mapping[str, Any]) -> None:
    """One evaluation by an optimizer, which imports and compiles what it needs."""
    ramp = np.linspace(0.0, 1.0, 8)
    system = System(_Line())
    problem = Problem(system, (Record(ramp, ramp, ramp),), Space(system.parameters), LOSSES["rmse"])
    start = shared_start(problem.space.dimension, "rehearsal")
    optimizer = registry.build("optimizers", plugin, settings)
    search(problem, optimizer, budget=1, start=start, rng=generator("rehearsal"))


@lru_cache(maxsize=4)
def _study(text: str) -> Study:
    return Study.model_validate_json(text)


@cache
def _origin(text: str, problem: str, optimizer: str) -> str:
    study = _study(text)
    spec = next(spec for spec in study.optimizer if spec.name == optimizer)
    return origin(plugins_of_trial(next(each for each in study.problem if each.name == problem), spec))


@lru_cache(maxsize=32)
def _built(text: str, folder: str, problem: str, instance: int) -> Built:
    """The problem, kept for the worker's next trials; simulated once, so that no trial pays for compilation."""
    study = _study(text)
    spec = next(spec for spec in study.problem if spec.name == problem)
    try:
        built = build_problem(spec, study.seed, Path(folder), instance)
    except (UserError, ValueError) as error:
        if instance == FIRST:
            raise
        raise NoInstance(f"instance {instance} cannot be simulated: {told(error)}") from None
    foreign = not all(plugin.shipped for plugin in plugins_of_problem(spec))  # our own are tested
    if foreign and (broken := broken_promises(built.problem.system, built.dataset.fitted)):
        raise BrokenPromise(" ".join(broken))
    middle = np.full((built.problem.space.dimension, 1), 0.5)
    built.problem.losses(middle)
    built.problem.losses(np.repeat(middle, 9, axis=1))
    return built
