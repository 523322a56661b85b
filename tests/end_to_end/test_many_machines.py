"""A study in parts and on a cluster gives the bits of one machine, and loses nothing where a machine is lost."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from tests.end_to_end.test_run import COMMAND, ENVIRONMENT, run_command, write_study
from tests.study.test_pool import descendants

OPTIMIZERS = ["pso", "mpso", "random-search"]


def trials(folder) -> pd.DataFrame:
    return pd.read_csv(folder / "trials.csv").drop(columns="seconds")


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The study, and its results of one machine."""
    study = write_study(tmp_path_factory.mktemp("alone"), OPTIMIZERS)
    assert run_command("run", study, "--jobs", 1, "--out", study.parent / "whole").returncode == 0
    return study, study.parent / "whole"


@pytest.mark.long
def test_shards_put_together_are_the_study(alone, tmp_path):
    study, whole = alone
    parts = [tmp_path / f"part{number}" for number in (1, 2)]
    for number, part in enumerate(parts, 1):
        done = run_command("run", study, "--shard", f"{number}/2", "--out", part)
        assert done.returncode == 0, done.stderr
        assert len(trials(part)) == 3
        assert not (part / "report.html").exists()
    done = run_command("merge", *parts, "--out", tmp_path / "merged")
    assert "6 trials of 2 folders are together" in done.stdout, done.stderr
    before = (tmp_path / "merged" / "trials.sqlite").read_bytes()
    assert run_command("run", study, "--out", tmp_path / "merged").returncode == 0
    pd.testing.assert_frame_equal(trials(tmp_path / "merged"), trials(whole), check_exact=True)
    assert (tmp_path / "merged" / "trials.sqlite").stat().st_size == len(before), "a trial was run again"
    assert (tmp_path / "merged" / "report.html").is_file()


def test_what_cannot_be_merged_is_told(alone, tmp_path):
    study, whole = alone
    other = tmp_path / "other.toml"
    other.write_text(study.read_text(encoding="utf-8").replace("seed = 7", "seed = 8"), encoding="utf-8")
    (tmp_path / "cubic.csv").write_bytes((study.parent / "cubic.csv").read_bytes())
    assert run_command("run", other, "--shard", "1/6", "--out", tmp_path / "part").returncode == 0
    for folders, told in (
        ([whole, tmp_path / "part"], "seed was 7 there and is 8 here"),
        ([whole, tmp_path], "holds no study"),
    ):
        done = run_command("merge", *folders, "--out", tmp_path / "merged")
        assert done.returncode == 2
        assert told in done.stderr
        assert not (tmp_path / "merged").exists()
    assert "exists already" in run_command("merge", whole, "--out", tmp_path / "part").stderr
    assert "no part of a whole" in run_command("run", study, "--shard", "3/2").stderr


def stored(folder) -> int:
    """Trials in the store of a run that goes on."""
    try:
        with sqlite3.connect(f"file:{folder / 'trials.sqlite'}?mode=ro", uri=True) as connection:
            return connection.execute("SELECT COUNT(*) FROM trials").fetchone()[0]
    except sqlite3.Error:
        return 0


def wait_for(condition, seconds: float = 90.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert condition()


@pytest.mark.long
def test_a_dask_worker_killed_in_the_middle_loses_nothing(tmp_path):
    pytest.importorskip("distributed", reason="Dask distributed is not installed")
    study = write_study(tmp_path, OPTIMIZERS, budget=6000)
    file, out = tmp_path / "scheduler.json", tmp_path / "cluster"
    quiet = {"stderr": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "env": ENVIRONMENT}
    module = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    processes = [subprocess.Popen([*module, "--no-dashboard", "--scheduler-file", file], **quiet)]
    try:
        wait_for(lambda: file.exists() and file.read_text().endswith("}"))
        address = json.loads(file.read_text())["address"]
        module = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1"]
        where = ["--no-dashboard", "--local-directory", tmp_path]
        processes += [subprocess.Popen([*module, *where], **quiet) for _ in range(2)]
        command = [*COMMAND, "run", study, "--trials", "12", "--scheduler", address, "--out", out]
        running = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_for(lambda: stored(out) > 3)
        children = descendants(processes[1].pid)
        processes[1].kill()
        assert stored(out) < 36
        output, errors = running.communicate(timeout=200)
        assert running.returncode == 0, output + errors
    finally:
        for process in processes:
            process.kill()
            process.wait()
    assert children, "at least the template that its trials are forked from"
    wait_for(lambda: not any(Path(f"/proc/{child}").exists() for child in children), 10.0)
    assert run_command("run", study, "--trials", 12, "--out", tmp_path / "alone").returncode == 0
    pd.testing.assert_frame_equal(trials(out), trials(tmp_path / "alone"), check_exact=True)


def test_no_scheduler_is_told(alone):
    pytest.importorskip("distributed", reason="Dask distributed is not installed")
    study, _ = alone
    done = run_command("run", study, "--scheduler", "nowhere", "--out", study.parent / "none")
    assert done.returncode == 2
    assert "no scheduler answers at nowhere" in done.stderr


def test_sigterm_says_what_is_kept_and_ends_the_workers(tmp_path):
    study = write_study(tmp_path, ["random-search", "faulty-hangs"])
    command = [*COMMAND, "run", str(study), "--jobs", "1", "--out", str(tmp_path / "out")]
    running = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    wait_for(lambda: stored(tmp_path / "out") > 0)
    os.kill(running.pid, signal.SIGTERM)
    _, told = running.communicate(timeout=60)
    assert running.returncode == 143, told
    assert "stopped by SIGTERM; 1 of 4 trials are kept" in told
    assert "Traceback" not in told
