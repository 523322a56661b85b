"""Closed loops on a stand-in plant and on the rig, the tuning rule, the references, the command."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench import registry
from hysteresis_bench.cli import Group
from hysteresis_bench.commands.control.control import control
from hysteresis_bench.compose import System
from hysteresis_bench.control.bench import FEED_FORWARD, IN_SERIES, LAYERED, PI, PRINTED, SLIDING
from hysteresis_bench.control.closed_loop import Target, track
from hysteresis_bench.control.comparison import compare
from hysteresis_bench.control.controllers.pi import Memory, ProportionalIntegral
from hysteresis_bench.control.controllers.sliding_mode import SlidingMode
from hysteresis_bench.control.controllers.tuning import PEAK, sliding_mode_loop, tune_pi, tune_sliding_mode
from hysteresis_bench.control.feed_forward import LinearSection, feed_forward
from hysteresis_bench.control.observer import Differences, observer
from hysteresis_bench.control.references import Reference, published_references
from hysteresis_bench.control.trajectories.trajectory import follow
from hysteresis_bench.data.trajectory_file import read_trajectory
from hysteresis_bench.fit.model_file import Estimate, FittedModel, read_model, write_model
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.kernels.second_order import transition
from hysteresis_bench.signals import Dataset, Record, Signal

PUBLISHED = {"alpha": 0.304225, "beta": 0.675313, "gamma": 0.497724, "d": 1.045814}  # PEA paper, Table 2, G-Pmix
LINEAR = {"b": 267_700.0, "c_over_m": 510.1069, "k_over_m": 255_700.0}  # PEA paper, Table 3, G-Pmix
UNITS = {"time": "s", "input": "V", "output": "um"}
section = LinearSection(*LINEAR.values())
RATE = 10_000.0


def model(name="hammerstein", effects=(), preparation=None, **changed):
    values = PUBLISHED | (LINEAR if name == "hammerstein" else {}) | changed
    units = {"beta": "1/V", "gamma": "1/V", "d": "um/V", "b": "1/s^2", "c_over_m": "1/s", "k_over_m": "1/s^2"}
    parameters = {key: Estimate(value, None, units.get(key, "1")) for key, value in values.items()}
    error = {"fitted": {"rmse": 0.02, "relative_rms": 0.01, "max_error": 0.02}}
    return FittedModel(name, {}, effects, {}, UNITS, parameters, {}, preparation or Preparation(), {}, error)


class StandIn:
    """A plant that is nearly the model: another loop height, a stiffer spring, a noisy and quantised sensor."""

    input_limit, noise, resolution, units = 5.0, 0.003, 0.003, UNITS
    noise_floor = np.hypot(noise, resolution / np.sqrt(12.0))

    def __init__(self, alpha=1.2 * PUBLISHED["alpha"], stiffness=1.1 * LINEAR["k_over_m"]):
        truth = model(alpha=alpha, k_over_m=stiffness)
        self.forward = feed_forward(truth)

    def plant(self, rate):
        self.phi = transition(self.forward.linear.damping, self.forward.linear.stiffness, 1.0 / rate)
        return self

    def rest(self):
        return self.forward.rest(), 0.0, 0.0

    def step(self, state, voltage):
        point, x, speed = state
        point = self.forward.hysteresis.moved(point, voltage)
        goal = self.forward.gain * self.forward.hysteresis.output(point)
        kept, sine, pulled, damped, _ = self.phi
        return point, goal + kept * (x - goal) + sine * speed, pulled * (x - goal) + damped * speed

    def displacement(self, state):
        return state[1]

    def read(self, state, rng):
        return round((state[1] + self.noise * rng.standard_normal()) / self.resolution) * self.resolution


@pytest.fixture(scope="module")
def compared():
    return compare(model(), StandIn(), "stand-in", rate=4000.0)


def by_controller(comparison, score):
    return comparison.scores.pivot(index="reference", columns="controller", values=score)


def test_stand_in_steps_as_the_model_does():
    """An independent check of the test's own plant, on a voltage that is held: the model sampled finely."""
    rng = np.random.default_rng(0)
    voltage, plant = np.repeat(rng.uniform(-2, 2, 20), 1), StandIn(PUBLISHED["alpha"], LINEAR["k_over_m"]).plant(100.0)
    state, reached = plant.rest(), []
    for level in voltage:
        state = plant.step(state, level)
        reached.append(plant.displacement(state))
    edges = np.arange(20) / 100.0
    time = np.unique(np.concatenate([[-1e-9], np.arange(20_000) / 1e5, edges - 1e-9, [0.2]]))
    held = np.where(time < 0, 0.0, voltage[np.clip(np.searchsorted(edges, time, side="right") - 1, 0, 19)])
    values = np.array([*PUBLISHED.values(), *LINEAR.values()])[:, None]
    fine = System(registry.build("models", "hammerstein")).simulate(Signal(time, held[:, None]), values)[:, 0]
    np.testing.assert_allclose(reached, np.interp(np.arange(1, 21) / 100.0 - 1e-9, time, fine), atol=1e-5)


