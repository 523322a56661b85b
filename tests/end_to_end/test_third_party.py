"""Somebody else's distribution, with a dependency of its own: built, installed into a fresh environment, found,
checked, and run in a study."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import venv
from pathlib import Path

import pandas as pd
import pytest

from tests.conftest import ROOT

NEEDED = ("cmaes", "hatchling")
STUDY = """
title = "Somebody else's optimizer"
seed = 3
trials = 2
budget = 300
[[problem]]
name = "loop"
model = "bouc-wen"
rig = "pea-known-truth"
fitted = ["static-sine"]
[[optimizer]]
plugin = "bipop-cmaes"
[[optimizer]]
plugin = "random-search"
"""
missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
pytestmark = pytest.mark.skipif(bool(missing), reason=f"not installed: {', '.join(missing)} (the extra `test`)")


@pytest.fixture(scope="module")
def fresh(tmp_path_factory) -> Path:
    """The folder of programs of an environment with both wheels; other packages are borrowed, without a network."""
    folder = tmp_path_factory.mktemp("fresh")
    wheels = folder / "wheels"
    for source in (ROOT, ROOT / "plugins" / "hysteresis-bench-cmaes"):
        pip(sys.executable, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", wheels, source)
    venv.create(folder / "environment", with_pip=False, symlinks=True)
    programs = folder / "environment" / "bin"
    library = next((folder / "environment").glob("lib/python*/site-packages"))
    pip(sys.executable, "--python", programs / "python", "install", "--no-deps", "--no-index", *wheels.glob("*.whl"))
    borrowed = [path for path in sys.path if Path(path).name == "site-packages"]
    (library / "borrowed.pth").write_text("\n".join(borrowed) + "\n", encoding="utf-8")
    return programs


def pip(python: str, *arguments: object) -> None:
    done = subprocess.run(
        [python, "-m", "pip", "--disable-pip-version-check", "--quiet", *map(str, arguments)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr


def told(program: Path, *arguments: object, cwd: Path) -> str:
    """What a program of the fresh environment prints; the working tree is out of its sight."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}
    done = subprocess.run(
        [program, *map(str, arguments)],
        cwd=cwd,
        env={**environment, "COLUMNS": "160"},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return " ".join(done.stdout.split())


def test_it_is_found_beside_what_ships(fresh, tmp_path):
    listed = told(fresh / "hysteresis-bench", "list", "optimizers", cwd=tmp_path)
    assert "bipop-cmaes" in listed
    assert "hysteresis-bench-cmaes 0.1.0" in listed
    described = told(fresh / "hysteresis-bench", "list", "bipop-cmaes", cwd=tmp_path)
    assert "optimizer bipop-cmaes of hysteresis-bench-cmaes 0.1.0" in described
    assert f"source: {fresh.parent}" in described


def test_it_keeps_its_contract(fresh, tmp_path):
    assert "Every promise is kept." in told(fresh / "hysteresis-bench", "check-plugin", "bipop-cmaes", cwd=tmp_path)


@pytest.mark.long
def test_its_own_tests_pass(fresh, tmp_path):
    own = "test_hysteresis_bench_cmaes.py"
    (tmp_path / own).write_bytes((ROOT / "plugins" / "hysteresis-bench-cmaes" / own).read_bytes())
    assert " passed" in told(fresh / "python", "-m", "pytest", "-q", "-p", "no:cacheprovider", own, cwd=tmp_path)


@pytest.mark.long
def test_it_runs_in_a_study(fresh, tmp_path):
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    told(fresh / "hysteresis-bench", "run", "study.toml", "--jobs", 1, "--out", "results", cwd=tmp_path)
    rows = pd.read_csv(tmp_path / "results" / "trials.csv")
    assert set(rows["status"]) == {"done"}
    assert set(rows["evaluations"]) == {300}
    best = rows.groupby("optimizer")["fitness"].median()
    assert best["bipop-cmaes"] < best["random-search"]


def test_a_new_plugin_is_written_from_the_wheel(fresh, tmp_path):
    told(fresh / "hysteresis-bench", "new-plugin", "rig", "bolted-joint", cwd=tmp_path)
    written = {path.name for path in (tmp_path / "hysteresis-bench-bolted-joint").iterdir()}
    assert {"pyproject.toml", "README.md", "hysteresis_bench_bolted_joint.py"} < written
