"""Results folders that a full disk, a kill or a careless hand has damaged: read as far as they go, or a sentence."""

import json
import shutil
import sqlite3
from pathlib import Path

import pandas as pd
import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.report.study import FROM_TABLES, write_report
from hysteresis_bench.study.results import (
    IDENTIFIABILITY,
    PROVENANCE,
    PUBLISHED,
    REPORT,
    RESPONSES,
    STUDY,
    TRIALS,
    read_results,
)
from hysteresis_bench.study.store import FILE
from tests.synthetic_study import write_results

HOW = {
    "cut": lambda path: path.write_bytes(path.read_bytes()[: path.stat().st_size // 2]),
    "flipped": lambda path: path.write_bytes(bytes(255 - byte for byte in path.read_bytes())),
    "empty": lambda path: path.write_bytes(b""),
    "junk": lambda path: path.write_bytes(b"\x00\xff[{]}" * 50),
    "gone": lambda path: path.unlink(),
    "text": lambda path: path.write_text("[1, 2]\n", encoding="utf-8"),
}
FILES = (STUDY, PUBLISHED, PROVENANCE, TRIALS, RESPONSES, IDENTIFIABILITY, FILE)


@pytest.fixture(scope="module")
def sound(tmp_path_factory) -> Path:
    return write_results(tmp_path_factory.mktemp("sound"), trials=2)


@pytest.fixture
def folder(sound, tmp_path) -> Path:
    """A copy of one's own, to be damaged."""
    return Path(shutil.copytree(sound, tmp_path / "results"))


@pytest.mark.parametrize("how", sorted(HOW))
@pytest.mark.parametrize("file", FILES)
def test_any_damage_is_left_out_or_told(folder, file, how):
    HOW[how](folder / file)
    if file == STUDY:
        with pytest.raises(UserError):
            read_results(folder)
        return
    results = read_results(folder)
    assert len(results.trials) == 32
    if file not in (TRIALS, FILE) and how != "gone":
        assert any(file in said for said in results.damages) or (file, how) == (PUBLISHED, "empty")
    if file == FILE:
        assert any(FILE in said for said in results.damages)
        assert not results.traces


def test_without_the_store_and_the_table_there_are_no_trials(folder):
    HOW["cut"](folder / FILE)
    HOW["junk"](folder / TRIALS)
    with pytest.raises(UserError, match="neither"):
        write_report(folder)


def test_reading_changes_nothing(folder):
    (folder / FILE).unlink()
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    read_results(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_kept_folder_without_its_store_is_reported_beside_its_page(folder):
    (folder / FILE).unlink()
    (folder / REPORT).write_text("kept", encoding="utf-8")
    page = write_report(folder)
    assert page.name == FROM_TABLES
    assert (folder / REPORT).read_text(encoding="utf-8") == "kept"
    assert "The course of the searches is not kept here" in page.read_text(encoding="utf-8")


def test_a_page_is_written_without_what_is_damaged(folder):
    files = (RESPONSES, IDENTIFIABILITY, PROVENANCE)
    for file in files:
        HOW["junk"](folder / file)
    page = write_report(folder).read_text(encoding="utf-8")
    assert [file for file in files if f"{file} is damaged" not in page] == []


def test_a_section_is_left_out_and_said_where_an_object_holds_what_nobody_wrote(folder):
    whole = json.loads((folder / IDENTIFIABILITY).read_text(encoding="utf-8"))
    whole[next(iter(whole))]["names"] = 3
    (folder / IDENTIFIABILITY).write_text(json.dumps(whole), encoding="utf-8")
    assert "A section is left out" in write_report(folder).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "change",
    [
        "SET fitness = 'x'", "SET fitness = NULL WHERE status = 'done'", "SET status = 'fine'", "SET rmse = 9e999",
        "SET problem = x'00ff'", "SET parameters = '[1]'", "SET origin = 'x'", "SET trace = x'504b'",
    ],
)  # fmt: skip
def test_a_row_that_no_trial_has_left_is_told(folder, change):
    with sqlite3.connect(folder / FILE) as store:
        store.execute(f"UPDATE trials {change}" + (" WHERE rowid = 1" if "WHERE" not in change else ""))
    store.close()
    results = read_results(folder)
    assert any(FILE in said for said in results.damages)
    assert len(results.trials) == 32


@pytest.mark.parametrize("cell", ["nan", "x", "inf", "", "1e999"])
def test_a_cell_that_is_no_result_is_told(folder, cell):
    (folder / FILE).unlink()
    table = pd.read_csv(folder / TRIALS, dtype=str)
    table.loc[table["status"] == "done", "fitness"] = cell
    table.to_csv(folder / TRIALS, index=False)
    assert any(f"{TRIALS} is damaged" in said for said in read_results(folder).damages)


def test_a_page_that_is_a_link_is_not_followed(folder, tmp_path):
    elsewhere = tmp_path / "elsewhere.html"
    elsewhere.write_text("mine", encoding="utf-8")
    (folder / REPORT).symlink_to(elsewhere)
    with pytest.raises(UserError, match="is a link"):
        write_report(folder)
    assert elsewhere.read_text(encoding="utf-8") == "mine"
