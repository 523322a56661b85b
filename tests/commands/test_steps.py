"""Progress: a line within 5 s and at least every 10 s in a pipe; Ctrl-C ends cleanly and says what is kept."""

import io
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from rich.console import Console

from hysteresis_bench import FitOptions, fit
from hysteresis_bench.commands.terminal import steps
from hysteresis_bench.progress import Step
from hysteresis_bench.signals import Dataset
from tests.conftest import ROOT, record

SLOW = """
import signal, sys, time
from hysteresis_bench import registry
from hysteresis_bench.cli import main
from hysteresis_bench.fit.objective import Problem

for name in ("losses", "residuals"):
    def slowly(self, points, known=getattr(Problem, name)):
        time.sleep(0.2)
        return known(self, points)
    setattr(Problem, name, slowly)
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background inherits that it is ignored
main(sys.argv[1:])
"""


@pytest.fixture
def data(tmp_path):
    time_, phase = np.arange(60) / 10.0, np.arange(60) / 5.0
    rows = zip(time_, np.sin(phase), np.sin(phase) ** 3 + 0.1 * np.sin(phase), strict=True)
    lines = [",".join(f"{value:.5f}" for value in row) for row in rows]
    (tmp_path / "loop.csv").write_text("time,input,output\n" + "\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path


@pytest.mark.long
def test_slow_plugins_in_a_pipe(data):
    """Two commands side by side, as they mostly wait: watched for 12 s, then stopped as by Ctrl-C."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUNBUFFERED": "1"}
    commands, since = ("fit", "diagnose"), time.monotonic()
    running, seen = {}, {command: [] for command in commands}
    for command in commands:
        arguments = [sys.executable, "-c", SLOW, command, "loop.csv", "--model", "bouc-wen"]
        with open(data / command, "w", encoding="utf-8") as out:
            running[command] = subprocess.Popen(
                arguments, cwd=data, env=environment, stdout=out, stderr=out, start_new_session=True
            )
    while time.monotonic() - since < 60.0 and min(map(len, seen.values())) < 3:
        time.sleep(0.1)
        for command, times in seen.items():
            lines = (data / command).read_text(encoding="utf-8").count(f"{command}: ")
            times += [time.monotonic()] * (lines - len(times))
    for one in running.values():
        os.killpg(one.pid, signal.SIGINT)
    for command, one in running.items():
        assert one.wait(30) == 130
        text = (data / command).read_text(encoding="utf-8")
        assert len(seen[command]) >= 3, text
        assert np.all(np.diff(seen[command]) < 10.0)
        assert int(re.search(r"(\d+) s since the beginning", text)[1]) <= 5
        assert "stopped by SIGINT; nothing was written to" in " ".join(text.split())
        assert "Traceback" not in text
    assert not (data / "loop-fit").exists()


def test_the_first_line_comes_soon(monkeypatch):
    said = io.StringIO()
    monkeypatch.setattr(steps, "FIRST", 0.05)
    with steps.steps_told("fit", Console(file=said)) as on_step:
        on_step(Step("search 1 of 2", 30, 100))
        time.sleep(0.3)
    assert "fit: search 1 of 2, 30 % of 100" in said.getvalue()
    assert "left of this step" in " ".join(said.getvalue().split())


def test_a_terminal_has_a_bar():
    said = io.StringIO()
    with steps.steps_told("fit", Console(file=said, force_terminal=True, width=100)) as on_step:
        on_step(Step("search 1 of 2", 30, 100))
        on_step(Step("search 2 of 2", 99, 100))
    assert "search 2 of 2" in said.getvalue()


def test_what_a_fit_tells():
    told = []
    fit(Dataset((record(120),)), "polynomial", options=FitOptions(budget=200, on_step=told.append))
    names = list(dict.fromkeys(step.what for step in told))
    assert names[0] == "search 1 of 2"
    assert names[-1] == "what the data determine"
    assert told[0].total == 200
    assert max(step.done for step in told) > 0


@pytest.mark.parametrize(("seconds", "words"), [(4.2, "4 s"), (200.0, "3 min 20 s"), (7500.0, "2 h 5 min")])
def test_a_duration(seconds, words):
    assert steps.clock(seconds) == words
