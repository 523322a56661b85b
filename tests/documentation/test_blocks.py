"""What the README and the pages of the documentation show works: their blocks are run, or parsed."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from hysteresis_bench import load
from tests.conftest import ROOT
from tests.documentation.blocks import blocks, commands, entry_points, fill

KNOWN = {"console", "python", "toml", "csv", "sh", "py"}
"""Scripts for machines that a test does not have, such as a batch system, are `sh` and `py`: their form is checked."""
BIN = Path(sys.executable).parent


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    made = tmp_path_factory.mktemp("pages")
    fill(made)
    return made


def run(command: list[str] | str, folder: Path) -> None:
    environment = {**os.environ, "PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}", "MPLBACKEND": "agg"}
    options = {"cwd": folder, "env": environment, "capture_output": True, "text": True, "timeout": 300}
    done = subprocess.run(command, shell=isinstance(command, str), **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"


def test_every_block_has_a_language_that_is_tested():
    assert not [str(block) for block in blocks() if block.language not in KNOWN]


@pytest.mark.parametrize("block", [block for block in blocks("console") if "pip install" not in block.text], ids=str)
def test_commands_run(block, folder):
    """Those of the Makefile are asked only whether make knows them: they take minutes. test_session installs, and runs
    what stands beside."""
    said = commands(block)
    assert said, "a console block needs a line with a prompt"
    for command in said:
        if command.startswith("make "):
            run(f"make --dry-run {command.removeprefix('make ')}", ROOT)
        else:
            assert command.startswith("hysteresis-bench "), command
            run(command, folder)


@pytest.mark.parametrize("block", blocks("python"), ids=str)
def test_python_runs(block, folder):
    script = folder / f"{block.page.removesuffix('.md')}_{block.line}.py"
    script.write_text(block.text, encoding="utf-8")
    run([sys.executable, str(script)], folder)


@pytest.mark.parametrize("block", blocks("toml"), ids=str)
def test_toml_parses_and_names_what_is_defined(block):
    tomllib.loads(block.text)
    defined = "\n".join(one.text for one in blocks("python") if one.page == block.page)
    for target in entry_points(block).values():
        assert f"class {target.split(':')[1]}(" in defined


@pytest.mark.parametrize("block", blocks("csv"), ids=str)
def test_csv_is_read(block, tmp_path):
    path = tmp_path / "block.csv"
    path.write_text(block.text, encoding="utf-8")
    assert load(path).records[0].time.size > 1


@pytest.mark.parametrize("block", blocks("sh"), ids=str)
def test_scripts_for_other_machines_parse(block):
    done = subprocess.run(["bash", "-n"], input=block.text, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("block", blocks("py"), ids=str)
def test_programs_for_other_machines_parse(block):
    compile(block.text, str(block), "exec")
