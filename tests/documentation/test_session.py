"""The README's session: from the built wheel in an empty folder to a diagnosis page, with the output that it shows."""

import os
import subprocess
import sys

import pytest

from tests.conftest import ROOT
from tests.documentation.blocks import blocks, commands, fill

SESSION = next(block for block in blocks("console") if "pip install" in block.text)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*command, "--quiet", "--wheel-dir", folder, ROOT], check=True)
    return next(folder.glob("*.whl"))


@pytest.mark.long
def test_the_session_ends_with_a_page(tmp_path, wheel):
    """Its first command installs the wheel; what it needs is there already. The kernels are the tests' own compiled
    ones, for the compiler's time: the wheel itself reads and checks the file."""
    fill(tmp_path)
    install, check, *rest = commands(SESSION)
    assert len(rest) == 2
    site = tmp_path / "site"
    assert install == "pip install hysteresis-bench"
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", site, wheel]
    subprocess.run(command, check=True)
    environment = {**os.environ, "COLUMNS": "100", "PYTHONPATH": str(site), "MPLBACKEND": "agg"}
    said = ""
    for line in (check, *rest):
        if line is not check:
            environment["PYTHONPATH"] = str(ROOT)
        options = {"cwd": tmp_path, "env": environment, "capture_output": True, "text": True, "timeout": 300}
        done = subprocess.run([sys.executable, "-m", "hysteresis_bench", *line.split()[1:]], **options)
        assert done.returncode == 0, done.stderr
        said += done.stdout
    lines = [line.rstrip() for line in said.splitlines()]
    shown = [line.rstrip() for line in SESSION.text.splitlines() if not line.startswith("$ ")]
    assert [line for line in shown if line not in lines] == []
    assert (tmp_path / "scope-diagnosis" / "diagnosis.html").is_file()
