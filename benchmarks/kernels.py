"""How fast a swarm is: against scalar loops, and in a whole trial against other libraries.

python benchmarks/kernels.py [--rounds N] [--no-trials]
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numba import njit
from peers import TRIALS
from table import Line, medians, show

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import BudgetSpent, Objective, Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models.jiles_atherton import JilesAtherton
from hysteresis_plugins.models.jiles_atherton_clamped import JilesAthertonClamped
from hysteresis_plugins.optimizers.pso import Pso

SAMPLES, PARTICLES, ITERATIONS = 6000, 50, 300


def jiles_atherton_loop(H, alpha, a, k, M_s, c, clamped):  # type: ignore[no-untyped-def]
    """One particle, a loop over the samples with tanh and branches, as it is usually written -> B.

    The same equations by the usual explicit Euler step, M of the sample before in H_eff.
    """
    B = np.empty(H.size)
    M = Mi = 0.0
    for i in range(H.size):
        x = (H[i] + alpha * M) / a
        Ma = M_s * (1.0 / math.tanh(x) - 1.0 / x) if abs(x) > 1e-3 else M_s * x / 3.0
        dH = H[i] - H[i - 1] if i > 0 else 0.0
        if dH != 0.0:
            delta = 1.0 if dH > 0.0 else -1.0
            if not (clamped and (Ma - Mi) * delta < 0.0):
                Mi += dH * (Ma - Mi) / (k * delta - alpha * (Ma - Mi))
        M = c * Ma + (1.0 - c) * Mi
        B[i] = 4e-7 * math.pi * (H[i] + M)
    return B


@dataclass(frozen=True)
class Entry:
    """A kernel to time.

    loop : (input, *parameters of one particle) -> output, plain Python that numba can compile
    truth : where the swarm is scattered, half a decade or so around
    drive : (samples,) input
    """

    name: str
    model: Model
    loop: Callable[..., Array]
    truth: Mapping[str, float]
    drive: Array


CYCLES = 60.0 * np.sin(2 * np.pi * 3 * np.linspace(0.0, 1.0, SAMPLES))
SOFT = {"alpha": 1e-6, "a": 6.0, "k": 10.0, "M_s": 2.5e6, "c": 0.2}
ENTRIES = (
    Entry("jiles-atherton", JilesAtherton(), partial(jiles_atherton_loop, clamped=False), SOFT, CYCLES),
    Entry("jiles-atherton-clamped", JilesAthertonClamped(), partial(jiles_atherton_loop, clamped=True), SOFT, CYCLES),
)


def compiled(loop: Callable[..., Array]) -> Callable[..., Array]:
    """A partial of a plain-Python loop, compiled, with its keywords bound."""
    function, keywords = (loop.func, loop.keywords) if isinstance(loop, partial) else (loop, {})
    return partial(njit(error_model="numpy")(function), **keywords)


def kernel_rows(entry: Entry, rounds: int) -> list[Line]:
    values = np.array(list(entry.truth.values()))[:, None]
    swarm = values * np.exp(np.random.default_rng(0).normal(0.0, 0.5, (values.size, PARTICLES)))
    system = System(entry.model)
    signal = Signal(np.arange(SAMPLES, dtype=float), entry.drive[:, None])
    own = signal.with_input(np.repeat(entry.drive[:, None], PARTICLES, axis=1))
    one = np.ascontiguousarray(swarm[:, :1])
    fast = compiled(entry.loop)
    short = entry.drive[:500]
    variants: dict[str, tuple[Callable[[], Any], int]] = {
        f"swarm of {PARTICLES}": (lambda: system.simulate(signal, swarm), PARTICLES * SAMPLES),
        f"swarm of {PARTICLES}, an input each": (lambda: system.simulate(own, swarm), PARTICLES * SAMPLES),
        "swarm of 1": (lambda: system.simulate(signal, one), SAMPLES),
        "compiled scalar loop (Euler)": (lambda: fast(entry.drive, *one[:, 0]), SAMPLES),
        "plain Python loop (Euler)": (lambda: entry.loop(short, *one[:, 0]), short.size),
    }
    seconds = medians({name: call for name, (call, _) in variants.items()}, rounds)
    return [Line(name, 1e9 * seconds[name] / size) for name, (_, size) in variants.items()]


def trial_rows(entry: Entry, rounds: int) -> list[Line]:
    """CPU seconds of a whole trial of 50 particles, first swarm + 300 iterations."""
    truth = np.array(list(entry.truth.values()))
    fast = compiled(entry.loop)
    measured = System(entry.model).simulate(
        Signal(np.arange(SAMPLES, dtype=float), entry.drive[:, None]), truth[:, None]
    )
    measured = measured[:, 0] + 0.01 * np.random.default_rng(1).normal(0.0, np.ptp(measured), SAMPLES)
    record = Record(np.arange(SAMPLES, dtype=float), entry.drive, measured)
    box = [p.within(entry.truth[p.name] / 5, entry.truth[p.name] * 5, "log") for p in entry.model.parameters]
    problem = Problem(System(entry.model), (record,), Space(tuple(box)), LOSSES["rmse"])

    def ours() -> None:
        objective = Objective(problem, PARTICLES * (ITERATIONS + 1))
        first = np.random.default_rng(2).random((truth.size, PARTICLES))
        try:
            Pso(particles=PARTICLES).search(objective, lambda particles: first[:, :particles], np.random.default_rng(3))
        except BudgetSpent:
            return

    def loss(point: Array) -> float:
        values = problem.space.from_unit(point[:, None])[:, 0]
        error = fast(entry.drive, *values) - measured
        with np.errstate(over="ignore", invalid="ignore"):
            return float(np.nan_to_num(math.sqrt(error @ error / SAMPLES), nan=1e9, posinf=1e9))

    seconds = medians({"pso on the swarm kernel": ours}, rounds)
    theirs = {name: partial(trial, loss, truth.size, PARTICLES, ITERATIONS + 1) for name, trial in TRIALS.items()}
    return [Line(*one) for one in (*seconds.items(), *medians(theirs, 1).items())]


def main() -> None:
    arguments = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    arguments.add_argument("--rounds", type=int, default=7)
    arguments.add_argument("--no-trials", action="store_true", help="only the kernels")
    asked = arguments.parse_args()
    for entry in ENTRIES:
        show(f"{entry.name}, {SAMPLES} samples", "ns a particle-sample", kernel_rows(entry, asked.rounds))
        if not asked.no_trials:
            title = f"{entry.name}: a trial of {PARTICLES} x {ITERATIONS} on {SAMPLES} samples"
            show(title, "CPU s", trial_rows(entry, 3))


if __name__ == "__main__":
    main()
