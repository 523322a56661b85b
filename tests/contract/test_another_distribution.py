"""An effect of another distribution, one file and one entry point, is known wherever one of ours is."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import registry
from hysteresis_bench.cli import main
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.findings.ties import GENERIC, tie
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects, can_be_hidden
from hysteresis_bench.fit.fitting import fit_records
from hysteresis_bench.signals import Dataset, joined
from tests.conftest import forget_plugins

BEND, ZERO = "output-bend", "input-zero"


@pytest.fixture(scope="module", autouse=True)
def _installed():
    """The distribution is there for this module alone: elsewhere it would be a candidate of every diagnosis."""
    folder = str(Path(__file__).parents[1] / "another_distribution")
    sys.path.append(folder)
    forget_plugins()
    yield
    sys.path.remove(folder)
    forget_plugins()


@pytest.fixture(scope="module")
def rig(_installed) -> HiddenEffects:
    return HiddenEffects(effects=(BEND,), draw=1, noise=0.004)


@pytest.fixture(scope="module")
def dataset(rig) -> Dataset:
    rng = np.random.default_rng(0)
    return joined(*(rig.measure(name, rng) for name in ("slow", "fast", "nested", "mixed"))).split(["mixed"])


def test_it_is_listed():
    told = CliRunner().invoke(main, ["list", "effects"], env={"COLUMNS": "200"}).output
    assert BEND in told
    assert ZERO in told
    assert "An even nonlinearity of the" in " ".join(told.split())


def test_an_effect_that_does_not_declare_itself_is_broken_and_stops_no_other(dataset):
    assert registry.load("effects", "faulty-silent").fault == "Silent lacks acts, family"
    assert 'Did you mean "output"?' in registry.load("effects", "faulty-misspelt").fault
    _, impossible = Stack(registry.build("models", "bouc-wen"), dataset.records).candidates()
    assert {name for name, reason in impossible.items() if reason.startswith("broken")} == {
        "faulty-misspelt",
        "faulty-silent",
    }


def test_it_has_its_place_in_the_chain(dataset):
    stack = Stack(registry.build("models", "bouc-wen"), dataset.records)
    order = [name for name, _ in stack.system({"drift", ZERO, BEND, "input-lag", "output-lag", "saturation"}).effects]
    assert order == ["input-lag", ZERO, BEND, "saturation", "output-lag", "drift"]


def test_it_is_a_candidate_and_the_nuisance_is_none(dataset):
    possible, impossible = Stack(registry.build("models", "bouc-wen"), dataset.records).candidates()
    assert BEND in possible
    assert ZERO not in {*possible, *impossible}


def test_its_tie_is_told_from_either_side():
    assert tie(BEND, "asymmetry", 0.0).reason == tie("asymmetry", BEND, 0.0).reason == "both bend the loop to one side"
    assert tie(BEND, "drift", 0.0).reason == GENERIC


def test_the_rig_hides_it_and_no_nuisance(rig, dataset):
    assert set(dataset.hidden) == {BEND, "noise"}
    assert BEND in can_be_hidden(registry.build("models", "bouc-wen"))
    drawn = {name for draw in range(40) for name in HiddenEffects(hide=1, draw=draw).names}
    assert BEND in drawn
    assert ZERO not in drawn
    with pytest.raises(ValueError, match="can be hidden"):
        HiddenEffects(effects=(ZERO,))


def test_it_is_diagnosed(dataset):
    blind = Dataset(dataset.records, dataset.held_out_names)
    found = diagnose(blind, Question("bouc-wen", options=DiagnosisOptions(jobs=1)))
    assert BEND in found.effects or BEND in {one.rival for one in found.ties}
    assert found.after.held_out.rmse < 0.7 * found.before.held_out.rmse


def test_it_is_fitted_beside_the_nuisance(dataset):
    shifted = Dataset(tuple(replace(record, input=record.input + 0.3) for record in dataset.fitted[:2]))
    fitted = fit_records(shifted, "bouc-wen", (BEND, ZERO)).model
    assert fitted.parameters[f"{ZERO}.zero"].value == pytest.approx(-0.3, abs=0.03)
    assert fitted.parameters[f"{BEND}.bend"].value > 0.0
