"""A study that goes on in a folder in which something is damaged, or whose data come from elsewhere."""

import json
import shutil

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.errors import UserError
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.provenance import UNCHECKED
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, STUDY, TRIALS, read_results
from hysteresis_bench.study.run import run_study
from hysteresis_bench.study.store import FILE
from hysteresis_bench.study.study_file import ProblemSpec

TEXT = """
title = "t"
seed = 1
trials = 1
budget = 5
published = "t.published.toml"
[[problem]]
name = "p"
model = "hammerstein"
data = ["here.csv", "../elsewhere/there.csv"]
[[optimizer]]
plugin = "random-search"
"""


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """A folder with a study, its data in two units and two places, and its results."""
    home = tmp_path_factory.mktemp("home")
    time = np.linspace(0.0, 1.0, 40)
    for folder, name, unit, scale in (("study", "here", "V", 1.0), ("elsewhere", "there", "mV", 1e3)):
        (home / folder).mkdir()
        columns = {"time [s]": time, f"input [{unit}]": scale * np.sin(9 * time), "output [um]": np.cos(9 * time)}
        pd.DataFrame(columns).to_csv(home / folder / f"{name}.csv", index=False)
    (home / "study" / "t.published.toml").write_text('citation = "a paper"\n', encoding="utf-8")
    (home / "study" / "t.toml").write_text(TEXT, encoding="utf-8")
    said = []
    run_study(home / "study" / "t.toml", jobs=1, out=home / "out", on_progress=said.append)
    return home, said[0].notes


@pytest.fixture
def again(ran, tmp_path):
    """Continue the study in a copy of its results, in which `damage` changed something; returns the notes."""
    home, _ = ran
    shutil.copytree(home, tmp_path / "home")
    out = tmp_path / "home" / "out"

    def run(damage):
        damage(out)
        said = []
        run_study(tmp_path / "home" / "study" / "t.toml", jobs=1, out=out, on_progress=said.append)
        pd.testing.assert_frame_equal(pd.read_csv(out / TRIALS), pd.read_csv(home / "out" / TRIALS))
        return out, said[0].notes

    return run


def test_what_was_converted_and_what_lies_elsewhere_is_told_before_the_first_trial(ran):
    home, notes = ran
    converted, elsewhere = notes
    assert converted == "../elsewhere/there.csv: input [mV] was converted to V."
    where = (home / "elsewhere" / "there.csv").resolve()
    assert elsewhere.startswith(f'data "../elsewhere/there.csv" lie outside the study\'s folder: {where} is read')
    assert read_results(home / "out").provenance["notes"] == list(notes)


def test_the_command_prints_them_once(ran):
    home, notes = ran
    said = CliRunner().invoke(main, ["run", str(home / "study" / "t.toml"), "--out", str(home / "out")]).output
    flat = " ".join(said.split())
    assert [flat.count(note) for note in notes] == [1, 1]
    assert "was converted to V" in (home / "out" / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("text", ["", "[1, 2]", '{"optimizers": {"random-search": 1}}', "\x00junk"])
def test_a_damaged_provenance_is_written_anew_and_told_from_then_on(again, text):
    out, notes = again(lambda folder: (folder / PROVENANCE).write_text(text, encoding="utf-8"))
    assert any(UNCHECKED in note for note in notes)
    kept = json.loads((out / PROVENANCE).read_text(encoding="utf-8"))
    assert set(kept["optimizers"]) == {"random-search"}
    said = []
    run_study(out.parent / "study" / "t.toml", jobs=1, out=out, on_progress=said.append)
    assert any(UNCHECKED in note for note in said[0].notes)


@pytest.mark.parametrize("damage", [lambda path: path.write_text("title = "), lambda path: path.unlink()])
def test_a_damaged_study_file_is_written_anew_where_it_is_the_same_study(again, damage):
    out, notes = again(lambda folder: damage(folder / STUDY))
    assert (out / STUDY).read_text(encoding="utf-8") == TEXT
    assert any(f"{STUDY} of the results could not be read" in note for note in notes)


def test_another_study_is_refused_there(again):
    def another(folder):
        (folder / STUDY).unlink()
        study = folder.parent / "study" / "t.toml"
        study.write_text(TEXT.replace("seed = 1", "seed = 2"), encoding="utf-8")

    with pytest.raises(UserError, match="seed was 1 there and is 2 here"):
        again(another)


def test_without_both_there_is_a_sentence(again):
    def damage(folder):
        (folder / PROVENANCE).unlink()
        (folder / STUDY).write_text("title = ", encoding="utf-8")

    with pytest.raises(UserError, match="is not valid TOML"):
        again(damage)


@pytest.mark.parametrize("content", [b"junk" * 999, b"SQLite format 3\x00" + b"\x01" * 5000])
def test_damaged_trials_are_not_run_over(again, content):
    with pytest.raises(UserError, match=r"is damaged .* Move it elsewhere"):
        again(lambda folder: (folder / FILE).write_bytes(content))


def test_a_published_file_that_is_a_link_to_elsewhere_is_not_copied(again):
    def link(folder):
        published = folder.parent / "study" / "t.published.toml"
        published.unlink()
        published.symlink_to(folder.parent / "elsewhere" / "there.csv")
        (folder / PUBLISHED).unlink()

    with pytest.raises(UserError, match="is a link to"):
        again(link)


def test_skipping_all_of_a_record_is_told(ran):
    spec = ProblemSpec(name="p", model="hammerstein", data=["here.csv"], skip="10 s")
    with pytest.raises(UserError, match=r'problem "p": record here: skipping 10 s leaves nothing'):
        build_problem(spec, 1, ran[0] / "study")