def test_compound_control_beats_the_feed_forward_on_every_reference(compared):
    errors = by_controller(compared, "t_rmse")
    assert len(errors) == 6
    assert (errors[SLIDING] < errors[FEED_FORWARD]).all()
    assert (errors[LAYERED] < errors[FEED_FORWARD]).all()
    assert (errors[SLIDING] < 0.2 * errors[FEED_FORWARD]).loc[["sine-10-hz", "sine-30-hz", "sine-50-hz"]].all()


def test_figure_12_to_the_letter_follows_worse_than_with_what_we_added(compared):
    """On the model itself, with no sensor's noise: the observer and the inverse along the reference are ours."""
    errors = by_controller(compared, "t_rmse")
    assert (errors[PRINTED] < errors[FEED_FORWARD]).any()
    assert (errors[PRINTED] != errors[IN_SERIES]).all()
    assert errors[SLIDING].mean() < errors[PRINTED].mean()


def test_without_an_observer_the_velocity_is_the_difference_of_two_readings():
    differences = Differences(0.01)
    first = differences.corrected(np.zeros(3), 0.5)
    np.testing.assert_allclose(differences.corrected(differences.predicted(first, 3.0), 0.4), [0.4, -10.0, 0.0])


def test_largest_error_is_never_below_the_rms_and_nothing_is_absent(compared):
    assert not compared.scores.isna().any(axis=None)
    assert not compared.responses.isna().any(axis=None)
    assert (compared.scores["t_error"] >= compared.scores["t_rmse"]).all()
    assert (compared.scores["saturated_share"] == 0).all()
    assert compared.warnings == ()


def test_a_boundary_layer_chatters_less(compared):
    variation = by_controller(compared, "total_variation")
    assert (variation[LAYERED] < variation[SLIDING]).all()


def test_same_seed_same_numbers_other_seed_others():
    rig, one = StandIn(), {}
    for label, seed in (("first", 1), ("again", 1), ("other", 2)):
        one[label] = compare(model("bouc-wen"), rig, "stand-in", rate=2000.0, seed=seed).scores
    pd.testing.assert_frame_equal(one["first"], one["again"])
    feedback = one["first"]["controller"] == PI
    assert (one["first"]["t_rmse"] != one["other"]["t_rmse"])[feedback].all()


def test_a_voltage_limit_is_flagged_and_stays_finite():
    rig = StandIn()
    rig.input_limit = 1.0
    found = compare(model(), rig, "stand-in", rate=2000.0)
    assert np.isfinite(found.scores.select_dtypes("number").to_numpy()).all()
    assert (by_controller(found, "saturated_share").loc["ramp"] > 0.2).all()
    assert sum("voltage limit cut" in told for told in found.warnings) == 1
    assert "An amplitude of 2 needs" in found.warnings[0]
    assert found.responses["voltage"].abs().max() <= 1.0


@pytest.mark.parametrize(
    ("changed", "amplitude", "words"),
    [
        ({"units": UNITS | {"output": "nm"}}, 2.0, "output is in nm in the model and in um on the rig"),
        ({"units": UNITS | {"time": "ms"}}, 2.0, "time is in ms"),
        ({}, 60.0, "less than 25% of it can be reached"),
    ],
)
def test_a_model_that_does_not_suit_the_rig_is_refused(changed, amplitude, words):
    with pytest.raises(ValueError, match=words):
        compare(replace(model(), **changed), StandIn(), "stand-in", rate=2000.0, amplitude=amplitude)


def test_a_model_of_larger_inputs_is_told_first():
    of_sixty_volts = replace(model("bouc-wen"), data={"ranges": {"input": [-60.0, 60.0]}})
    found = compare(of_sixty_volts, StandIn(), "stand-in", rate=2000.0)
    assert "fitted to inputs up to 60 V, and the rig takes 5 V" in found.warnings[0]


