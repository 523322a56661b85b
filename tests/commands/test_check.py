"""`check`: the table, the picture, the warnings; JSON; a plain copy; a figure for a paper."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import load
from hysteresis_bench.cli import main
from hysteresis_bench.commands.terminal.loop import drawn

LINES = [f"{i / 10:.1f};{np.sin(i / 3):.6f};{np.sin(i / 3 - 0.2):.6f}".replace(".", ",") for i in range(60)]
ROLES = ("--time", "Zeit", "--input", "Spannung", "--output", "Weg")


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scope.csv").write_text("Zeit (s);Spannung (V);Weg (um)\n" + "\n".join(LINES), encoding="utf-8")
    return tmp_path


def told(*arguments, code=0):
    done = CliRunner().invoke(main, ["check", *map(str, arguments)])
    assert done.exit_code == code, done.output
    return done.output


def test_columns_that_are_not_named_are_asked_for(here):
    said = told("scope.csv", code=2)
    assert "Say which it is with --time NAME" in said
    assert "--input NAME" in said


def test_table_picture_and_warnings(here):
    said = told("scope.csv", *ROLES)
    assert "Spannung" in said
    assert "semicolons between cells, decimal commas" in said
    assert "⣀" in said
    assert "one frequency only" in said


def test_json_copy_and_figure(here):
    content = json.loads(told("scope.csv", *ROLES, "--json", "--out", "plain.csv", "--plot", "loop.pdf"))
    assert content["records"][0]["rate"] == "10 Hz"
    assert content["warnings"]
    assert load("plain.csv").records[0].units["output"] == "um"
    assert (here / "loop.pdf").read_bytes().startswith(b"%PDF")
    assert "a figure is one of" in told("scope.csv", *ROLES, "--plot", "loop.bmp", code=2)
    assert "is there already" in told("scope.csv", *ROLES, "--plot", "loop.pdf", code=2)


def test_a_missing_output_is_told(here):
    assert "--output NAME says which it is" in told("scope.csv", *ROLES[:4])


def test_stopped_while_it_reads_it_ends_with_a_sentence(here, monkeypatch):
    def stopped(*arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr("hysteresis_bench.data.data_files._records", stopped)
    assert "stopped by SIGINT; what it has told of is kept" in " ".join(told("scope.csv", code=130).split())


def test_a_line_is_drawn_from_corner_to_corner():
    rows = drawn([(np.arange(5.0), np.arange(5.0))], width=6, height=3).splitlines()
    assert [len(row) for row in rows] == [6, 6, 6]
    assert rows[0][-1] != "⠀"
    assert rows[0][0] == "⠀"
    assert rows[-1][0] != "⠀"
