"""One trial in a worker process: a study, a problem, an optimizer, a number in; an outcome out."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.search import search
from hysteresis_bench.fit.seeds import generator, seed_of, shared_start
from hysteresis_bench.study.problems import Built, build_problem
from hysteresis_bench.study.store import Outcome
from hysteresis_bench.study.study_file import Study


@dataclass(frozen=True)
class Ticket:
    """Which trial to run. The study travels as text, so that a worker parses it once."""

    study: str
    folder: str
    problem: str
    optimizer: str
    trial: int

    @property
    def key(self) -> tuple[str, str, int]:
        return self.problem, self.optimizer, self.trial


def seed_key(study: Study, ticket: Ticket) -> tuple[object, ...]:
    """What the optimizer's random numbers depend on."""
    return study.seed, ticket.problem, ticket.optimizer, ticket.trial


def run_trial(ticket: Ticket) -> Outcome:
    """Search, then measure the best point on the fitted and on the held-out records."""
    study = _study(ticket.study)
    built = _built(ticket.study, ticket.folder, ticket.problem)
    spec = next(spec for spec in study.optimizer if spec.name == ticket.optimizer)
    optimizer = registry.build("optimizers", spec.plugin, spec.settings)
    budget = study.budget_of(spec)
    problem = built.problem
    start = shared_start(problem.space.dimension, study.seed, ticket.problem, ticket.trial)
    key = seed_key(study, ticket)

    begun = time.process_time()  # of this process alone: what else the machine does is not the optimizer's cost
    found = search(problem, optimizer, budget, start, generator(*key))
    seconds = time.process_time() - begun

    fitted = accuracy(problem.system, built.dataset.fitted, found.values)
    held_out = built.dataset.held_out
    return Outcome(
        *ticket.key,
        seed=seed_of(*key)[:16],
        status="done" if found.spent else "finished-early",
        reason="" if found.spent else f"returned after {found.evaluations} of {budget} evaluations",
        evaluations=found.evaluations,
        fitness=found.loss,
        rmse=fitted.rmse,
        relative_rms=fitted.relative_rms,
        max_error=fitted.max_error,
        held_out_rmse=accuracy(problem.system, held_out, found.values).rmse if held_out else None,
        seconds=seconds,
        parameters=dict(zip(problem.space.names, map(float, found.values), strict=True)),
        trace=found.trace,
    )


@lru_cache(maxsize=4)
def _study(text: str) -> Study:
    return Study.model_validate_json(text)


@lru_cache(maxsize=8)
def _built(text: str, folder: str, problem: str) -> Built:
    """The problem, kept for the worker's next trials; simulated once, so that no trial pays for compilation."""
    study = _study(text)
    spec = next(spec for spec in study.problem if spec.name == problem)
    built = build_problem(spec, study.seed, Path(folder))
    middle = np.full((built.problem.space.dimension, 1), 0.5)
    built.problem.losses(middle)
    built.problem.losses(np.repeat(middle, 9, axis=1))
    return built