def test_a_trajectory_is_converted_and_settled_as_the_fit_was(tmp_path):
    path, fitted = tmp_path / "wanted.csv", replace(model("bouc-wen"), preparation=Preparation(settle=3))
    time = np.arange(401) / 100.0
    wanted = 1.5 * np.sin(np.pi * time)
    frame = pd.DataFrame({"time [ms]": 1e3 * time, "reference [nm]": 1e3 * wanted})
    frame.to_csv(path, index=False)
    found = follow(fitted, feed_forward(fitted), read_trajectory(path, UNITS))
    np.testing.assert_allclose(found.output, wanted, atol=1e-12)
    np.testing.assert_allclose(found.time, time, atol=1e-12)
    assert "output [nm] was converted to um" in found.notes[0]
    assert "closed loops are passed 3 times" in found.notes[1]
    record = Record(time, found.input, None, units=UNITS)
    predicted = fitted.predict(Dataset((record,)))
    np.testing.assert_allclose(predicted.records[0].output, wanted, atol=0.02)


def test_a_model_without_a_linear_section_has_no_sliding_mode_and_says_so():
    found = compare(model("bouc-wen"), StandIn(), "stand-in", rate=2000.0)
    assert set(found.scores["controller"]) == {FEED_FORWARD, PI}
    assert "no linear section" in found.warnings[-1]


def test_on_a_plant_that_is_the_model_only_the_sampling_is_left():
    rig = StandIn(PUBLISHED["alpha"], LINEAR["k_over_m"])
    rig.noise, rig.resolution = 0.0, 1e-12
    found, errors = tune_sliding_mode(section, 1 / RATE, 0.02), []
    law = SlidingMode(
        section, observer(section, found.observer_bandwidth, 1 / RATE), found.convergence, found.epsilon, found.rho,
        found.layer,
    )  # fmt: skip
    (reference,) = (each for each in published_references(2.0, RATE) if each.name == "sine-30-hz")
    for series in (False, True):
        plant, forward = rig.plant(RATE), feed_forward(model())
        run = track(plant, law, forward, reference=reference, limit=5.0, rng=np.random.default_rng(0), series=series)
        errors.append(run.scores()["t_rmse"])
    assert max(errors) < 0.1 * reference.delay_floor  # half a sample of hold, less what feedback takes


def test_law_is_equation_15():
    law = SlidingMode(section, observer(section, 1000.0, 1e-4), 700.0, 15_000.0, 300.0)
    rng = np.random.default_rng(3)
    for _ in range(5):
        state, target, measured = rng.normal(size=3), Target(*rng.normal(size=3)), rng.normal()
        v, estimate = law.command(state, target, measured)
        x1, x2 = estimate[:2]
        s = 700.0 * (target.position - x1) + target.velocity - x2
        printed = 15_000.0 * np.sign(s) + 300.0 * s + 700.0 * (target.velocity - x2) + target.acceleration
        printed += LINEAR["k_over_m"] * x1 + LINEAR["c_over_m"] * x2
        assert v == pytest.approx(printed / LINEAR["b"], rel=1e-12)
        assert replace(law, layer=1e-12).command(state, target, measured)[0] == pytest.approx(v, rel=1e-12)
        wide = replace(law, layer=1e9).command(state, target, measured)[0]
        assert wide == pytest.approx((printed - 15_000.0 * (np.sign(s) - s / 1e9)) / LINEAR["b"], rel=1e-12)


def test_observer_has_its_poles_where_it_says_and_forgets_a_wrong_start():
    watching = observer(section, 1500.0, 1e-4)
    correction = np.outer(watching.correction, [1.0, 0.0, 0.0])
    errors = watching.transition @ (np.eye(3) - correction)
    wanted = np.poly(np.full(3, np.exp(-0.15)))  # the polynomial: a triple pole is badly conditioned
    np.testing.assert_allclose(np.poly(errors), wanted, rtol=1e-7)
    truth, guess = np.array([0.3, 50.0, 2e4]), np.zeros(3)
    for _ in range(300):
        guess = watching.predicted(watching.corrected(guess, truth[0]), 0.7)
        truth = watching.predicted(truth, 0.7)
    np.testing.assert_allclose(guess, truth, rtol=1e-6, atol=1e-9)


