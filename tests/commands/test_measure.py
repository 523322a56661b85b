"""`diagnose --measure`: what is refused before anything is fitted, and where there is nothing to measure."""

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A curve without memory, which no effect improves."""
    monkeypatch.chdir(tmp_path)
    t = np.arange(200) / 50.0
    u = np.sin(2 * np.pi * t)
    y = u + 0.2 * u**3 + 0.01 * np.random.default_rng(0).standard_normal(200)
    lines = [",".join(f"{value:.6f}" for value in row) for row in zip(t, u, y, strict=True)]
    (tmp_path / "loop.csv").write_text("time [s],input [V],output [um]\n" + "\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("rig", "more", "sentence"),
    [
        ("peaa", "", 'Did you mean "pea"?'),
        ("pea-known-truth", "", "rig pea-known-truth cannot play a drive of our own. These can:"),
        ("pea", "--settle", "--settle and --skip are for records that do not begin at rest"),
        ("gma", "", "input is in V in the records and in A on the rig gma."),
    ],
)
def test_what_cannot_be_measured_is_refused_before_anything_is_fitted(here, rig, more, sentence):
    asked = ["diagnose", "loop.csv", "--model", "polynomial", "--measure", rig, *more.split()]
    result = CliRunner().invoke(main, asked)
    assert result.exit_code == 2
    assert sentence in " ".join(result.output.split())
    assert [path.name for path in here.iterdir()] == ["loop.csv"]


def test_where_nothing_is_tied_it_says_so_and_measures_nothing(here):
    result = CliRunner().invoke(
        main, ["diagnose", "loop.csv", "--model", "polynomial", "--jobs", "1", "--measure", "pea", "--out", "d"]
    )
    assert result.exit_code == 0, result.output
    assert "There is no tie" in " ".join(result.output.split())
    assert [path.name for path in (here / "d").glob("*.csv")] == ["responses.csv"]
    assert '"measured": null' in (here / "d" / "diagnosis.json").read_text(encoding="utf-8")
