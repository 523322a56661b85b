"""Feed-forward along trajectories: laws and their linear dynamics undone, and how well, told."""

import json
from dataclasses import asdict, replace

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench import registry
from hysteresis_bench.cli import main
from hysteresis_bench.compose import System
from hysteresis_bench.control.bench import FEED_FORWARD, PI
from hysteresis_bench.control.comparison import compare
from hysteresis_bench.control.feed_forward import FeedForward
from hysteresis_bench.control.iterated_inverse import IteratedInverse
from hysteresis_bench.control.linear_dynamics import Through, undone
from hysteresis_bench.control.trajectories.driven import drive, forward_of
from hysteresis_bench.control.trajectories.sweep import sweep
from hysteresis_bench.control.trajectories.trajectory import follow
from hysteresis_bench.fit.model_file import Estimate, FittedModel, write_model
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.signals import Dataset, Record, Signal

RATE = 2000.0
TIME = np.arange(1600) / RATE
SHARE = np.clip(TIME / 0.2, 0.0, 1.0)
WANTED = 1.5 * SHARE**3 * (10.0 - 15.0 * SHARE + 6.0 * SHARE**2) * np.sin(2.0 * np.pi * 8.0 * TIME)
PLAYS = {"radius": 4.0, "slope": 0.6, **{f"w{k}": 0.3 / k for k in range(1, 13)}}
BOUC_WEN = {"alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2}
LINEAR = {"b": 5e4, "c_over_m": 60.0, "k_over_m": 4e4}
EFFECTS = {
    "bias": {"offset": 0.2},
    "creep": {"share": 0.2, "time_constant": 0.1, "decades": 2.0},
    "droop": {"rate": 2.0, "share": 0.8},
    "input-lag": {"time_constant": 0.004},
    "lag-curve-after": {"bend": 1.0, "falling_fast": 0.01, "falling": 0.01, "rising": 0.005, "rising_fast": 0.005},
    "modes-after": {
        "period1": 0.02, "damping1": 0.1, "weight1": 0.8, "lead1": 0.0,
        "period2": 0.008, "damping2": 0.1, "weight2": 0.2, "lead2": 0.1,
    },
    "output-lag": {"time_constant": 0.005},
    "resonance": {"period": 0.01, "damping": 0.1},
    "saturation": {"inverse_level": 0.1, "sharpness": 2.0},
    "slew-rate-limit": {"slowness": 0.02, "skew": 0.0},
    "drift": {"rate": 0.1},
}  # fmt: skip


def fitted(law, values, effects=(), unit="s"):
    values = {**values, **{f"{name}.{key}": value for name in effects for key, value in EFFECTS[name].items()}}
    units, model = {"time": unit, "input": "V", "output": "um"}, registry.build("models", law)
    around = registry.build_effects(model, effects)
    spelled = {parameter.name: parameter.unit_in(units) for parameter in System(model, around).parameters}
    parameters = {name: Estimate(value, None, spelled[name]) for name, value in values.items()}
    own = {name: asdict(effect) for name, effect in around}
    error = {"fitted": {"rmse": 0.02, "relative_rms": 0.01, "max_error": 0.02}}
    data = {"ranges": {"input": [-3.0, 3.0], "output": [-2.0, 2.0]}}
    settings = asdict(model)
    return FittedModel(law, settings, tuple(effects), own, units, parameters, data=data, error=error)


CASES = {
    "bouc-wen": ("bouc-wen", BOUC_WEN, (), 1e-12),
    "plays": ("prandtl-ishlinskii", PLAYS, (), 1e-9),
    "creep": ("bouc-wen", BOUC_WEN, ("creep", "bias"), 1e-9),
    "creep behind plays": ("prandtl-ishlinskii", PLAYS, ("creep",), 1e-9),
    "droop": ("bouc-wen", BOUC_WEN, ("droop",), 1e-9),
    "lag before": ("bouc-wen", BOUC_WEN, ("input-lag",), 5e-4),
    "lag behind": ("bouc-wen", BOUC_WEN, ("output-lag",), 5e-4),
    "resonance": ("bouc-wen", BOUC_WEN, ("resonance",), 3e-4),
    "two modes": ("bouc-wen", BOUC_WEN, ("modes-after",), 3e-4),
    "linear section": ("hammerstein", {**BOUC_WEN, **LINEAR}, (), 3e-4),
    "a curve": ("bouc-wen", BOUC_WEN, ("saturation",), 1e-9),
    "all": ("prandtl-ishlinskii", PLAYS, ("creep", "resonance", "saturation", "bias", "input-lag"), 2e-2),
}


@pytest.mark.parametrize("case", CASES)
def test_the_model_answers_with_what_was_wanted(case):
    law, values, effects, tolerance = CASES[case]
    model = fitted(law, values, effects)
    driven = drive(model, forward_of(model), TIME, WANTED)
    left = np.sqrt(np.mean((driven.reached - WANTED) ** 2)) / np.ptp(WANTED)
    assert left <= tolerance
    assert not driven.ignored
    alone = replace(forward_of(model), dynamics=None)
    if forward_of(model).dynamics:
        without = drive(model, alone, TIME, WANTED)
        assert left < 0.1 * np.sqrt(np.mean((without.reached - WANTED) ** 2)) / np.ptp(WANTED)


def test_which_inverse_is_taken():
    assert isinstance(forward_of(fitted("bouc-wen", BOUC_WEN, ("creep", "bias"))), FeedForward)
    assert isinstance(forward_of(fitted("bouc-wen", BOUC_WEN, ("saturation",))), IteratedInverse)
    assert isinstance(forward_of(fitted("prandtl-ishlinskii", PLAYS)), IteratedInverse)


def test_preparation_limit_and_what_is_left_out():
    model = fitted("bouc-wen", BOUC_WEN, ("input-lag", "lag-curve-after", "slew-rate-limit", "drift"))
    model = replace(model, preparation=Preparation(input_offset=0.5, flip=True))
    driven = drive(model, forward_of(model), TIME, WANTED, limit=1.0)
    assert driven.undone == ("input-lag",)
    assert driven.ignored == ("lag-curve-after", "slew-rate-limit", "drift")
    assert np.max(np.abs(driven.input)) <= 1.0
    assert driven.cut.any()
    model = fitted("bouc-wen", BOUC_WEN, ("input-lag", "drift"))
    free = drive(model, forward_of(model), TIME, WANTED)
    assert np.max(np.abs(free.reached - WANTED - 0.1 * TIME)) < 1e-2


def test_uneven_times_and_an_index_leave_dynamics_alone():
    uneven = TIME + 1e-4 * np.sin(np.arange(TIME.size))
    model = fitted("bouc-wen", BOUC_WEN, ("creep",))
    assert drive(model, forward_of(model), uneven, WANTED).ignored == ("creep",)
    assert forward_of(fitted("bouc-wen", BOUC_WEN, ("creep",), unit="sample")).dynamics is None


@pytest.mark.parametrize("rate", [500.0, 20_000.0])
def test_a_lag_that_is_undone_does_not_ring(rate):
    """The exact inverse of the sampled lag alternates from sample to sample."""
    time = np.arange(int(0.5 * rate)) / rate
    wanted = 1.0 - np.abs(4.0 * time - 1.0)
    system = System(Through(), registry.build_effects(Through(), ("output-lag",)))
    found = undone(
        lambda x: system.simulate(Signal(time, np.ascontiguousarray(x[:, None])), np.array([[0.02]]))[:, 0], wanted
    )
    assert np.sum(np.abs(np.diff(found))) < 1.5 * np.sum(np.abs(np.diff(wanted)))


def test_what_a_limit_costs_is_told(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_model(tmp_path / "model.json", fitted("bouc-wen", BOUC_WEN))
    pd.DataFrame({"time": TIME, "output": WANTED}).to_csv("wanted.csv", index=False)
    command = ["control", "model.json", "--reference", "wanted.csv", "--force"]
    free = " ".join(CliRunner().invoke(main, command).output.split())
    assert "of its range. feed-forward:" in free
    limited = " ".join(CliRunner().invoke(main, [*command, "--voltage-limit", "1"]).output.split())
    assert "of its range where nothing is cut, and is off by up to 0." in limited
    told = json.loads(CliRunner().invoke(main, [*command, "--voltage-limit", "1", "--json"]).stdout)
    assert told["left"] < 1e-6 < 0.05 < told["missed"]


def test_a_sweep_tells_what_to_expect():
    table = sweep(fitted("prandtl-ishlinskii", PLAYS, ("resonance",)), (1.0, 10.0), (0.5, 1.5, 40.0))
    assert list(table["amplitude"].unique()) == [0.5, 1.5, 40.0]
    near = table[table["amplitude"] < 2.0]
    assert (near["left"] < 1e-3).all()
    assert near["expected"].to_numpy() == pytest.approx(0.02, rel=1e-2)
    assert set(table.loc[table["amplitude"] == 40.0, "beyond"]) == {"larger"}
    assert set(near["beyond"]) == {""}
    with pytest.raises(ValueError, match="range of the fitted records"):
        sweep(replace(fitted("bouc-wen", BOUC_WEN), data={}), (1.0,))
    out_of_reach = sweep(fitted("bouc-wen", BOUC_WEN, ("saturation",)), (1.0,), (1.0, 50.0))
    assert list(out_of_reach["left"].isna()) == [False, True]
    assert "does not reach" in out_of_reach["reason"][1]
    lugre = {"distance": 0.4, "stiction": 1.3, "v_s": 8.0, "slope": 0.4, "F_C": 1.5, "sigma_1": 0.1, "sigma_2": 0.1}
    with pytest.raises(ValueError, match="depends on the rate"):
        sweep(fitted("lugre", lugre), (1.0, 2.0))


def test_a_range_that_noise_moves_off_0_is_swept_about_0():
    """Friction begins without force: a sine about the noise's 0.3 would ask for force at rest."""
    springs = {f"k{k}": 0.0 if k % 2 else 200.0 / k for k in range(1, 17)}
    known = {"radius": 0.4, "gap": 0.0, "slope": -0.5, **springs}
    model = fitted("maxwell-slip", known)
    ranges = {"input": [-1.0, 1.0], "output": [-19.4, 20.0]}
    table = sweep(replace(model, data={**model.data, "ranges": ranges}), (1.0,))
    assert (table["left"] < 1e-6).all()


def test_why_no_sine_is_reached_is_told_once():
    with pytest.raises(ValueError, match="for none of 2 sines; for the first, of amplitude 50 and") as told:
        sweep(fitted("bouc-wen", BOUC_WEN, ("saturation",)), (1.0,), (50.0, 60.0))
    assert str(told.value).count("does not reach") == 1


def test_what_the_fit_has_not_seen_is_told():
    model = fitted("bouc-wen", BOUC_WEN)
    seen = replace(model, data={**model.data, "excited": {"frequency": [1.0, 4.0], "amplitude": [1.0, 3.0]}})
    table = sweep(seen, (0.1, 1.0, 4.5, 10.0), (0.2, 1.9))
    small, large = table["beyond"][:4], table["beyond"][4:]
    assert list(small) == ["slower, smaller", "smaller", "smaller", "faster, smaller"]
    assert list(large) == ["slower", "", "", "faster"]
    wanted = Dataset((Record(TIME, WANTED, WANTED, units=seen.units),))
    notes = " ".join(follow(seen, forward_of(seen), wanted).notes)
    assert "The input turns faster than the fitted ones: 7.9" in notes
    assert "turns" not in " ".join(follow(model, forward_of(model), wanted).notes)


def test_the_command_sweeps(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")  # a narrow terminal breaks the headings
    write_model(tmp_path / "model.json", fitted("bouc-wen", BOUC_WEN, ("creep",)))
    done = CliRunner().invoke(main, ["control", "model.json", "--sweep", "1,10", "--json"])
    assert done.exit_code == 0, done.output
    assert len(json.loads(done.stdout)["sweep"]) == 8
    assert len(pd.read_csv(tmp_path / "model-control" / "sweep.csv")) == 8
    shown = CliRunner().invoke(main, ["control", "model.json", "--sweep", "1,10", "--amplitude", "1.9"])
    assert "RMSE expected" in shown.output
    assert "does not keep how fast" in " ".join(shown.output.split())
    assert "Frequency (1/s)" in (tmp_path / "model-control" / "sweep.svg").read_text(encoding="utf-8")
    refused = CliRunner().invoke(main, ["control", "model.json", "--sweep", "1,x"])
    assert refused.exit_code == 2
    assert "should read F,F" in refused.output


def test_a_law_of_plays_on_a_rig():
    """Feedback on what the inverse of another law than Bouc-Wen leaves; the rig's truth is no play at all."""
    rig = registry.build("rigs", "pea")
    scores = compare(fitted("prandtl-ishlinskii", PLAYS), rig, "pea", rate=2000.0, amplitude=0.5).scores
    assert set(scores["controller"]) == {FEED_FORWARD, PI}
    assert scores["t_rmse"].notna().all()