def test_tuning_keeps_the_margin_and_uses_it():
    found = tune_sliding_mode(section, 1 / RATE, 0.02)
    peak = np.max(1 / np.abs(1 + sliding_mode_loop(section, found.convergence, 1 / RATE)))
    assert 0.9 * PEAK < peak <= PEAK
    assert found.epsilon == pytest.approx(LINEAR["k_over_m"] * 3 * 0.02)
    assert found.rho + found.epsilon / found.layer == pytest.approx(found.convergence)
    assert tune_sliding_mode(section, 0.5 / RATE, 0.02).convergence > found.convergence
    assert tune_pi(section, 1 / RATE).integral > 0
    with pytest.raises(ValueError, match="too slow"):
        tune_sliding_mode(section, 0.003, 0.02)


def test_loop_transfer_is_the_loop_s():
    """The loop opened at v, driven by a sine, sample by sample, against the formula (the lag left out of both)."""
    interval, bandwidth, frequency = 1e-4, 900.0, 2 * np.pi * 60
    law = SlidingMode(section, observer(section, bandwidth, interval), bandwidth, 0.0, bandwidth)
    kept, sine, pulled, damped, _ = transition(section.damping, section.stiffness, interval)
    state, x, speed, answered = law.start(), 0.0, 0.0, []
    drive = np.exp(1j * frequency * interval * np.arange(6000))
    for sent in drive.imag:
        v, state = law.command(state, Target(0.0, 0.0, 0.0), x)
        answered.append(-v)
        state = law.applied(state, v, False)
        goal = section.gain * sent
        x, speed = goal + kept * (x - goal) + sine * speed, pulled * (x - goal) + damped * speed
    late = slice(3000, 6000)
    got = 2 * np.mean(np.array(answered)[late] * drive[late].conj()) * 1j
    grid = np.geomspace(1e-4, 1.0, 600) * np.pi / interval
    loop = sliding_mode_loop(section, bandwidth, interval) * np.exp(2j * grid * interval)
    expected = np.interp(frequency, grid, loop.real) + 1j * np.interp(frequency, grid, loop.imag)
    assert got == pytest.approx(expected, abs=0.01 * abs(expected))


def test_integral_stands_still_while_the_voltage_is_cut():
    law = ProportionalIntegral(1.0, 0.5, 100.0, 1e-3)
    v, memory = law.command(Memory(0.25, 0.0), Target(1.0, 0.0, 0.0), 0.8)
    assert v == pytest.approx(1.0 + 0.1 + 0.25)
    assert law.applied(memory, v, cut=True).integral == 0.25
    assert law.applied(memory, v, cut=False).integral == pytest.approx(0.27)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"k_over_m": -1.0}, "no stable stage: k/m = -1"),
        ({"c_over_m": -3.0}, "c/m = -3"),
        ({"alpha": 1.5, "c_over_m": -3.0}, "not a monotonic function.*c/m = -3"),
    ],
)
def test_models_that_cannot_be_controlled_are_refused_in_words(changed, words):
    with pytest.raises(ValueError, match=words):
        feed_forward(model(**changed))


def test_feed_forward_undoes_offset_sign_and_gain():
    """The command's input, put through the fitted model's own prediction, is the trajectory."""
    bent = replace(
        model("bouc-wen", ("bias",), Preparation(0.7, True)), parameters=model("bouc-wen").parameters
        | {"bias.offset": Estimate(0.4, None, "um")},
    )  # fmt: skip
    forward = feed_forward(bent)
    wanted = 0.4 + np.sin(np.linspace(0, 20, 500))
    voltage, cut = forward.input_for(wanted)
    assert not cut.any()
    signal = Signal(np.arange(500.0), -(voltage[:, None] - 0.7))
    np.testing.assert_allclose(bent.system.simulate(signal, bent.values[:, None])[:, 0], wanted, atol=1e-9)
    limited, cut = forward.input_for(wanted, limit=1.0)
    assert cut.any()
    np.testing.assert_array_equal(np.abs(limited[cut]), 1.0)


