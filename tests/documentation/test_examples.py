"""The examples run as they stand: scripts in a folder of their own, the notebook cell by cell."""

import os
import re
import subprocess
import sys

import nbformat
import pytest
from nbclient import NotebookClient

from tests.conftest import ROOT

EXAMPLES = ROOT / "examples"
SAYS = {
    "fit_a_file.py": r"Two searches from other starts agree",
    "diagnose_a_file.py": r"effect-found .* The model lacks input-lag",
    "write_an_optimizer.py": r"halving-search +0\.0",
    "write_an_effect.py": (
        r"bouc-wen +leaves [0-9.]+ times.*\nbouc-wen and pressure-sensitivity +leaves 1.*\n"
        r"The model lacks pressure-sensitivity:"
    ),
}
"""What each script must tell, as a pattern."""

SHORTEST, LONGEST = 20, 40
"""Lines of an example."""


@pytest.fixture(scope="session")
def environment(tmp_path_factory) -> dict[str, str]:
    """Where the examples' own distribution is installed as anyone's would be."""
    folder = tmp_path_factory.mktemp("installed")
    offline = ("--no-deps", "--no-index", "--no-build-isolation", "--disable-pip-version-check")
    subprocess.run(
        [sys.executable, "-m", "pip", "install", "--quiet", *offline, "--target", folder, EXAMPLES], check=True
    )
    return {**os.environ, "PYTHONPATH": str(folder), "MPLBACKEND": "agg"}


def test_every_script_is_run():
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(SAYS)


@pytest.mark.parametrize("name", SAYS)
def test_a_script_runs_and_tells(name, environment, tmp_path):
    done = subprocess.run(
        [sys.executable, EXAMPLES / name], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert re.search(SAYS[name], done.stdout), done.stdout


@pytest.mark.parametrize("name", SAYS)
def test_a_script_can_be_read_at_a_glance(name):
    assert SHORTEST <= len((EXAMPLES / name).read_text(encoding="utf-8").splitlines()) <= LONGEST


@pytest.mark.long
def test_the_notebook_runs_and_holds_no_outputs(tmp_path, environment, monkeypatch):
    for name in ("PYTHONPATH", "MPLBACKEND"):
        monkeypatch.setenv(name, environment[name])
    (path,) = EXAMPLES.glob("*.ipynb")
    notebook = nbformat.read(path, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    told = "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", []))
    assert "The model lacks" in told
    assert "RMSE on mixed" in told
