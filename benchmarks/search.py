"""What a fit's search costs: against two swarms, against scipy's least squares, against global searches.

    python benchmarks/search.py [--truths N]

Every truth is a model's own loop with 1 % of noise, 6000 samples, searched in the box that `fit` derives. CPU time of
this process; a ratio is the median over truths of ratios of the same minute. Peers ask the compiled kernel for one
point at a time, as their users do; that is no slower than a scalar compiled loop (`benchmarks/kernels.py`).
"""

from __future__ import annotations

import argparse
import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.fit.least_squares import polish
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem
from hysteresis_bench.fit.seeds import generator, shared_start
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

SAMPLES, BUDGET, NOISE = 6000, 15_050, 0.01
SUCCESS, NEAR = 1.0001, 1.01
"""Of the least loss that is known: what counts as found, and as nearly found."""
TIME = np.linspace(0.0, 1.0, SAMPLES)
DRIVES = (
    np.sin(31.4 * TIME) * np.linspace(0.2, 1.0, SAMPLES),
    (np.sin(18.8 * TIME) + 0.5 * np.sin(45.9 * TIME)) / 1.4,
    np.sin(62.8 * TIME) * np.exp(-2.0 * TIME),
)


def _bouc_wen(rng: np.random.Generator) -> dict[str, float]:
    beta = 10 ** rng.uniform(-1, 1)
    return {
        "alpha": rng.uniform(0.1, 0.9),
        "beta": beta,
        "gamma": beta * rng.uniform(-0.9, 0.9),
        "d": 10 ** rng.uniform(-1, 1),
    }


def _jiles_atherton(rng: np.random.Generator) -> dict[str, float]:
    saturation, form = 10 ** rng.uniform(5.7, 6.5), 5000.0 * 10 ** rng.uniform(-1.3, -0.3)
    interaction, pinning = rng.uniform(0.05, 2.5) * form / saturation, 5000.0 * 10 ** rng.uniform(-1.5, -0.3)
    return {"alpha": interaction, "a": form, "k": pinning, "M_s": saturation, "c": rng.uniform(0.02, 0.6)}


def _free_energy(rng: np.random.Generator) -> dict[str, float]:
    low = np.array([-0.5, 0.0, -0.5, -0.7, -1.0, -1.0])
    high = np.array([0.5, 2.0, 0.2, 0.3, 0.0, 1.0])
    return dict(zip(("M_R", "eta", "H_c", "b", "c", "alpha"), (10 ** rng.uniform(low, high)).tolist(), strict=True))


@dataclass(frozen=True)
class Subject:
    """A model, how its truths are drawn, the amplitude of the drive.

    peers : whether peers are raced, which takes minutes where the model is slow
    share : of the CPU time of two swarms and their polish that is asked at most
    """

    model: str
    draw: Callable[[np.random.Generator], dict[str, float]]
    amplitude: float
    share: float
    peers: bool = True


SUBJECTS = (
    Subject("bouc-wen", _bouc_wen, 3.0, 0.12),
    Subject("jiles-atherton", _jiles_atherton, 5000.0, 0.12),
    Subject("free-energy", _free_energy, 4.0, 0.06, peers=False),
)


def truths(subject: Subject, count: int) -> Iterator[tuple[Problem, Array]]:
    """Problems and their true points in the unit box, cut at it, (dimension, 1)."""
    rng, system = np.random.default_rng(17), System(registry.build("models", subject.model))
    for number in range(count):
        truth = subject.draw(rng)
        values = np.array([[truth[q.name]] for q in system.parameters])
        drive = subject.amplitude * DRIVES[number % len(DRIVES)]
        clean = system.simulate(Record(TIME, drive, None).signal, values)[:, 0]
        record = Record(TIME, drive, clean + NOISE * np.std(clean) * rng.standard_normal(SAMPLES))
        problem = Problem(system, (record,), Space(system.box([record])), LOSSES["rmse"])
        yield problem, np.clip(problem.space.to_unit(values), 0.0, 1.0)


class Near(Exception):
    """The loss is near the floor: the race is over."""


class Race(Objective):
    """A meter that ends the search near the floor."""

    def __init__(self, problem: Problem, budget: int, floor: float = 0.0) -> None:
        super().__init__(problem, budget)
        self.line = NEAR * floor

    def _record(self, losses: Array, points: Array) -> None:
        super()._record(losses, points)
        if self.best < self.line:
            raise Near


def ours(problem: Problem, name: str, seed: int, floor: float = 0.0) -> Race:
    meter = Race(problem, BUDGET, floor)
    with contextlib.suppress(BudgetSpent, Near):
        built = registry.build("optimizers", name)
        built.search(meter.shown(), shared_start(problem.space.dimension, seed), generator(seed))
    return meter


def fitted(problem: Problem, name: str, seeds: tuple[int, int]) -> float:
    """The least loss of two searches and their polish, as in `fit`."""
    found = np.column_stack([problem.space.from_unit(ours(problem, name, seed).best_point[:, None]) for seed in seeds])
    return float(problem.losses(problem.space.to_unit(polish(problem, found))).min())