def test_references_have_their_derivatives_and_delay_floor():
    found = {each.name: each for each in published_references(2.0, RATE)}
    assert set(found) == {"ramp", "damped-sine", "sine-10-hz", "sine-30-hz", "sine-50-hz", "complex"}
    sine, omega = found["sine-50-hz"], 2 * np.pi * 50
    scored = slice(sine.history, -1)
    np.testing.assert_allclose(sine.velocity[scored], 2 * omega * np.cos(omega * sine.time[scored]), atol=0.2)
    np.testing.assert_allclose(sine.acceleration[scored], -(omega**2) * sine.position[scored], atol=omega**2 * 1e-3)
    falling = found["damped-sine"]
    crossings = falling.time[1:][np.diff(np.sign(falling.position)) != 0]
    np.testing.assert_allclose(np.diff(crossings), 1.0, atol=2 / RATE)  # 0.5 Hz, as section 5.1 prints it
    assert sine.delay_floor == pytest.approx(2 * omega / RATE / np.sqrt(2), rel=1e-2)
    assert max(np.abs(each.position).max() for each in found.values()) <= 2.0


@pytest.fixture
def invoke():
    group = Group("main", commands=[control])

    def run(*arguments):
        return CliRunner().invoke(group, ["control", *map(str, arguments)])

    return run


def test_command_makes_an_input_that_follows_a_trajectory(tmp_path, invoke):
    write_model(tmp_path / "model.json", model("bouc-wen"))
    time = np.linspace(0, 4, 400)
    wanted = pd.DataFrame({"time [s]": time, "output [um]": 2.0 * np.sin(3 * time)})
    wanted.to_csv(tmp_path / "wanted.csv", index=False)
    out = ("--out", tmp_path / "out")
    assert invoke(tmp_path / "model.json", "--reference", tmp_path / "wanted.csv", *out).exit_code == 0
    made = pd.read_csv(tmp_path / "out" / "feed-forward.csv")
    assert list(made) == ["time [s]", "input [V]", "output [um]", "at_limit"]
    fitted = read_model(tmp_path / "model.json")
    signal = Signal(time, made["input [V]"].to_numpy()[:, None])
    reached = fitted.system.simulate(signal, fitted.values[:, None])[:, 0]
    np.testing.assert_allclose(reached, wanted["output [um]"], atol=1e-9)
    limited = ("--reference", tmp_path / "wanted.csv", "--voltage-limit", "1.5", *out)
    told = invoke(tmp_path / "model.json", *limited)
    assert "are cut" in " ".join(told.output.split())
    assert pd.read_csv(tmp_path / "out" / "feed-forward.csv")["at_limit"].sum() > 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "--rig NAME"),
        (("--rig", "peas"), 'Did you mean "pea"'),
        (("--rig", "sma"), "These can: pea"),
        (("--rig", "pea", "--rate", "1e9"), "choose one from 200 to 1e+06"),
    ],
)
def test_command_says_what_it_needs(tmp_path, invoke, arguments, words):
    write_model(tmp_path / "model.json", model())
    told = invoke(tmp_path / "model.json", *arguments)
    assert told.exit_code == 2
    assert words in " ".join(told.stderr.split())


@pytest.mark.long
def test_command_on_the_rig_beats_the_feed_forward_everywhere_and_writes_a_page(tmp_path, invoke):
    path = tmp_path / "model.json"
    write_model(path, model())
    told = invoke(path, "--rig", "pea", "--rate", "4000", "--out", tmp_path / "out")
    assert told.exit_code == 0, told.output
    scores = pd.read_csv(tmp_path / "out" / "control.csv")
    assert len(scores) == 6 * 7
    assert not scores.isna().any(axis=None)
    errors = scores.pivot(index="reference", columns="controller", values="t_rmse")
    assert (errors[SLIDING] < errors[FEED_FORWARD]).all()
    page = (tmp_path / "out" / "control.html").read_text()
    assert page.count("<svg") == len(list((tmp_path / "out" / "figures").glob("*.svg"))) == 12
    assert not re.search(r"\bnan\b", page, re.IGNORECASE)


def test_track_scores_only_past_the_history():
    time = np.arange(200) / 1000.0
    reference = Reference("step", time, np.where(time > 0, 1.0, 0.0), history=100)
    law = ProportionalIntegral(section.gain, 0.0, 0.0, 1e-3)
    rng = np.random.default_rng(0)
    run = track(StandIn().plant(1000.0), law, feed_forward(model()), reference=reference, limit=5.0, rng=rng)
    assert run.error.size == 100
    assert run.scores()["t_error"] < 0.5 < np.abs(reference.position - run.displacement)[:100].max()
