"""Records with one fault each: the same names as without it, and the fault is told."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure, registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.evidence.noise import noise
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.signals import Dataset, Record

pytestmark = pytest.mark.usefixtures("few_laws")

RECORDS = ("slow", "fast", "nested", "mixed")
VALUES = np.array([[0.6], [0.35], [0.15], [1.3]])
"""alpha, beta, gamma, d of a Bouc-Wen law for inputs of a few units."""

TEMPTING = ("asymmetry", "backlash", "bias", "creep", "drift", "eddy-current", "leakage", "output-lag", "resonance")
"""Effects that are there, or that the fault is like: all others together take twice as long again."""

NOTHING_HIDDEN = [((), TEMPTING), pytest.param((), None, marks=pytest.mark.long)]
"""Of those that tempt, and of all there are."""


def found_in(imperfect, effects=(), among=TEMPTING):
    settings = {"model": "bouc-wen", "imperfect": imperfect, "effects": effects, "noise": 0.004}
    data = measure("hidden-effects", *RECORDS, settings=settings, seed=3).split(RECORDS[-1:])
    asked = among and (*among, *effects)
    return diagnose(data, Question("bouc-wen", among=asked, options=DiagnosisOptions(jobs=1))), data


@pytest.mark.parametrize(
    ("effects", "among"), [*NOTHING_HIDDEN, pytest.param(("creep",), TEMPTING, marks=pytest.mark.long)]
)
def test_slow_noise_is_told_as_noise_and_not_as_a_wrong_law(effects, among):
    found, _ = found_in("coloured", effects, among)
    assert found.effects == effects
    assert found.verdict == ("effect-found" if effects else "no-effect-needed")
    assert any("depends on nothing that was measured here" in one for one in found.warnings)
    assert not any("law does not follow" in one for one in found.warnings)


@pytest.mark.parametrize(
    ("effects", "among"), [*NOTHING_HIDDEN, pytest.param(("creep",), TEMPTING, marks=pytest.mark.long)]
)
def test_noise_of_heavy_tails_is_told_as_noise(effects, among):
    found, _ = found_in("heavy-tailed", effects, among)
    assert found.effects == effects
    assert found.verdict == ("effect-found" if effects else "no-effect-needed")
    assert any("noise of heavy tails" in one for one in found.warnings)


def test_what_a_stuck_channel_says_is_left_out_and_told():
    found, data = found_in("stuck", ("creep",))
    assert found.effects == ("creep",)
    assert sum("did the channel hang" in one for one in found.warnings) == len(data.records)
    assert found.after.held_out.rmse < 1.15 * data.hidden["noise"]


def test_spikes_are_bridged_and_told_and_do_not_change_what_is_found():
    found, data = found_in("spiked", ("saturation",))
    assert found.effects == ("saturation",)
    assert sum("far off" in one for one in found.warnings) == len(data.records)
    assert found.after.held_out.rmse < 1.15 * data.hidden["noise"]
    assert np.max(np.abs(data.records[0].output)) > 0.0  # the caller's own records are as they were


@pytest.mark.long
def test_noise_on_the_measured_input_is_no_dead_band_and_a_wider_one_is():
    clean, _ = found_in("noisy-input")
    assert clean.effects == ()
    (row,) = [candidate for candidate in clean.candidates if candidate.effect == "backlash"]
    assert row.p > 0.01
    with_band, _ = found_in("noisy-input", ("backlash",))
    assert with_band.effects == ("backlash",)


@pytest.mark.parametrize(
    ("law", "effects", "seed"),
    [pytest.param("jiles-atherton", ("creep",), 3, marks=pytest.mark.long), ("bouc-wen", (), 4)],
)
def test_records_that_begin_in_mid_loop_are_told_and_nothing_makes_up_for_it(law, effects, seed, names_only):
    """Of the last one, what the beginnings leave raises the fitted error by 16 %, and that of what is held out
    threefold."""
    settings = {"model": law, "imperfect": "in-mid-loop", "effects": effects, "noise": 0.004}
    data = measure("hidden-effects", *RECORDS, settings=settings, seed=seed).split(RECORDS[-1:])
    with names_only():
        found = diagnose(data, Question(law, among=TEMPTING, options=DiagnosisOptions(jobs=1)))
    assert found.effects == effects
    assert found.verdict == ("effect-found" if effects else "no-effect-needed")
    assert any("begin in mid-loop" in one for one in found.warnings)
    assert found.after.held_out.rmse < 1.1 * data.hidden["noise"]


@pytest.mark.long
def test_what_still_settles_from_before_the_records_is_no_leakage(names_only):
    """Without the beginnings alone a creep had a leakage beside it, that its state at the first sample asked for."""
    settings = {"model": "bouc-wen", "imperfect": "in-mid-loop", "effects": ("creep",), "draw": 25903}
    data = measure("hidden-effects", *RECORDS, settings=settings, seed=61920417).split(RECORDS[-1:])
    with names_only():
        found = diagnose(data, Question("bouc-wen", among=TEMPTING, options=DiagnosisOptions(jobs=1)))
    assert found.effects == ("creep",)
    assert found.after.held_out.rmse < 1.15 * data.hidden["noise"]


def test_an_effect_that_acts_all_along_is_not_laid_on_the_beginnings():
    found, _ = found_in("", ("creep",))
    assert found.effects == ("creep",)
    assert not any("begin in mid-loop" in one for one in found.warnings)


@pytest.mark.long
def test_nor_is_one_that_little_is_left_of_beyond_them(names_only):
    """Behind the beginnings the asymmetry is a third of the noise, and significant."""
    settings = {"model": "prandtl-ishlinskii-modified", "effects": ("asymmetry", "output-lag"), "draw": 95014}
    records = ("slow", "fast", "nested", "sweep", "mixed")
    data = measure("hidden-effects", *records, settings=settings, seed=0).split(records[-1:])
    with names_only():
        question = Question("prandtl-ishlinskii-modified", among=TEMPTING, options=DiagnosisOptions(jobs=1))
        found = diagnose(data, question)
    assert found.effects == ("output-lag", "asymmetry")
    assert not any("begin in mid-loop" in one for one in found.warnings)


@pytest.mark.parametrize("names", [(), pytest.param(("transport-delay",), marks=pytest.mark.long)])
def test_a_lag_that_only_smooths_a_noisy_input_is_not_named(names, names_only):
    """It took the noise off in the first, and the place of the delay in the second."""
    settings = {"model": "jiles-atherton", "effects": names, "draw": 3563, "imperfect": "noisy-input"}
    records = ("slow", "fast", "nested", "sweep", "mixed")
    data = measure("hidden-effects", *records, settings=settings, seed=3).split(records[-1:])
    among = (*TEMPTING, "input-lag", "transport-delay", "second-order-input-lag", "second-order-lag")
    with names_only():
        found = diagnose(data, Question("jiles-atherton", among=among, options=DiagnosisOptions(jobs=1)))
    assert found.effects == names
    assert any("The input is measured with noise" in one for one in found.warnings)
    assert found.after.held_out.rmse < 1.1 * data.hidden["noise"]


def test_an_input_that_is_rough_by_itself_is_not_smoothed():
    time, rng = np.arange(6400) * 5e-4, np.random.default_rng(5)
    records = []
    for k in range(3):
        phases = rng.uniform(0.0, 2.0 * np.pi, 7)
        tones = zip((0.7, 1.3, 2.2, 17.0, 29.0, 41.0, 58.0), (1, 1, 1, 0.08, 0.08, 0.08, 0.08), phases, strict=True)
        u = sum(size * np.sin(2.0 * np.pi * f * time + phase) for f, size, phase in tones)
        y = System(registry.build("models", "bouc-wen")).simulate(Record(time, u, None).signal, VALUES)[:, 0]
        y = y + 0.004 * np.ptp(y) * rng.standard_normal(y.size)
        records.append(Record(time[::8], u[::8], y[::8], f"r{k}"))
    found = diagnose(Dataset(tuple(records), ("r2",)), Question("bouc-wen", options=DiagnosisOptions(jobs=1)))
    assert found.effects == ()
    assert not any("The input is measured with noise" in one for one in found.warnings)


@pytest.mark.parametrize(
    ("law", "imperfect", "draw", "names"),
    [
        ("jiles-atherton", "coarse", 3593, ()),  # a resonance was named that bends the loop as the steps do
        # with a delay that is not there
        pytest.param("bouc-wen", "coarse", 74375, ("eddy-current",), marks=pytest.mark.long),
    ],
)
def test_no_name_makes_up_for_what_lies_between_few_samples(law, imperfect, draw, names, names_only):
    settings = {"model": law, "effects": names, "draw": draw, "imperfect": imperfect}
    records = ("slow", "fast", "nested", "sweep", "mixed")
    data = measure("hidden-effects", *records, settings=settings, seed=201).split(records[-1:])
    with names_only():
        found = diagnose(data, Question(law, among=(*TEMPTING, "transport-delay"), options=DiagnosisOptions(jobs=1)))
    assert found.effects == names
    assert any("The samples are few for this law: it was simulated with 4 steps" in one for one in found.warnings)
    assert found.after.held_out.rmse < 1.15 * data.hidden["noise"]
    assert found.model.preparation.steps == 4
    assert found.model.errors(data)["mixed"].rmse == pytest.approx(found.after.held_out.rmse)
    sound = measure("hidden-effects", "stairs", settings={**settings, "imperfect": ""}, seed=201)
    (predicted,), (record,) = found.model.predict(sound).records, sound.records
    assert np.sqrt(np.mean((predicted.output - record.output) ** 2)) < 1.15 * data.hidden["noise"]


@pytest.mark.long
def test_a_gap_in_which_the_input_turned_is_told_and_hides_no_effect(names_only):
    """The dead band had been missed."""
    settings = {"model": "bouc-wen", "effects": ("backlash",), "draw": 3584, "imperfect": "uneven"}
    data = measure("hidden-effects", *RECORDS, "sweep", settings=settings, seed=201).split(RECORDS[-1:])
    with names_only():
        found = diagnose(data, Question("bouc-wen", among=TEMPTING, options=DiagnosisOptions(jobs=1)))
    assert found.effects == ("backlash",)
    assert any("turned in a gap" in one for one in found.warnings)
    assert found.after.held_out.rmse < 1.15 * data.hidden["noise"]
    sound = measure("hidden-effects", "stairs", settings={**settings, "imperfect": ""}, seed=201)
    (predicted,), (record,) = found.model.predict(sound).records, sound.records
    assert np.sqrt(np.mean((predicted.output - record.output) ** 2)) < 1.15 * data.hidden["noise"]


def test_many_samples_are_taken_as_they_are():
    found, _ = found_in("")
    assert not any("The samples are few" in one for one in found.warnings)


def test_a_hum_that_passes_for_noise_is_named(names_only):
    """Of four samples a period it looks like noise of six times the noise, which is more than the bare law leaves."""
    settings = {"model": "jiles-atherton", "effects": ("periodic-disturbance",), "draw": 8132, "imperfect": "coarse"}
    records = ("slow", "fast", "nested", "sweep", "mixed")
    data = measure("hidden-effects", *records, settings=settings, seed=3).split(records[-1:])
    with names_only():
        among = (*TEMPTING, "periodic-disturbance")
        found = diagnose(data, Question("jiles-atherton", among=among, options=DiagnosisOptions(jobs=1)))
    assert found.effects == ("periodic-disturbance",)
    assert found.after.held_out.rmse < 1.1 * data.hidden["noise"]
    assert found.noise.floor < 1.3 * data.hidden["noise"]


def test_a_slip_is_no_drift_in_a_diagnosis(names_only):
    """It had been named `drift`, and unseen records had been missed by several times the noise."""
    settings = {"model": "bouc-wen", "noise": 0.004, "draw": 1}
    records = measure("hidden-effects", "slow", "fast", "nested", "mixed", settings=settings, seed=1).records
    rising = np.where(np.arange(800) >= 360, 0.2 * np.ptp(records[1].output), 0.0)
    faulty = [replace(one, output=one.output + rising) if one.name in ("fast", "mixed") else one for one in records]
    with names_only():
        question = Question("bouc-wen", among=TEMPTING, options=DiagnosisOptions(jobs=1))
        found = diagnose(Dataset(tuple(faulty), ("mixed",)), question)
    assert (found.verdict, found.effects) == ("no-effect-needed", ())
    assert found.after.held_out.rmse < 1.1 * found.floor
    assert sum("slipped" in said for said in found.warnings) == 2


def controlled(reference, noise, step, drift):
    """Input and measured output of a Bouc-Wen device that an integral controller makes follow a reference.

    reference, noise : (samples,);  step : s;  drift : of the output, a unit of time
    """
    u, y = np.zeros(reference.size), np.zeros(reference.size)
    z = 0.0
    for k in range(reference.size):
        if k:
            u[k] = u[k - 1] + 2.0 * np.pi * 40.0 * step * (reference[k - 1] - y[k - 1]) / 0.8
        du = (u[k] - (u[k - 1] if k else 0.0)) / 30.0
        for _ in range(30):
            z += 4.0 * du - 6.0 * abs(du) * z + 2.0 * du * abs(z)
        y[k] = 0.6 * u[k] - 0.3 * z + drift * step * k + noise[k]
    return u, y


@pytest.mark.parametrize(("drift", "names"), [(0.0, ()), (0.03, ("drift",))])
def test_what_a_controller_feeds_back_is_no_noise_and_no_effect(drift, names):
    rng, time, level = np.random.default_rng(9), np.linspace(0.0, 4.0, 800), 0.01
    records = []
    for name, (slow, fast) in {"one": (0.5, 2.0), "two": (0.8, 3.3), "three": (0.35, 1.4)}.items():
        reference = 0.5 * np.sin(2.0 * np.pi * slow * time) + 0.3 * np.sin(2.0 * np.pi * fast * time)
        u, y = controlled(reference, level * rng.standard_normal(time.size), float(time[1]), drift)
        records.append(Record(time, u, y, name))
    data = Dataset(tuple(records), ("three",))
    assert noise(records[0]).floor > 1.5 * level
    found = diagnose(data, Question("bouc-wen", among=TEMPTING, options=DiagnosisOptions(jobs=1)))
    assert found.effects == names
    assert found.verdict == ("effect-found" if names else "no-effect-needed")
    assert names or found.floor == pytest.approx(level, rel=0.1)  # known where the bare law explains what moves fast
    assert found.after.held_out.rmse < 1.1 * level
