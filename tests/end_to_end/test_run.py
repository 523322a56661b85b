"""A study from the command line: faults, failures, killing and continuing."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from tests.conftest import PLUGINS
from tests.study.test_pool import descendants

COMMAND = [sys.executable, "-m", "hysteresis_bench"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(PLUGINS), "COLUMNS": "140"}

HEAD = """
title = "A cubic, many optimizers"
seed = 7
trials = 2
budget = {budget}
timeout = "{timeout}"
[[problem]]
name = "cubic"
model = "polynomial"
data = ["cubic.csv"]
"""


def run_command(*arguments: object, **more) -> subprocess.CompletedProcess:
    return subprocess.run([*COMMAND, *map(str, arguments)], env=ENVIRONMENT, capture_output=True, text=True, **more)


def run_here(*arguments: object) -> subprocess.CompletedProcess:
    """The same in this process, where nothing asks for one of its own: that takes seconds to begin."""
    done = CliRunner(env={"COLUMNS": "140"}).invoke(main, [*map(str, arguments)])
    if done.exception and not isinstance(done.exception, SystemExit):
        raise done.exception
    return subprocess.CompletedProcess(arguments, done.exit_code, done.stdout, done.stderr)


def write_study(folder: Path, optimizers: list[str], budget: int = 300, timeout: str = "5 min") -> Path:
    time_ = np.linspace(0, 1, 50)
    drive = np.sin(2 * np.pi * time_)
    noise = 0.01 * np.random.default_rng(0).standard_normal(50)
    frame = pd.DataFrame({"time": time_, "input": drive, "output": drive + 0.5 * drive**3 + noise})
    frame.to_csv(folder / "cubic.csv", index=False)
    text = HEAD.format(budget=budget, timeout=timeout)
    text += "".join(f'[[optimizer]]\nplugin = "{name}"\n' for name in optimizers)
    path = folder / "cubic.toml"
    path.write_text(text, encoding="utf-8")
    return path


def trials(folder: Path) -> pd.DataFrame:
    return pd.read_csv(folder / "runs" / "cubic" / "trials.csv")


@pytest.fixture(scope="module")
def finished(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("finished")
    study = write_study(folder, ["pso", "mpso", "random-search", "scipy-least-squares"])
    done = run_command("run", study, "--jobs", 2)
    assert done.returncode == 0, done.stderr
    assert "report:" in done.stdout
    return folder


def test_a_finished_study_leaves_what_it_should(finished):
    folder = finished / "runs" / "cubic"
    for name in ("study.toml", "provenance.json", "trials.sqlite", "trials.csv", "summary.csv", "report.html"):
        assert (folder / name).is_file(), name
    table = trials(finished)
    assert len(table) == 8
    assert set(table["status"]) == {"done"}
    assert set(table["evaluations"]) == {300}
    best = table.loc[table["fitness"].idxmin()]
    assert best["parameter.a"] == pytest.approx(1.0, abs=0.05)
    assert best["parameter.b"] == pytest.approx(0.5, abs=0.05)


def test_one_worker_or_two_give_the_same_bits(finished, tmp_path):
    study = write_study(tmp_path, ["pso", "mpso", "random-search", "scipy-least-squares"])
    assert run_command("run", study, "--jobs", 1).returncode == 0
    one, two = (trials(folder).drop(columns="seconds") for folder in (tmp_path, finished))
    pd.testing.assert_frame_equal(one, two, check_exact=True)


def test_more_trials_and_optimizers_continue_the_folder(finished, tmp_path):
    study = write_study(tmp_path, ["pso", "mpso"])
    assert run_command("run", study, "--trials", 1).returncode == 0
    before = trials(tmp_path)
    study = write_study(tmp_path, ["pso", "mpso", "random-search", "scipy-least-squares"])
    assert run_command("run", study).returncode == 0
    after = trials(tmp_path)
    assert len(after) == 8
    kept = after.merge(before, on=["problem", "optimizer", "trial"], suffixes=("", "_before"))
    assert (kept["seconds"] == kept["seconds_before"]).all(), "a finished trial was run again"
    pd.testing.assert_frame_equal(
        after.drop(columns="seconds"), trials(finished).drop(columns="seconds"), check_exact=True
    )


def test_killed_at_a_random_moment_and_run_again(finished, tmp_path):
    study = write_study(tmp_path, ["pso", "mpso", "random-search", "scipy-least-squares"])
    rng = np.random.default_rng()
    for _ in range(2):
        running = subprocess.Popen(
            [*COMMAND, "run", str(study), "--jobs", "2"],
            env=ENVIRONMENT,
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )
        time.sleep(float(rng.uniform(0.5, 6.0)))
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
    assert run_command("run", study).returncode == 0
    pd.testing.assert_frame_equal(
        trials(tmp_path).drop(columns="seconds"), trials(finished).drop(columns="seconds"), check_exact=True
    )


def test_every_failure_is_a_row_and_the_others_finish(tmp_path):
    faulty = ["raises", "returns", "empty", "outside", "hangs", "dies", "greedy", "stubborn"]
    study = write_study(tmp_path, [*(f"faulty-{name}" for name in faulty), "pso"], timeout="6 s")
    done = run_command("run", study, "--trials", 1, "--jobs", 2)
    assert done.returncode == 1, done.stderr
    table = trials(tmp_path).set_index("optimizer")
    expected = {
        "faulty-raises": ("raised", "ZeroDivisionError: the swarm has no diameter"),
        "faulty-returns": ("finished-early", "returned after 7 of 300 evaluations"),
        "faulty-empty": ("raised", "returned without evaluating"),
        "faulty-outside": ("raised", "OutsideBox"),
        "faulty-hangs": ("timed-out", "stopped after 6 s"),
        "faulty-dies": ("crashed", "exit code 7"),
        "faulty-greedy": ("out-of-memory", "memory"),
        "faulty-stubborn": ("done", ""),
        "pso": ("done", ""),
    }
    for name, (status, reason) in expected.items():
        assert table.loc[name, "status"] == status, (name, table.loc[name, "reason"])
        assert reason in str(table.loc[name, "reason"])
    assert table.loc["faulty-stubborn", "evaluations"] == 300
    assert "faulty-hangs" in done.stdout
    again = run_command("run", study, "--trials", 1)
    assert again.returncode == 1
    assert len(trials(tmp_path)) == len(table)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("seed = 7", "seed = 8"), "seed was 7 there and is 8 here"),
        (("budget = 300", "budget = 301"), "budget was 300"),
        (('name = "cubic"', 'name = "cube"'), "problems are not the same"),
        (('plugin = "pso"', 'plugin = "pso"\nsettings = { particles = 20 }'), "other settings there"),
    ],
)
def test_a_folder_of_another_study_is_refused(finished, change, told):
    study = finished / "other.toml"
    study.write_text((finished / "cubic.toml").read_text(encoding="utf-8").replace(*change), encoding="utf-8")
    done = run_here("run", study, "--out", finished / "runs" / "cubic")
    assert done.returncode == 2
    assert told in done.stderr


def test_a_folder_with_other_things_in_it_is_refused(tmp_path):
    study = write_study(tmp_path, ["pso"])
    done = run_command("run", study, "--out", tmp_path)
    assert done.returncode == 2
    assert "is not empty" in done.stderr


def test_changed_data_are_another_study(finished, tmp_path):
    study = write_study(tmp_path, ["pso"])
    assert run_here("run", study, "--trials", 1).returncode == 0
    with (tmp_path / "cubic.csv").open("a", encoding="utf-8") as file:
        file.write("2,0.5,0.6\n")
    done = run_here("run", study, "--trials", 1)
    assert done.returncode == 2
    assert "cubic.csv has changed" in done.stderr


@pytest.mark.parametrize("command", ["run", "diagnose"])
def test_workers_end_with_a_killed_parent(command, tmp_path):
    study = write_study(tmp_path, ["faulty-hangs"])
    commands = {
        "run": ["run", study, "--jobs", "2"],
        "diagnose": ["diagnose", tmp_path / "cubic.csv", "--model", "bouc-wen", "--jobs", "2", "--out", tmp_path / "d"],
    }
    arguments = [*COMMAND, *map(str, commands[command])]
    running = subprocess.Popen(arguments, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 90
    least = {"run": 3, "diagnose": 2}[command]  # the template of the workers, and two of these
    while len(workers := descendants(running.pid)) < least and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.1)
    assert len(workers) >= least
    running.kill()
    running.wait()
    while any(Path(f"/proc/{worker}").exists() for worker in workers) and time.monotonic() < deadline + 30:
        time.sleep(0.1)
    assert not any(Path(f"/proc/{worker}").exists() for worker in workers)
