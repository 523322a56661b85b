"""What the runner adds to a trial: wall time beyond the search itself, for trials of one evaluation, one at a time.

Shipped plugins share a worker; a trial of another distribution is a forked process of its own, which finds the problem
prepared where only its optimizer comes from elsewhere, and prepares it where its model does too. Storing is included,
and so is measuring the best point on the fitted and on the held-out records.

    .venv/bin/python benchmarks/runner.py [--scheduler ADDRESS]
"""

from __future__ import annotations

import argparse
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


if __name__ == "__main__":
    main()
