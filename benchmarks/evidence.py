"""What a diagnosis spends before its search, and in all, on 15 000 samples with every candidate.

python benchmarks/evidence.py
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from table import Line, show

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.signals import Dataset, Record, Signal

SAMPLES, RECORDS, ROUNDS = 15_000, 3, 2
VALUES = {"bouc-wen": (0.35, 0.7, 0.15, 1.2), "creep": (0.2, 0.3, 2.0)}


def measured(effects: tuple[str, ...]) -> Dataset:
    """Bouc-Wen with these effects at three speeds and amplitudes, with noise and a temperature."""
    rng = np.random.default_rng(3)
    model = registry.build("models", "bouc-wen")
    system = System(model, registry.build_effects(model, effects))
    values = np.array([number for name in ("bouc-wen", *effects) for number in VALUES[name]])[:, None]
    records = []
    for number in range(RECORDS):
        grid = np.linspace(0.0, 6.0, SAMPLES // RECORDS)
        phase = 2.0 * np.pi * grid * (0.5 + 0.5 * number)
        drive = (2.5 - 0.7 * number) * np.sin(phase) * (1.0 - 0.06 * grid)
        output = system.simulate(Signal(grid, drive[:, None]), values)[:, 0]
        output = output + 0.01 * np.ptp(output) * rng.normal(size=grid.size)
        records.append(Record(grid, drive, output, f"record {number}", columns={"temperature": 20.0 + 2.0 * grid}))
    return Dataset(tuple(records))


def least(run: Callable[[], Any], clock: Callable[[], float]) -> float:
    """Seconds of the fastest round, after one that imports and compiles."""
    taken = []
    for _ in range(ROUNDS + 1):
        begun = clock()
        run()
        taken.append(clock() - begun)
    return min(taken[1:])


def main() -> None:
    from hysteresis_bench.diagnosis.diagnose import diagnose

    shares, walls = [], []
    for effects in ((), ("creep",)):
        data = measured(effects)
        one, two = (Question("bouc-wen", options=DiagnosisOptions(jobs=jobs)) for jobs in (1, 2))
        name = " + ".join(("bouc-wen", *effects))
        with economical():
            before = least(lambda data=data, one=one: gather(prepare(data, one).views), time.process_time)
        whole = least(lambda data=data, one=one: diagnose(data, one), time.process_time)
        shares.append(Line(name, before / whole, 0.15))
        walls.append(Line(name, least(lambda data=data, two=two: diagnose(data, two), time.perf_counter), 8.0))
    show("Before the search, of a whole diagnosis", "share of the CPU time", shares)
    show(f"A diagnosis of {SAMPLES} samples by two processes", "s of wall time", walls)


if __name__ == "__main__":
    main()
