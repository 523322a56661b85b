"""Where the law is wrong, another law is told as the cause, and what stood in for it is not named."""

import json
from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.doubt.doubt import Doubt, answered, doubt
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.findings.diagnosis_file import read_diagnosis, write_diagnosis
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.search import search
from hysteresis_bench.diagnosis.search.selection import REACHED
from hysteresis_bench.report.diagnosis.page import write_diagnosis_page

RECORDS = ("slow", "fast", "nested", "mixed")
OPTIONS = DiagnosisOptions(jobs=1)


def data_of(law, *effects, imperfect=""):
    settings = {"model": law, "effects": effects, "noise": 0.004, "imperfect": imperfect}
    return measure("hidden-effects", *RECORDS, settings=settings, seed=3).split(RECORDS[-1:])


def found_by(dataset, asked, among=None):
    question = Question(asked, among=among, options=OPTIONS)
    prepared = prepare(dataset, question)
    return question, search(prepared, gather(prepared.views), question)


@pytest.mark.long
def test_a_wrong_law_is_told_and_nothing_is_named_in_its_place(tmp_path, ask_only):
    ask_only(["bouc-wen", "dahl", "ferroelectric", "preisach"])
    question = Question("bouc-wen", among=("rayleigh-hysteresis", "saturation", "backlash", "creep"), options=OPTIONS)
    found = diagnose(data_of("ferroelectric"), question)
    assert found.effects == ()
    assert found.stand_ins
    assert found.better_law.model == "ferroelectric"
    assert found.better_law.unseen < 1.1 * found.floor
    assert found.verdict == "unexplained-residual"
    assert "No effect is named, as the law itself is the cause" in found.headline
    assert not any("depends on nothing that was measured" in one for one in found.warnings)  # no slow noise
    write_diagnosis(tmp_path, found)
    kept = read_diagnosis(tmp_path).diagnosis
    assert kept["effects"] == []
    assert kept["better_law"]["model"] == "ferroelectric"
    assert not any(row["adopted"] for row in kept["candidates"])
    around = json.loads((tmp_path / "model.json").read_text(encoding="utf-8"))["effects"]
    assert {*found.stand_ins} <= {one["effect"] for one in around}  # they help to predict, and stay
    page = write_diagnosis_page(tmp_path).read_text(encoding="utf-8")
    assert "bouc-wen is not the law here: ferroelectric does better" in page
    assert "stands in for the law" in page


@pytest.mark.long
def test_what_another_law_explains_is_no_slow_noise(ask_only, names_only):
    """Jiles-Atherton loops asked of a Preisach law: the rest looks like slow noise, and a saturation was named."""
    ask_only(["bouc-wen", "jiles-atherton"])
    records = ("slow", "fast", "nested", "sweep", "mixed")
    data = measure("hidden-effects", *records, settings={"model": "jiles-atherton", "draw": 8082}, seed=3)
    with names_only():
        question = Question("preisach", among=("creep", "saturation"), options=OPTIONS)
        found = diagnose(data.split(records[-1:]), question)
    assert found.effects == ()
    assert found.better_law.model == "jiles-atherton"
    assert found.better_law.unseen < 1.1 * found.floor
    assert not any("slow noise" in one for one in found.warnings)


def test_what_lifts_records_is_no_other_laws(ask_only):
    """Every other law has a constant a record; the one that was asked about needs none, as the tests have it."""
    ask_only(["bouc-wen", "dahl"])
    data = data_of("bouc-wen")
    wandering = []
    for k, record in enumerate(data.records):
        steps = np.random.default_rng(70 + k).standard_normal(record.output.size)
        walk = 0.03 * np.ptp(record.output) * np.cumsum(steps) / np.sqrt(steps.size)
        wandering.append(replace(record, output=record.output + walk))
    question = Question("bouc-wen", among=("bias", "creep", "drift", "output-lag"), options=OPTIONS)
    found = diagnose(replace(data, records=tuple(wandering)), question)
    assert found.better_law is None
    assert found.verdict == "unexplained-residual"


