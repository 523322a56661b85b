"""The rig that hides effects in data, and the formulas by which every effect that can be claimed is hidden."""

from __future__ import annotations

import itertools
import tomllib
from collections import namedtuple
from pathlib import Path

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Hiding
from hysteresis_bench.diagnosis_study.hidden_effects import CALIBRATED, HiddenEffects, can_be_hidden, can_make_data
from hysteresis_bench.diagnosis_study.imperfections import IMPERFECTIONS
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.signals import Signal
from hysteresis_plugins.effects.rayleigh_hysteresis import plays
from hysteresis_plugins.models._eddy_current_hidden import relaxed
from tests.diagnosis.generator import EFFECTS

BENCHES = tomllib.loads((Path(__file__).parents[2] / "studies" / "closing_the_loop.toml").read_text())["bench"]
TIME = np.arange(6400) * (3.0 / 6400)
STEP = float(TIME[1])
DRIVE = np.sin(2.0 * np.pi * TIME) * (1.0 - 0.2 * TIME)
ALWAYS = ("bouc-wen", "jiles-atherton", "preisach", "lugre")
LAWS = [pytest.param(law, marks=() if law in ALWAYS else pytest.mark.long) for law in can_make_data()]
"""A formula is the same around any law: one of each kind is asked always, all of them where there is time."""


def bare(name: str, time: Array = TIME):
    """An example's response, and its drive."""
    model = registry.build("models", name)
    values = namedtuple("Values", model.example.parameters)(*(np.array([v]) for v in model.example.parameters.values()))
    return (
        lambda u: model.simulate(Signal(time, np.ascontiguousarray(u[:, None])), values)[:, 0],
        model.example.amplitude * DRIVE,
    )


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def test_every_effect_that_can_be_claimed_says_how_it_is_hidden():
    names = {*registry.names("effects"), *registry.offered()}
    claimed = [
        name for name in names if not (registry.effect(name).nuisance or issubclass(registry.effect(name), FreeForm))
    ]
    assert sorted(name for name in claimed if not registry.effect(name).hidden_forms) == []
    everywhere = {name for name in claimed if name in registry.names("effects")}
    assert {*can_be_hidden(registry.build("models", "free-energy"))} == {*everywhere, "eddy-current"}
    # a law for which only changes of the input matter
    assert {*can_be_hidden(registry.build("models", "prandtl-ishlinskii"))} == {
        *(everywhere - {"input-bias"}),
        "threshold-rate",
    }
    assert "eddy-current" not in can_be_hidden(registry.build("models", "jiles-atherton"))
    assert set(EFFECTS) < set(claimed)


def test_every_model_with_an_example_has_random_numbers_of_its_own():
    streams = [registry.build("models", name).example.stream for name in can_make_data()]
    assert len(set(streams)) == len(streams) >= 4


@pytest.mark.parametrize("model", LAWS)
def test_every_formula_makes_data_that_grow_with_the_strength(model):
    response, drive = bare(model)
    clean = response(drive)
    top = float(response(np.linspace(0.0, np.max(drive), TIME.size))[-1])
    temperature = 22.0 + 9.0 * np.sin(2.0 * np.pi * TIME / 3.9)
    for name in can_be_hidden(registry.build("models", model)):
        effect = registry.effect(name)
        for form in (*effect.hidden_forms, *effect.other_forms):
            changes = []
            for strength in (0.3, 1.0):
                given = Hiding(
                    strength, (0.7, 0.2, 0.4), TIME, drive, temperature, STEP, 3.0, 4.0, float(np.max(drive)), top
                )
                changes.append(float(np.std(form(response, drive, given) - clean)))  # a constant hides nothing
            assert 1e-4 * top < changes[0] < changes[1], (name, form.__name__)


@pytest.mark.parametrize("model", LAWS)
def test_an_effect_of_no_strength_changes_nothing_and_a_hidden_one_is_seen(model):
    clean = HiddenEffects(model, (), draw=3, noise=0.01)
    for name in can_be_hidden(registry.build("models", model)):
        if name == "resonance":
            continue  # at least 20 ms long
        change = clean._change(name, 1e-6) / clean._noise_rms
        assert change < 0.7, name  # the least delay or lag is one of the fine steps
    lagged = HiddenEffects(model, ("transport-delay",), draw=3, noise=0.01)
    measured, truth = (rig.measure("fast", np.random.default_rng(0)).records[0].output for rig in (lagged, clean))
    assert rms(measured - truth) > 3.0 * clean._noise_rms
    assert lagged.measure("fast", np.random.default_rng(0)).hidden.keys() == {"transport-delay", "noise"}


def test_a_draw_is_the_same_in_every_experiment_and_goes_through_all_effects():
    one, two = (HiddenEffects("bouc-wen", hide=2, draw=5) for _ in range(2))
    assert one.names == two.names
    assert len(set(one.names)) == 2
    record, again = (rig.measure("sweep", np.random.default_rng(7)).records[0] for rig in (one, two))
    np.testing.assert_array_equal(record.output, again.output)
    everything = can_be_hidden(registry.build("models", "bouc-wen"))
    drawn = {HiddenEffects("bouc-wen", hide=1, draw=draw).names[0] for draw in range(len(everything))}
    assert drawn == set(everything)
    assert set(CALIBRATED) < set(HiddenEffects.experiments)


