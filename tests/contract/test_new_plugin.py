"""What `new-plugin` writes is a plugin of its kind that passes its own test at once."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.testing.scaffold.write import files

NAMES = {"optimizer": "quick-search", "model": "dry-friction", "effect": "charge-leak", "rig": "record"}


def new_plugin(*arguments: object):
    return CliRunner().invoke(main, ["new-plugin", *map(str, arguments)])


@pytest.fixture(scope="module")
def written(tmp_path_factory) -> dict[str, Path]:
    """A folder a kind, found by importlib.metadata as if it were installed."""
    folders = {}
    for kind, name in NAMES.items():
        folder = tmp_path_factory.mktemp(kind) / "new"
        done = new_plugin(kind, name, "--out", folder)
        assert done.exit_code == 0, done.output
        project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
        information = folder / f"{project['name'].replace('-', '_')}-0.1.0.dist-info"
        information.mkdir()
        (information / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: 0.1.0\n")
        points = [
            f"[{group}]\n" + "\n".join(f"{key} = {value}" for key, value in named.items())
            for group, named in project["entry-points"].items()
        ]
        (information / "entry_points.txt").write_text("\n".join(points))
        folders[kind] = folder
    return folders


def test_its_test_passes_at_once(written):
    search = os.pathsep.join(map(str, written.values()))
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--import-mode=importlib", *written.values()],
        env={**os.environ, "PYTHONPATH": search},
        cwd=written["rig"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    assert int(done.stdout.rpartition(" passed")[0].split()[-1]) > 50


def test_it_is_documented_and_clean(written):
    for kind, folder in written.items():
        written_by_us = [path for path in folder.iterdir() if path.name != "__pycache__"]
        assert {path.suffix for path in written_by_us} == {".toml", ".md", ".py", ".dist-info"}
        assert len((folder / "README.md").read_text().splitlines()) <= 12
        assert "Example" not in "".join(path.read_text() for path in folder.glob("*.py")), kind
        assert "$" not in "".join(path.read_text() for path in folder.iterdir() if path.is_file()), kind
        lint = [Path(sys.executable).with_name("ruff"), "check", "--isolated", "--line-length", "120", folder]
        assert subprocess.run(lint, capture_output=True).returncode == 0


def test_a_class_does_not_take_the_name_of_what_it_imports():
    assert "class RecordRig(Rig)" in files("rigs", "record")["hysteresis_bench_record.py"]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["optimizer", "Quick_Search"], "lower-case letters and digits"),
        (["optimizer", "../elsewhere"], "lower-case letters and digits"),
        (["optimizer", "pso"], 'already has the optimizer "pso"'),
        (["optimiser", "quick"], "optimiser"),
    ],
)
def test_names_that_cannot_be_are_told(arguments, told, tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "hysteresis_bench", "new-plugin", *arguments],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert told in " ".join(done.stderr.split())
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "mine.py").write_text("precious")
    assert new_plugin("rig", "mine", "--out", tmp_path).exit_code == 2
    assert new_plugin("rig", "mine", "--out", tmp_path / "mine.py").exit_code == 2
    assert [path.name for path in tmp_path.iterdir()] == ["mine.py"]
