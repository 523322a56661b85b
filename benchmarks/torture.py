"""A study that is ill-treated, beside the same one left in peace.

    .venv/bin/python benchmarks/torture.py [--trials N] [--kills N] [--worker-kills N] [--dask] [--jobs N]

First with bad trials: a fifth of all, as many of each kind that tests/torture_distribution knows (sys.exit, a
segmentation fault, 50 GB, the interpreter's lock held, descriptors closed, ...). All good ones must end with the bits
of the study left in peace, all bad ones must be named, no process may be left, and the wall time is told beside that
of the good trials alone. Then with SIGKILLs of the runner, then of its workers, at random moments: after `run`, and
`run --retry`, trials.csv must be the same. Exits with 1 where it is not so.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pandas as pd

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests.torture_distribution.misbehaviour import EXPECTED  # noqa: E402

MARK = "HYSTERESIS_TORTURE"
FAST, SLOW = (
    ("pso", "mpso", "icpso", "pso-constriction", "random-search"),
    ("scipy-nelder-mead", "nlopt-crs2", "pymoo-de"),
)
PATIENCE = 20.0
"""Seconds in which what a run started is gone: a Dask worker keeps its pool for ten."""
SLOWER = 6
"""How much the latter take for an evaluation, about; they get so much less."""


class Failed(Exception):
    """What must hold does not."""


def expect(holds: object, otherwise: str) -> None:
    if not holds:
        raise Failed(otherwise)


class Bench:
    """A folder with data and two studies, one of them with bad optimizers, and processes that carry its mark.

    variants : studies of every good optimizer;  trials : of everything;  budget, timeout : of a trial
    """

    def __init__(self, folder: Path, *, variants: int, trials: int, budget: int, timeout: float) -> None:
        self.folder, self.trials = folder, trials
        self.mark = uuid.uuid4().hex
        path = os.pathsep.join([str(ROOT / "tests" / "torture_distribution"), os.environ.get("PYTHONPATH", "")])
        self.environment = {**os.environ, "PYTHONPATH": path, MARK: self.mark}
        ramp = np.linspace(0.0, 1.0, 600)
        drive, noise = np.sin(14.0 * ramp), 0.01 * np.random.default_rng(0).standard_normal(ramp.size)
        frame = pd.DataFrame({"time": ramp, "input": drive, "output": drive + 0.3 * drive**3 + noise})
        frame.to_csv(folder / "data.csv", index=False)
        head = f"seed = 7\ntrials = {trials}\nbudget = {budget}\ntimeout = {timeout}\n"
        problem = '[[problem]]\nname = "p"\nmodel = "bouc-wen"\ndata = ["data.csv"]\n'
        good = "".join(
            f'[[optimizer]]\nplugin = "{plugin}"\nlabel = "{plugin} {number}"\nbudget = {share}\n'
            for plugins, share in ((FAST, budget), (SLOW, budget // SLOWER))
            for plugin in plugins
            for number in range(variants)
        )
        bad = "".join(
            f'[[optimizer]]\nplugin = "misbehaves"\nlabel = "{kind}"\nsettings = {{ kind = "{kind}" }}\n'
            for kind in EXPECTED
        )
        self.good, self.both = folder / "good.toml", folder / "both.toml"
        self.good.write_text(f'title = "good"\n{head}{problem}{good}', encoding="utf-8")
        self.both.write_text(f'title = "good"\n{head}{problem}{_mixed(good, bad)}', encoding="utf-8")

    def start(self, study: Path, out: str, *more: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "hysteresis_bench", "run", str(study), "--out", str(self.folder / out), *more]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        return subprocess.Popen(command, env=self.environment, cwd=self.folder, **quiet)  # type: ignore[call-overload]

    def run(self, study: Path, out: str, *more: str) -> float:
        """Wall time of the whole command."""
        begun = time.monotonic()
        code = self.start(study, out, *more).wait()
        expect(code in (0, 1), f"the run ended with exit code {code}")
        return time.monotonic() - begun

    def table(self, out: str) -> pd.DataFrame:
        table = pd.read_csv(self.folder / out / "trials.csv", dtype={"reason": str}).drop(columns="seconds")
        return table.fillna({"reason": ""}).astype({"evaluations": float})  # as where a trial has none

    def marked(self) -> set[int]:
        """Processes that carry the mark: of a run, and whatever it left."""
        found = set()
        for path in Path("/proc").glob("[0-9]*/environ"):
            try:
                content, state = path.read_bytes(), (path.parent / "stat").read_text().rpartition(")")[2].split()[0]
            except OSError:
                continue
            if self.mark.encode() in content and state != "Z":
                found.add(int(path.parent.name))
        return found

    def expect_no_orphan(self, besides: set[int]) -> None:
        deadline = time.monotonic() + PATIENCE
        while self.marked() - besides and time.monotonic() < deadline:
            time.sleep(0.1)
        expect(not self.marked() - besides, f"processes are left: {self.marked() - besides}")


def _mixed(good: str, bad: str) -> str:
    """The bad optimizers spread among the good ones."""
    parts = [[f"[[optimizer]]{part}" for part in text.split("[[optimizer]]")[1:]] for text in (good, bad)]
    places = [(index / len(part), text) for part in parts for index, text in enumerate(part)]
    return "".join(text for _, text in sorted(places, key=lambda place: place[0]))


def bad_trials(bench: Bench, *more: str) -> str:
    alone = bench.run(bench.good, "good", *more)
    besides = bench.marked()
    wall = bench.run(bench.both, "both", *more)
    bench.expect_no_orphan(besides)
    table, good = bench.table("both"), bench.table("good")
    mine = table[~table["optimizer"].isin(EXPECTED)].reset_index(drop=True)[good.columns]
    expect(set(good["status"]) == {"done"}, f"left in peace: {good['status'].value_counts().to_dict()}")
    expect(mine.equals(good), "good trials have other bits")
    for kind, (status, reason) in EXPECTED.items():
        rows = table[table["optimizer"] == kind]
        expect(len(rows) == bench.trials, f"{kind}: {len(rows)} rows of {bench.trials}")
        named = (rows["status"] == status) & rows["reason"].str.contains(reason, regex=False)
        expect(named.all(), f"{kind}: {rows[['status', 'reason']].to_dict('records')}")
    bad = len(table) - len(good)
    return (
        f"{len(table)} trials, {bad} bad ones of {len(EXPECTED)} kinds: all named, good ones to the last bit, no "
        f"orphan; {wall:.1f} s beside {alone:.1f} s without the bad ones: {wall / alone:.2f} times"
    )


def runner_kills(bench: Bench, kills: int, longest: float) -> str:
    done = 0
    for _ in range(kills):
        running = bench.start(bench.good, "killed")
        time.sleep(random.uniform(0.0, longest))
        if running.poll() is None:
            running.kill()
            done += 1
        running.wait()
    bench.expect_no_orphan(set())
    bench.run(bench.good, "killed")
    expect(bench.table("killed").equals(bench.table("good")), "other bits after kills of the runner")
    return f"{done} SIGKILLs of the runner: trials.csv is the same, no orphan"


def worker_kills(bench: Bench, kills: int, longest: float) -> str:
    done = 0
    while done < kills:
        running = bench.start(bench.good, "lost", "--retry")
        while running.poll() is None and done < kills:
            time.sleep(random.uniform(0.0, longest))
            if workers := sorted(bench.marked() - {running.pid}):
                os.kill(random.choice(workers), signal.SIGKILL)
                done += 1
        expect(running.wait() in (0, 1), f"the run ended with exit code {running.returncode}")
        if done < kills:
            (bench.folder / "lost").rename(bench.folder / f"lost-{done}")
    lost = bench.table("lost")["status"].value_counts().to_dict()
    bench.run(bench.good, "lost", "--retry")
    bench.expect_no_orphan(set())
    expect(bench.table("lost").equals(bench.table("good")), "other bits after kills of workers")
    return f"{done} SIGKILLs of workers (last run before --retry: {lost}): trials.csv is the same, no orphan"


@contextmanager
def dask(bench: Bench) -> Iterator[str]:
    """The address of a scheduler on loopback with two workers."""
    file = bench.folder / "scheduler.json"
    module = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": bench.environment}
    processes = [subprocess.Popen([*module, "--no-dashboard", "--scheduler-file", file], **quiet)]  # type: ignore[call-overload]
    try:
        while not (file.exists() and file.read_text().endswith("}")):
            time.sleep(0.1)
        address = json.loads(file.read_text())["address"]
        module = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1"]
        where = ["--no-dashboard", "--local-directory", str(bench.folder)]
        processes += [subprocess.Popen([*module, *where], **quiet) for _ in range(2)]  # type: ignore[call-overload]
        yield address
    finally:
        for process in processes:
            process.kill()
            process.wait()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=5, help="of each of 64 good and 16 bad optimizers")
    parser.add_argument("--kills", type=int, default=50, help="of the runner")
    parser.add_argument("--worker-kills", type=int, default=20)
    parser.add_argument("--budget", type=int, default=36000, help="evaluations of a trial")
    parser.add_argument("--dask", action="store_true", help="the bad trials on Dask distributed, too")
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(Path(name), variants=8, trials=told.trials, budget=told.budget, timeout=6.0)
        try:
            print(bad_trials(bench), flush=True)
            if told.kills:
                print(runner_kills(bench, told.kills, longest=8.0), flush=True)
            if told.worker_kills:
                print(worker_kills(bench, told.worker_kills, longest=4.0), flush=True)
            if told.dask:
                for results in ("good", "both"):
                    (bench.folder / results).rename(bench.folder / f"{results}-local")
                with dask(bench) as address:
                    print("on Dask:", bad_trials(bench, "--scheduler", address))
                same = bench.table("good").equals(bench.table("good-local"))
                expect(same, "other bits on Dask")
        except Failed as failed:
            sys.exit(str(failed))


if __name__ == "__main__":
    main()