@pytest.mark.parametrize(
    ("model", "first", "middle"),
    [
        ("bouc-wen", "saturation", 0.3385123768647901),
        ("free-energy", "resonance", 1.8942646117577016),
        ("jiles-atherton", "creep", 0.46713154435968046),
    ],
)
def test_the_draws_of_the_kept_study_stay(model, first, middle):
    rig = HiddenEffects(model, hide=1, among=EFFECTS, draw=0)
    assert rig.names == (first,)
    assert {HiddenEffects(model, hide=1, among=EFFECTS, draw=draw).names[0] for draw in range(12)} == set(EFFECTS)
    measured = rig.measure("slow", np.random.default_rng(3)).records[0].output
    assert measured[400] == pytest.approx(middle, rel=1e-12)


def test_the_study_that_ships_draws_among_the_same_effects_as_the_kept_one():
    drawing = [bench["settings"] for bench in BENCHES if bench["settings"].get("hide")]
    assert len(drawing) == 9
    assert all(tuple(settings["among"]) == EFFECTS for settings in drawing)
    assert {name for bench in BENCHES for name in bench["settings"].get("effects", ())} == {
        "eddy-current",
        "rayleigh-hysteresis",
    }


@pytest.mark.parametrize(
    "settings", [{"model": "hammerstein"}, {"effects": ("bias",)}, {"among": ("cree",)}, {"hide": 99}]
)
def test_what_cannot_be_hidden_is_told(settings):
    assert registry.faults("rigs", "hidden-effects", settings)


def test_a_bank_of_plays_is_rayleigh_s_law():
    from hysteresis_bench.kernels.rayleigh import rayleigh

    exact = rayleigh(np.ascontiguousarray(DRIVE[:, None]))[:, 0]
    assert rms(plays(DRIVE, float(np.ptp(DRIVE))) - exact) < 1e-4 * np.ptp(exact)


@pytest.mark.parametrize("model", ["bouc-wen", "free-energy", "jiles-atherton-clamped"])
@pytest.mark.parametrize("lag", [0.003, 0.05])
def test_waveform_relaxation_is_the_law_with_eddy_currents(model, lag):
    """To a hundredth of what they change: backward Euler on one side, second order on the other."""
    response, drive = bare(model)
    built = registry.build("models", model)
    coefficient = lag * np.ptp(drive) / np.ptp(response(drive))
    system = System(built, (("eddy-current", built.offers["eddy-current"]),))
    values = np.array([*built.example.parameters.values(), coefficient])[:, None]
    exact = system.simulate(Signal(TIME, np.ascontiguousarray(drive[:, None])), values)[:, 0]
    found = relaxed(response, drive, coefficient, STEP)
    assert rms(found - exact) < 0.01 * rms(exact - response(drive))


def test_eddy_currents_around_a_falling_law_are_refused():
    response, drive = bare("jiles-atherton")
    coefficient = 0.05 * np.ptp(drive) / np.ptp(response(drive))
    with pytest.raises(ValueError, match="falls while its input rises"):
        relaxed(response, drive, coefficient, STEP)


def test_other_formulas_are_other_than_the_effect_s_own():
    response, drive = bare("bouc-wen")
    given = Hiding(0.5, (0.7, 0.2, 0.4), TIME, drive, 22.0 + 9.0 * np.sin(1.6 * TIME), STEP, 3.0, 4.0, 4.0, 3.0)
    for name in can_be_hidden(registry.build("models", "bouc-wen")):
        made = [form(response, drive, given) for form in registry.effect(name).other_forms]
        own = registry.effect(name).hidden_forms[0](response, drive, given)
        for one, other in itertools.combinations([own, *made], 2):
            assert rms(one - other) > 3e-4 * np.ptp(own), name


def test_other_formulas_are_drawn_and_leave_the_others_as_they_are():
    drawn = {HiddenEffects(effects=("creep",), draw=draw, other=True)._form("creep") for draw in range(8)}
    assert drawn == set(registry.effect("creep").other_forms)
    plain, other = (HiddenEffects(effects=("eddy-current",), draw=1, other=one) for one in (False, True))
    assert plain._form("eddy-current") is other._form("eddy-current")


@pytest.mark.parametrize("name", IMPERFECTIONS)
def test_an_imperfect_record_is_the_clean_one_with_one_fault(name):
    clean = HiddenEffects(draw=2).measure("slow", np.random.default_rng(1)).records[0]
    (record,) = HiddenEffects(draw=2, imperfect=name).measure("slow", np.random.default_rng(1)).records
    again = HiddenEffects(draw=2, imperfect=name).measure("slow", np.random.default_rng(1)).records[0]
    np.testing.assert_array_equal(record.output, again.output)
    assert np.isin(record.time, clean.time).all()
    assert record.name == clean.name
    differs = record.time.size < clean.time.size or np.any(record.output != clean.output)
    assert differs or np.any(record.input != clean.input)


def test_an_unknown_imperfection_is_refused_with_those_that_are_known():
    with pytest.raises(ValueError, match="imperfect = 'dusty' is not known; there are: coloured, heavy-tailed"):
        HiddenEffects(imperfect="dusty")
