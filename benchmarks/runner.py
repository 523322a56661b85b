"""What the runner adds to a trial: wall time beyond the search itself, for trials of one evaluation, one at a time.

Shipped plugins share a worker; a trial of another distribution is a forked process of its own, which finds the problem
prepared where only its optimizer comes from elsewhere, and prepares it where its model does too. Storing is included,
and so is measuring the best point on the fitted and on the held-out records. Then what two workers add: a study by
`run --jobs 2` against two processes at once that each run a study of half its trials alone.

    .venv/bin/python benchmarks/runner.py [--scheduler ADDRESS]
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from table import Line, show

from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.signals import Dataset, Record
from hysteresis_bench.study.execution.cluster import Cluster
from hysteresis_bench.study.execution.pool import Pool, Work
from hysteresis_bench.study.execution.trial import needs_own_process, prepare_trial, rehearsals, tickets_of
from hysteresis_bench.study.store import Store
from hysteresis_bench.study.study_file import check_study

PLUGINS = Path(__file__).parents[1] / "tests" / "test_plugins"
KINDS = {
    "shipped plugins": ("bouc-wen", "random-search", 600),
    "an optimizer of another distribution": ("bouc-wen", "faulty-returns", 100),
    "a model of another distribution": ("polynomial", "random-search", 100),
}


def milliseconds(folder: Path, model: str, optimizer: str, trials: int, scheduler: str | None) -> float:
    """Wall time a trial beyond the processor time of its search, one trial at a time."""
    problem = {"name": "p", "model": model, "data": ["data.csv"]}
    raw = {"title": "t", "seed": 1, "budget": 8, "problem": [problem], "optimizer": [{"plugin": optimizer}]}
    tickets = tickets_of(check_study(raw, "t"), folder, trials + 1)
    work = Work(prepare_trial, 60.0, rehearsals(tickets), needs_own_process)
    results = Path(tempfile.mkdtemp(dir=folder))
    with Cluster(work, scheduler) if scheduler else Pool(work, 1) as workers, Store(results) as store:
        store.begin("t")
        for _ in workers.run(tickets[:1]):  # the pool is up
            begun = time.perf_counter()
        searched = 0.0
        for _, outcome, status, reason in workers.run(tickets[1:]):
            assert outcome is not None, (status, reason)
            store.add(outcome)
            searched += outcome.seconds or 0.0
        return 1e3 * (time.perf_counter() - begun - searched) / trials


STUDY = """title = "t"
seed = {seed}
trials = {trials}
budget = 60200

[[problem]]
name = "p"
model = "bouc-wen"
data = ["data.csv"]

[[optimizer]]
plugin = "pso"
"""


def wall_seconds(folder: Path, studies: int, trials: int, jobs: int) -> float:
    """Of this many processes at once, each with a study of its own."""
    running = []
    begun = time.perf_counter()
    for seed in range(1, studies + 1):
        study = folder / f"study-{seed}.toml"
        study.write_text(STUDY.format(seed=seed, trials=trials))
        results = tempfile.mkdtemp(dir=folder)
        call = [sys.executable, "-m", "hysteresis_bench", "run", str(study), "--jobs", str(jobs), "--out", results]
        running.append(subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
    for process in running:
        assert process.wait() == 0
    return time.perf_counter() - begun


def two_workers(folder: Path, trials: int) -> Line:
    """The best of three turns each, after one that compiles."""
    wall_seconds(folder, 1, 2, 1)
    together, apart = [], []
    for _ in range(3):
        together.append(wall_seconds(folder, 1, trials, 2))
        apart.append(wall_seconds(folder, 2, trials // 2, 1))
    name = f"{trials} trials by one run with two workers, in so many times the speed of two runs of half of them"
    return Line(name, min(apart) / min(together), least=0.93)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", help="of Dask distributed; its workers must find tests/test_plugins")
    scheduler = parser.parse_args().scheduler
    sys.path.append(str(PLUGINS))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ramp = np.linspace(0.0, 1.0, 200)
        write_csv(folder / "data.csv", Dataset((Record(ramp, np.sin(9.0 * ramp), np.cos(9.0 * ramp)),)))
        lines = [
            Line(kind, min(milliseconds(folder, model, optimizer, trials, scheduler) for _ in range(3)))
            for kind, (model, optimizer, trials) in KINDS.items()
        ]
        show("A trial beyond its search, the best of three times", "ms", lines)
        show("Workers", "ratio", [two_workers(folder, 48)])


if __name__ == "__main__":
    main()