def scipy_least_squares(problem: Problem, seed: int) -> float:
    """Restarts from uniform points until the best was found twice, as a user would write it."""
    from scipy.optimize import least_squares

    def residuals(point: Array) -> Array:
        return problem.residuals(np.clip(point, 0.0, 1.0)[:, None])[:, 0] / problem.scale

    rng, ends = np.random.default_rng(seed), [np.inf]
    while len(ends) < 60:
        cost = least_squares(residuals, rng.random(problem.space.dimension), bounds=(0.0, 1.0), x_scale="jac").cost
        ends = sorted([*ends, problem.scale * float(np.sqrt(2.0 * cost / SAMPLES))])
        if ends[1] < ends[0] * (1.0 + 1e-4):
            break
    return ends[0]


def differential_evolution(meter: Race, seed: int) -> None:
    from scipy.optimize import differential_evolution as search

    search(meter, [(0.0, 1.0)] * meter.dimension, maxiter=10**6, popsize=10, tol=0.0, polish=False, seed=seed)


def crs2(meter: Race, seed: int) -> None:
    import nlopt

    nlopt.srand(seed + 1)
    search = nlopt.opt(nlopt.GN_CRS2_LM, meter.dimension)
    search.set_lower_bounds(np.zeros(meter.dimension))
    search.set_upper_bounds(np.ones(meter.dimension))
    search.set_min_objective(lambda point, _: meter(point))
    search.optimize(np.random.default_rng(seed).random(meter.dimension))


PEERS = {"scipy differential evolution": differential_evolution, "nlopt CRS2": crs2}


def race(problem: Problem, peer: Callable[[Race, int], None], seed: int, floor: float) -> bool:
    """Whether the peer came near the floor."""
    meter = Race(problem, BUDGET, floor)
    # nlopt tells an exception of its callback as its own kind
    with contextlib.suppress(BudgetSpent, Near, SystemError, RuntimeError):
        peer(meter, seed)
    return bool(meter.best < meter.line)


def timed(task: Callable[..., Any], *arguments: Any) -> tuple[float, Any]:
    begun = time.process_time()
    answer = task(*arguments)
    return time.process_time() - begun, answer


@dataclass(frozen=True)
class Taken:
    """Of one truth: CPU time as ratios to ours, and what was found."""

    share: float
    found: bool
    swarm_found: bool
    evaluations: int
    restarts: float = np.nan
    restarts_found: bool = False
    peers: tuple[float, ...] = ()


def taken(subject: Subject, problem: Problem, true: Array, seed: int) -> Taken:
    seeds = (2 * seed, 2 * seed + 1)
    now, least = timed(fitted, problem, registry.SEARCH, seeds)
    swarms, swarm = timed(fitted, problem, "pso-constriction", seeds)
    truth = problem.losses(problem.space.to_unit(polish(problem, problem.space.from_unit(true))))
    floor = min(least, swarm, float(truth[0]))
    one, meter = timed(ours, problem, registry.SEARCH, seed)
    found = Taken(now / swarms, least < SUCCESS * floor, swarm < SUCCESS * floor, meter.evaluations)
    if not subject.peers:
        return found
    near, _ = timed(ours, problem, registry.SEARCH, seed, floor)
    other, least = timed(scipy_least_squares, problem, seed)
    spent = [timed(race, problem, peer, seed, floor)[0] / near for peer in PEERS.values()]
    return replace(found, restarts=other / one, restarts_found=least < SUCCESS * floor, peers=tuple(spent))


Row = tuple[str, str, str, bool | None]
"""What, measured, asked, held?"""


def rows(subject: Subject, count: int) -> list[Row]:
    posed = list(truths(subject, count))
    taken(subject, *posed[0], seed=99)  # compiles
    all_ = [taken(subject, problem, true, seed) for seed, (problem, true) in enumerate(posed)]
    shares, found = [one.share for one in all_], sum(one.found for one in all_)
    swarms, evaluations = sum(one.swarm_found for one in all_), [one.evaluations for one in all_]
    share = float(np.median(shares))
    told: list[Row] = [
        (
            "two searches and polish, CPU / two swarms of 15 050 and polish",
            f"{share:.3f} (worst {max(shares):.3f})",
            f"<= {subject.share}",
            share <= subject.share,
        ),
        ("truths found (by the swarms)", f"{found} of {count} ({swarms})", "no fewer", found >= swarms),
        ("evaluations of a search", f"{np.median(evaluations):.0f} (most {max(evaluations)})", "", None),
    ]
    if not subject.peers:
        return told
    slower, others = float(np.median([one.restarts for one in all_])), sum(one.restarts_found for one in all_)
    name, fastest = min(
        zip(PEERS, np.median([one.peers for one in all_], axis=0), strict=True), key=lambda pair: float(pair[1])
    )
    return [
        *told,
        (
            "scipy least squares, restarted until found twice, CPU / ours (found)",
            f"{slower:.1f} ({others} of {count})",
            ">= 1, no more found",
            slower >= 1.0 and found >= others,
        ),
        (f"{name}, the fastest full-budget peer, CPU to 1 % / ours", f"{fastest:.1f}", ">= 12", bool(fastest >= 12.0)),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--truths", type=int, default=20)
    count = parser.parse_args().truths
    console = Console(width=140)
    for subject in SUBJECTS:
        shown = Table(title=f"{subject.model}, {count} truths")
        for head in ("", "measured", "asked", ""):
            shown.add_column(head)
        for what, measured, asked, held in rows(subject, count):
            shown.add_row(what, measured, asked, "" if held is None else "held" if held else "missed")
        console.print(shown)


if __name__ == "__main__":
    main()