@pytest.fixture(scope="module")
def creeping(names_only):
    """A ferroelectric with creep, asked about as Bouc-Wen."""
    with names_only():
        likely = ("creep", "rayleigh-hysteresis", "saturation", "stop-above", "asymmetry", "output-lag")
        return found_by(data_of("ferroelectric", "creep"), "bouc-wen", likely)


@pytest.mark.long
def test_an_effect_that_the_better_law_needs_too_stays_named(creeping):
    question, found = creeping
    doubted = doubt(found, question, ("ferroelectric", "dahl"), ("ferroelectric", "dahl"))
    assert doubted.cause.model == "ferroelectric"
    assert doubted.cause.effects == ("creep",)
    assert doubted.cause.unseen < 1.1 * found.selection.floor
    assert doubted.agreement is None  # that law explains all
    assert list(doubted.holding(found.selection.adopted(found.best))) == ["creep"]


@pytest.mark.long
def test_where_no_law_may_be_blamed_what_all_of_them_need_is_named(creeping):
    question, found = creeping
    assert len(found.selection.adopted(found.best)) > 1
    doubted = doubt(found, question, (), ("ferroelectric", "prandtl-ishlinskii-modified", "preisach", "dahl", "lugre"))
    assert doubted.cause is None
    assert {"bouc-wen", "ferroelectric", "preisach"} <= {*doubted.agreement.needs}
    assert "lugre" not in doubted.agreement.needs  # it is not rate-independent, and may hold the creep in itself
    assert list(doubted.agreement.effects) == ["creep"]
    told = answered(found, doubted, OPTIONS)
    assert list(doubted.holding(tuple(told.rivals))) == ["creep"]


@pytest.mark.parametrize(
    ("effects", "imperfect"), [((), ""), (("input-lag",), ""), pytest.param((), "coloured", marks=pytest.mark.long)]
)
def test_a_right_law_is_not_blamed(effects, imperfect):
    question, found = found_by(data_of("bouc-wen", *effects, imperfect=imperfect), "bouc-wen")
    laws = ("preisach", "prandtl-ishlinskii-modified", "ferroelectric")
    assert doubt(found, question, laws, laws) == Doubt()


@pytest.mark.long
def test_a_richer_law_that_follows_a_curve_as_well_is_not_the_cause(ask_only):
    """Bouc-Wen behind clearances of several widths: the generalized law, of twice the parameters, predicts as well."""
    ask_only(["bouc-wen", "bouc-wen-generalized"])
    settings = {"model": "bouc-wen", "effects": ("backlash",), "other": True, "draw": 2}
    data = measure("hidden-effects", *RECORDS, "sweep", settings=settings, seed=7).split(RECORDS[-1:])
    found = diagnose(data, Question("bouc-wen", among=("backlash", "creep", "saturation"), options=OPTIONS))
    assert (found.effects, found.better_law) == (("play-bank",), None)
    assert found.after.held_out.rmse < 1.2 * found.floor


@pytest.mark.parametrize("law", ["energy-based", "jiles-atherton"])
def test_two_names_that_make_another_law_are_not_named(law, names_only):
    """An energy-based law is Jiles-Atherton's behind a dead zone and before a saturation, to the noise. Where both are
    there, no other law follows without."""
    records, hidden = ("slow", "fast", "nested", "sweep", "mixed"), ("input-dead-zone", "saturation")
    settings = {"model": law, "draw": 5401, "effects": () if law == "energy-based" else hidden, "hide": 0}
    data = measure("hidden-effects", *records, settings=settings, seed=1).split(records[-1:])
    with names_only():
        question, found = found_by(data, "jiles-atherton", ())
    both = found.thin.refitted(found.thin.from_anywhere(found.best.names | {*hidden}))
    assert both.rmse < REACHED * found.selection.floor
    found.selection.candidates = hidden
    found = replace(found, best=both, final=both)
    doubted = doubt(found, question, ("energy-based",), ())
    assert (doubted.cause.model if doubted.cause else "") == ("energy-based" if law == "energy-based" else "")
    assert doubted.holding(hidden) == ({} if law == "energy-based" else {name: () for name in hidden})
