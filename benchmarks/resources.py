"""Threads and memory: page faults of a fit, what a second BLAS thread costs, and the time of a swarm of any size.

python benchmarks/resources.py
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time
from collections.abc import Sequence

import numpy as np
from table import Line, fastest, show

from hysteresis_bench import DiagnosisOptions, diagnose, fit
from hysteresis_bench.compose import System
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Dataset, Record, Signal
from hysteresis_plugins.models.bouc_wen import BoucWen

ROUNDS = 3
SIZES = (
    *((1000, swarm) for swarm in (8, 50, 512, 4096)),
    *((6000, swarm) for swarm in (8, 50, 512, 4096)),
    *((100_000, swarm) for swarm in (8, 50, 640)),
    *((1_000_000, swarm) for swarm in (8, 64)),
)
"""(samples, swarm); the largest outputs are 512 MB."""


def measured(samples: int) -> Dataset:
    """Bouc-Wen with noise."""
    grid = np.linspace(0.0, 6.0, samples)
    drive = 2.5 * np.sin(np.pi * grid) * (1.0 - 0.1 * grid)
    truth = np.array([[0.35], [0.7], [0.15], [1.2]])
    output = System(BoucWen()).simulate(Signal(grid, drive[:, None]), truth)[:, 0]
    noise = 0.01 * np.ptp(output) * np.random.default_rng(0).normal(size=samples)
    return Dataset((Record(grid, drive, output + noise),))


def faults(effects: Sequence[str]) -> float:
    """Page faults of a fit, after one that imports and compiles."""
    data = measured(6000)
    fit(data, "bouc-wen", effects)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    fit(data, "bouc-wen", effects)
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)


def work(what: str) -> float:
    """CPU seconds of a fit or of a diagnosis, after one that imports and compiles."""
    data = measured(3000)
    taken = []
    for _ in range(ROUNDS):
        begun = time.process_time()
        fit(data, "bouc-wen", ["creep"]) if what == "fit" else diagnose(
            data, "bouc-wen", options=DiagnosisOptions(jobs=1)
        )
        taken.append(time.process_time() - begun)
    return min(taken[1:])


def threads(what: str) -> float:
    """CPU seconds with as many BLAS threads as there are cores, over those with one."""
    seconds: dict[bool, list[float]] = {True: [], False: []}
    for _ in range(2):
        for one in seconds:
            environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
            environment |= {"OPENBLAS_NUM_THREADS": "1"} if one else {}
            call = [sys.executable, __file__, what]
            told = subprocess.run(call, env=environment, capture_output=True, text=True, check=True).stdout
            seconds[one].append(float(told))
    return min(seconds[False]) / min(seconds[True])


def sizes() -> list[Line]:
    """Time a particle-sample of losses, over that of 50 particles and 6000 samples."""
    system = System(BoucWen())
    space = Space(tuple(parameter.within(0.1, 2.0, "linear") for parameter in system.parameters))
    runs, counts = {}, {}
    for samples, swarm in SIZES:
        problem = Problem(system, measured(samples).records, space, LOSSES["rmse"])
        points = np.random.default_rng(0).uniform(size=(4, swarm))
        repeats = max(1, 1_000_000 // (samples * swarm))
        name = f"{samples} samples, {swarm} particles"
        runs[name] = lambda problem=problem, points=points, repeats=repeats: [
            problem.losses(points) for _ in range(repeats)
        ]
        counts[name] = repeats * samples * swarm
    with economical():
        seconds = fastest(runs, ROUNDS)
    unit = seconds["6000 samples, 50 particles"] / counts["6000 samples, 50 particles"]
    return [Line(name, taken / counts[name] / unit, 1.3) for name, taken in seconds.items()]


def main() -> None:
    lines = [Line("bouc-wen", faults([]), 5000), Line("bouc-wen with creep", faults(["creep"]), 5000)]
    show("A fit of 6000 samples", "page faults", lines)
    lines = [Line(what, threads(what), 1.05) for what in ("fit", "diagnose")]
    show("CPU with OPENBLAS_NUM_THREADS unset, over that with 1", "times", lines)
    show("A particle-sample of losses, against 50 particles on 6000 samples", "times", sizes())


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(work(sys.argv[1]))
    else:
        main()
