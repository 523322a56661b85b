"""How fast a plugin is, as a ratio to the shipped ones of its kind."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.testing.examples import Cubic, Waves, measured
from hysteresis_bench.testing.meter import watch
from hysteresis_bench.testing.plugin import shipped
from hysteresis_bench.testing.swarms import drawn

REPEATS = 3
BUDGET = 500
"""Evaluations of a search; what the optimizer does between them is what is measured."""
SAMPLES, SWARM = 1000, 50


def speed(kind: registry.Kind, plugin: str) -> str:
    """A sentence: processor time of a fixed task, and its ratio to the median of the shipped plugins."""
    own = _seconds(kind, plugin)
    times = [_seconds(kind, name) for name in shipped(kind) if name != plugin]
    middle = float(np.median(times))
    tasks = {
        "optimizers": f"a search of {BUDGET} evaluations",
        "models": f"{SWARM} simulations of {SAMPLES} samples",
        "effects": f"{SWARM} simulations of {SAMPLES} samples around a cubic",
        "rigs": "the first experiment",
    }
    return (
        f"{tasks[kind]} takes {1e3 * own:.3g} ms, {own / middle:.2g} times the median of the {len(times)} shipped "
        f"{kind} ({1e3 * min(times):.3g} to {1e3 * max(times):.3g} ms)."
    )


def _seconds(kind: registry.Kind, plugin: str) -> float:
    """Least processor time of a few repeats, after one that imports and compiles."""
    task = _task(kind, registry.build(kind, plugin))
    task()
    times = []
    for _ in range(REPEATS):
        begun = time.process_time()
        task()
        times.append(time.process_time() - begun)
    return max(min(times), 1e-7)


def _task(kind: registry.Kind, built: Any) -> Callable[[], object]:
    if kind == "optimizers":
        return partial(watch, built, Waves(5), BUDGET)
    if kind == "rigs":
        return lambda: built.measure(next(iter(built.experiments)), np.random.default_rng(0))
    record = measured(SAMPLES)
    system = System(built) if kind == "models" else System(Cubic(), (("effect", built),))
    values = drawn(system.box([record]), SWARM)
    return lambda: system.respond(record, values)
