"""A study of diagnosis: what is right, what is counted, and a small run from the command line."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from itertools import pairwise
from pathlib import Path

import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.diagnosis_study.case import Case, by_family, compared
from hysteresis_bench.diagnosis_study.confusion import BESIDE, NOTHING, confusion
from hysteresis_bench.diagnosis_study.results import CASES, FOLDER, STUDY, read_cases, write_tables
from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study, read_diagnosis_study
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.diagnosis_study.answer import Halves, answer_in_words
from hysteresis_bench.report.diagnosis_study.confused import confusion_blocks
from hysteresis_bench.report.diagnosis_study.page import answer, write_diagnosis_study_page
from hysteresis_bench.report.diagnosis_study.reliability import BINS, LEAST, reliability
from hysteresis_bench.report.diagnosis_study.settled import fates, settled_section, words
from hysteresis_bench.report.diagnosis_study.sure import sure_section, tone

STUDIES = Path(__file__).parents[2] / "studies"

EXTRA = {"extra": "drift"}

TEXT = """
kind = "diagnosis"
title = "Small"
seed = 1

[[bench]]
name = "clean"
rig = "hidden-effects"
settings = { model = "bouc-wen", noise = 0.01 }
vary = "draw"
model = "bouc-wen"
fitted = ["slow", "fast"]
held_out = ["mixed"]
fresh = ["stairs"]
"""


def test_cases_of_a_bench_begin_where_it_says(tmp_path):
    (file := tmp_path / "small.toml").write_text(TEXT + "share = 2\nfirst = 40\n", encoding="utf-8")
    (bench,) = read_diagnosis_study(file)[0].bench
    assert list(bench.numbers(3)) == [40, 41, 42, 43, 44, 45]


def test_every_hidden_effect_must_be_named_or_tied():
    assert compared(["creep", "drift"], ["drift", "creep"], {}) == (["creep", "drift"], [], [], [])
    assert compared(["transport-delay"], ["input-lag"], {"input-lag": {"transport-delay"}}) == (
        [],
        ["transport-delay"],
        [],
        [],
    )
    assert compared(["creep"], ["drift"], {"drift": set()}) == ([], [], ["creep"], ["drift"])
    assert compared([], ["drift"], {}) == ([], [], [], ["drift"])
    assert compared(["eddy-current|input-lag"], ["input-lag"], {}) == (["eddy-current|input-lag"], [], [], [])


def test_one_claim_stands_for_one_hidden_effect():
    rivals = {"input-lag": {"transport-delay", "output-lag"}}
    named, tied, missed, extra = compared(["transport-delay", "output-lag"], ["input-lag"], rivals)
    assert (named, tied, missed, extra) == ([], ["transport-delay"], ["output-lag"], [])


def test_a_claim_that_names_one_effect_does_not_stand_for_another():
    named, tied, missed, _ = compared(
        ["transport-delay", "input-lag"], ["input-lag"], {"input-lag": {"transport-delay"}}
    )
    assert (named, tied, missed) == (["input-lag"], [], ["transport-delay"])


def test_the_confusion_matrix_counts_cases():
    cases = [
        Case("a", "m", 0, "done", hidden="creep", claimed="creep", named="creep"),
        Case("a", "m", 1, "done", hidden="creep", claimed="drift", missed="creep", extra="drift"),
        Case("a", "m", 2, "done", hidden="creep", missed="creep"),
        Case("b", "m", 0, "done"),
        Case("b", "m", 1, "done", claimed="drift", extra="drift"),
        Case("b", "m", 2, "timed-out"),
    ]
    table = confusion(cases)
    assert table.at["creep", "creep"] == table.at["creep", "drift"] == table.at["creep", NOTHING] == 1
    assert table.at[NOTHING, NOTHING] == table.at[NOTHING, "drift"] == 1
    assert table.to_numpy().sum() == 5
    assert [case.right for case in cases] == [True, False, False, True, False, False]


def test_claims_beside_hidden_effects_are_told_from_claims_of_clean_data():
    cases = [
        Case("a", "m", 0, "done", hidden="creep", claimed="creep leakage", named="creep", extra="leakage"),
        Case("a", "m", 1, "done"),
    ]
    table = confusion(cases)
    assert table.at[BESIDE, "leakage"] == table.at[NOTHING, NOTHING] == 1
    assert table.loc[NOTHING].sum() == 1


def test_the_matrix_shows_what_was_confused_and_names_the_rest(tmp_path):
    cases = [
        Case("a", "m", 0, "done", hidden="creep", claimed="creep", named="creep"),
        Case("a", "m", 1, "done", hidden="drift", claimed="drift leakage", named="drift", extra="leakage"),
        Case("a", "m", 2, "done", hidden="drift bias", claimed="leakage", missed="drift bias", extra="leakage"),
        Case("a", "m", 3, "done", hidden="drift|bias", claimed="bias", named="drift|bias"),
        Case("a", "m", 4, "done"),
    ]
    heading, sound, figures, table = confusion_blocks(tmp_path, "known", "Here", cases)
    assert heading.text == "Here"
    assert (
        sound == "Always claimed rightly, in so many cases: creep (1), drift or bias (1) and nothing, where nothing "
        "was hidden (1)."
    )
    assert "creep" not in figures.pictures[0].inline
    rows = [[cell.text for cell in row] for row in table.cells]
    assert rows == [
        ["beside what was hidden", "leakage", "1 of 4"],
        ["bias", "leakage", "1 of 1"],
        ["drift", "leakage", "1 of 2"],
    ]
    assert len(confusion_blocks(tmp_path, "known", "Here", cases[:1])) == 2
    assert confusion_blocks(tmp_path, "known", "Here", []) == []


def test_a_family_counts_for_one_hidden_effect_of_it():
    time, curve = "change with time, path or temperature", "curve of the input"
    assert by_family(["drift"], [{time}]) == ["drift"]
    assert by_family(["drift", "fatigue"], [{time}, {curve}]) == ["drift"]
    assert by_family(["drift", "fatigue"], [{curve, time}, {time}]) == ["drift", "fatigue"]
    assert by_family(["saturation"], [{curve}, set()]) == []
    case = Case("a", "m", 0, "done", hidden="drift", missed="drift", extra="zero-with-time", family="drift")
    assert (case.right, case.right_by_family) == (False, True)
    assert not replace(case, extra="zero-with-time bias").right_by_family


def test_kept_cases_are_told_from_their_table_and_damaged_ones_by_name(tmp_path):
    kept = Path(__file__).parents[2] / "results" / "closing_the_loop"
    assert len(read_cases(kept)) == len((kept / CASES).read_text(encoding="utf-8").splitlines()) - 1
    extra = {"claimed": "bias", "extra": "bias", "sure": "0.950"}
    case = Case("a", "m", 1, "done", hidden="creep", missed="creep", noise=0.5, **extra)
    write_tables(tmp_path, [case])
    assert read_cases(tmp_path) == [case]
    (tmp_path / FOLDER).mkdir()
    assert read_cases(tmp_path) == []
    for content in ('{"bench": "a"}', "[1]", json.dumps(asdict(case) | {"noise": "loud"}), ""):
        (tmp_path / FOLDER / "a.1.json").write_text(content, encoding="utf-8")
        with pytest.raises(UserError, match=r"a\.1\.json: is damaged"):
            read_cases(tmp_path)


def test_ties_are_counted_with_what_was_expected_of_them(tmp_path):
    lag, two = "input-lag~creep", {"told": "0.700 -", "settled": "open right", "then": "input-lag drift"}
    cases = [
        Case("a", "m", 0, "done", ties=lag, told="0.900", settled="right", then="creep"),
        Case("a", "m", 1, "done", ties=f"{lag} drift~fatigue", **two),
        Case("a", "m", 2, "done", ties=lag, told="0.600", settled="void"),
        Case("a", "m", 3, "done"),
        Case("a", "m", 4, "done", ties=lag, told="0.980", settled="narrowed", then="creep"),
    ]
    write_tables(tmp_path, cases)
    assert read_cases(tmp_path) == cases
    told = words(fates(cases))
    assert told.startswith("One advised experiment settled 2 of 5 ties rightly and narrowed 1; 1 stayed open, 0 went")
    assert "Of the 3 ties that it was made for and that had a hidden one among them, 86" in told
    assert "expected to be told from all the others, and 67" in told
    (section,) = settled_section(cases)
    table = section.blocks[-1]
    assert [row[1] for row in table.rows] == ["1", "1", "1"]
    assert settled_section([cases[3]]) == []


def faults_of(folder, text):
    file = folder / "s.toml"
    file.write_text(text)
    with pytest.raises(UserError) as error:
        read_diagnosis_study(file)
    return error.value.faults


def test_faults_of_a_study_are_told_at_once(tmp_path):
    text = TEXT.replace('"fast"', '"fastt"').replace('model = "bouc-wen"\nfitted', 'model = "bouc"\nfitted')
    text = text.replace("seed = 1", 'sed = 1\ntimeout = "soon"')
    text += '\nhidden = ["creeep|drift"]\n[[bench]]\nname = "clean"\nrig = "smaa"\n'
    faults = " ".join(faults_of(tmp_path, text))
    for part in (
        'no key "sed". Known: bench, kind, notes, seed, timeout, title, trials. Did you mean "seed"?',
        "seed: field required",
        "'soon' is not a time",
        '[[bench]] 1: no model "bouc"',
        'Did you mean "bouc-wen"',
        '[[bench]] 1: fitted: rig hidden-effects has no experiment "fastt"',
        'Did you mean "fast"',
        '[[bench]] 1: hidden: no effect "creeep"',
        'Did you mean "creep"',
        '[[bench]] 2: no rig "smaa"',
        "[[bench]] 2 model: field required",
        'two [[bench]] are both called "clean"; give one another name.',
    ):
        assert part in faults, part


def test_only_a_rig_that_plays_drives_can_measure(tmp_path):
    faults = " ".join(faults_of(tmp_path, TEXT.replace("hidden-effects", "sma-known-truth") + "measure = true"))
    assert "[[bench]] 1: measure: rig sma-known-truth cannot play a drive of our own. These can:" in faults


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (('vary = "draw"', 'vary = "drw"'), '[[bench]] 1: hidden-effects has no setting "drw"'),
        (("fresh = ", "fresj = "), '[[bench]] 1: no key "fresj"'),
        (('kind = "diagnosis"', 'kind = "diagnosi"'), "kind: input should be 'diagnosis'"),
        (('fresh = ["stairs"]', 'hidden = "of the rg"'), "[[bench]] 1 hidden: input should be a valid list"),
        (('settings = { model = "bouc-wen", noise = 0.01 }', "settings = 3"), "[[bench]] 1 settings: input should be"),
    ],
)
def test_a_single_typo_is_one_sentence(tmp_path, change, sentence):
    (fault,) = faults_of(tmp_path, TEXT.replace(*change))
    assert fault.startswith(sentence)


def test_a_wrong_kind_is_no_ordinary_study(tmp_path):
    (tmp_path / "s.toml").write_text(TEXT.replace('kind = "diagnosis"', 'kind = "diagnosi"'))
    assert is_diagnosis_study(tmp_path / "s.toml")


def test_the_study_that_ships_is_one_of_diagnosis():
    path = STUDIES / "closing_the_loop.toml"
    assert is_diagnosis_study(path)
    assert len(read_diagnosis_study(path)[0].bench) > 10
    assert not is_diagnosis_study(STUDIES / "sma.toml")


def test_the_page_tells_shares_and_what_went_wrong(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    (tmp_path / FOLDER).mkdir()
    cases = [
        Case("clean", "bouc-wen", number, "done", before=1.0, after=1.0, fresh=1.0 + number, unfitted=1.0, seconds=1.0)
        for number in range(3)
    ]
    cases.append(Case("clean", "bouc-wen", 3, "done", claimed="drift", extra="drift", before=1.0, after=1.0))
    cases.append(Case("clean", "bouc-wen", 4, "crashed", "exit code 9 <b>"))
    for case in cases:
        (tmp_path / FOLDER / f"clean.{case.number}.json").write_text(json.dumps(asdict(case)))
    page = write_diagnosis_study_page(tmp_path).read_text()
    assert answer(tmp_path) == [
        "Where nothing is hidden, something was claimed in 1 of 4 made with the law asked about."
    ]
    assert "1 of 4 (4.6\u202f% to 70\u202f%)" in page
    assert "1 of 3 (6.1\u202f% to 79\u202f%)" in page
    assert "exit code 9 &lt;b&gt;" in page
    assert "Cases that went wrong" in page
    assert "Not listed" not in page


def test_what_is_right_by_family_alone_is_counted_where_it_is_not_listed(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    right = {"hidden": "drift", "missed": "drift", "extra": "zero-with-time", "claimed": "zero-with-time"}
    cases = [
        Case("clean", "bouc-wen", 0, "done", family="drift", **right),
        Case("clean", "bouc-wen", 1, "done", **right),
    ]
    write_tables(tmp_path, cases)
    page = write_diagnosis_study_page(tmp_path).read_text()
    assert "clean, 0" not in page
    assert "clean, 1" in page
    assert "Not listed: 1 more" in page
    assert answer(tmp_path)[0].startswith(
        "Everything hidden was named, and nothing else, in 0 of 2 cases made with the law asked about (1 where a family"
    )


@pytest.mark.parametrize(
    ("told", "wrong", "verdict"),
    [
        ("0.977", 0, "probability of 97.7\u202f%, and 100\u202f% were (200 of 200): somewhat too careful."),
        ("0.800", 0, "(200 of 200): too careful."),
        ("0.977", 4, "(196 of 200): neither too sure nor too careful, within what chance does to so many claims."),
        ("0.977", 16, "(184 of 200): too sure."),
        ("0.977", 12, "(188 of 200): somewhat too sure."),
    ],
)
def test_a_study_of_probabilities_is_answered_by_them(told, wrong, verdict):
    halves = Halves(_claims(told, 200, wrong), [])
    first, second = answer_in_words("Are the probabilities right?", halves)
    assert first.endswith(verdict)
    assert second.startswith("Everything hidden was named")
    assert answer_in_words("Small", halves) == [second, first]


def test_only_too_sure_is_red(tmp_path):
    assert [tone(told, 0.7, 0.9) for told in (0.6, 0.7, 0.9, 0.95)] == ["", "good", "good", "bad"]
    (section,) = sure_section(tmp_path, _claims("0.977", 100, 40))
    (row,) = section.blocks[-1].cells
    assert [cell.text for cell in row[:1]] == ["97.7\u202f%"]
    assert (row[3].tone, row[5].text[:3]) == ("bad", "-38")
    assert "1 bins in the place" not in section.blocks[-1].note
    assert "One bin in the place of 5" in section.blocks[-1].note


def _claims(told, count, wrong):
    """Cases of one claim each, the last ones wrong."""
    right = {"hidden": "drift", "named": "drift"}
    return [
        Case("clean", "bouc-wen", k, "done", claimed="drift", sure=told, **(right if k < count - wrong else EXTRA))
        for k in range(count)
    ]


def test_run_a_study_of_diagnosis_and_continue_it(tmp_path):
    file, out = tmp_path / "small.toml", tmp_path / "results"
    file.write_text(TEXT)
    arguments = ["run", str(file), "--trials", "1", "--jobs", "1", "--out", str(out)]
    first = CliRunner().invoke(main, arguments)
    assert first.exit_code == 0, first.output
    assert (out / "report.html").is_file()
    (case,) = read_cases(out)
    assert case.status == "done"
    assert case.hidden == ""
    assert case.fresh == pytest.approx(1.0, abs=0.2)
    before = (out / FOLDER / "clean.0.json").stat().st_mtime_ns
    assert CliRunner().invoke(main, arguments).exit_code == 0
    assert (out / FOLDER / "clean.0.json").stat().st_mtime_ns == before
    file.write_text(TEXT.replace("seed = 1", "seed = 2"))
    assert CliRunner().invoke(main, arguments).exit_code != 0


def test_the_command_writes_the_page_of_a_diagnosis_study_again(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    (tmp_path / FOLDER).mkdir()
    case = Case("clean", "bouc-wen", 0, "done", before=1.0, after=1.0, fresh=1.0, unfitted=1.0, seconds=1.0)
    (tmp_path / FOLDER / "clean.0.json").write_text(json.dumps(asdict(case)))
    ran = CliRunner().invoke(main, ["report", str(tmp_path)])
    assert ran.exit_code == 0, ran.output
    assert "something was claimed in 0 of 1 made" in (tmp_path / "report.html").read_text()

    kept = tmp_path / "kept"
    ran = CliRunner().invoke(main, ["report", str(tmp_path), "--keep", str(kept)])
    assert ran.exit_code == 0, ran.output
    assert not (kept / FOLDER).exists()
    assert read_cases(kept) == [case]
    assert (kept / "report.html").read_bytes() == (tmp_path / "report.html").read_bytes()
    (kept / STUDY).write_text(TEXT.replace("seed = 1", "seed = 2"))
    again = CliRunner().invoke(main, ["report", str(tmp_path), "--keep", str(kept)])
    assert "holds another study" in again.output


@pytest.mark.parametrize(
    ("hidden", "claimed", "missed", "extra", "family", "right"),
    [
        ("drift", "zero-with-time", "drift", "zero-with-time", "drift", [True]),
        ("drift", "zero-with-time creep", "drift", "zero-with-time creep", "drift", [True, False]),
        ("saturation", "stop-above", "saturation", "stop-above", "", [False]),
        ("drift saturation", "output-curve", "drift saturation", "output-curve", "saturation", [True]),
    ],
)
def test_a_family_told_with_its_curve_is_right(hidden, claimed, missed, extra, family, right):
    told = [f"0.{9 - 3 * k}00" for k in range(len(right))]  # a bin each
    sure = " ".join(told)
    case = Case("b", "bouc-wen", 1, "done", "", hidden, claimed, "", "", missed, extra, family, sure)
    assert [one.right for one in reliability([case] * LEAST)][::-1] == [LEAST * one for one in right]


@pytest.mark.parametrize(("claims", "sizes"), [(0, []), (3, [3]), (49, [12, 12, 12, 13]), (103, [20, 21, 20, 21, 21])])
def test_bins_hold_equally_many_claims_as_far_as_there_are_enough(claims, sizes):
    cases = [
        Case(
            "b", "bouc-wen", number, "done", hidden="drift", claimed="drift", named="drift", sure=f"0.{900 + number:d}"
        )
        for number in range(claims)
    ]
    bins = reliability(cases)
    assert [one.claims for one in bins] == sizes
    assert len(bins) <= BINS
    assert all(one.high <= other.low for one, other in pairwise(bins))


def test_claims_told_alike_share_a_bin():
    sure = [*12 * ["0.900"], *60 * ["0.980"], *3 * ["0.990"], *25 * ["0.995"]]
    cases = [Case("b", "m", k, "done", claimed="drift", sure=told, extra="drift") for k, told in enumerate(sure)]
    assert [(one.low, one.high, one.claims) for one in reliability(cases)] == [
        (0.9, 0.9, 12),
        (0.98, 0.98, 60),
        (0.99, 0.995, 28),
    ]
    assert [one.claims for one in reliability(cases[12:72])] == [60]


def test_the_page_holds_probabilities_against_what_was_right(tmp_path):
    (tmp_path / STUDY).write_text(TEXT)
    claims = LEAST * [("0.950", ""), ("0.930", ""), ("0.300", "drift"), ("-", "drift")]
    cases = [
        Case("clean", "bouc-wen", number, "done", claimed="drift", extra=extra, sure=sure, before=1.0, after=1.0)
        if extra
        else Case("clean", "bouc-wen", number, "done", hidden="drift", claimed="drift", named="drift", sure=sure)
        for number, (sure, extra) in enumerate(claims)
    ]
    bins = reliability(cases)
    assert [(one.claims, one.right) for one in bins] == [(LEAST, 0), (LEAST, LEAST), (LEAST, LEAST)]
    assert [one.told for one in bins] == pytest.approx([0.3, 0.93, 0.95])
    write_tables(tmp_path, cases)
    assert [case.sure for case in read_cases(tmp_path)] == [sure for sure, _ in claims]
    page = write_diagnosis_study_page(tmp_path).read_text()
    assert "How sure, and how right" in page
    assert (tmp_path / "figures" / "reliability.svg").is_file()
