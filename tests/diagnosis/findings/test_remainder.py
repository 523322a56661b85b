"""Slow noise is as loud where nothing was fitted: what is missed there by more has a cause."""

from dataclasses import replace
from types import SimpleNamespace as Of

import numpy as np
import pytest

from hysteresis_bench.diagnosis.evidence.autocorrelated import equally_loud
from hysteresis_bench.diagnosis.findings.remainder import (
    Remainder,
    _averaged,
    _hidden,
    _louder,
    _missed_by_its_own_noise,
    other_zero,
)

RECORDS, SAMPLES, PARAMETERS = 4, 800, 4


def stage(held_out):
    """held_out : RMSE, None where nothing is held out."""
    return Of(held_out=None if held_out is None else Of(rmse=held_out), missed=held_out)


def residuals(seed, decay=0.9):
    """Autoregressive noise of unit variance, a record each."""
    rng, parts = np.random.default_rng(seed), []
    for _ in range(RECORDS):
        part = np.empty(SAMPLES)
        part[0] = rng.standard_normal()
        for i, step in enumerate(np.sqrt(1.0 - decay**2) * rng.standard_normal(SAMPLES - 1), 1):
            part[i] = decay * part[i - 1] + step
        parts.append(part)
    return parts


def test_another_record_of_the_same_noise_is_not_louder():
    called = 0
    for seed in range(200):
        *fitted, other = [*residuals(seed), residuals(1000 + seed)[0]]
        called += _louder(stage(float(np.sqrt(np.mean(other**2)))), fitted, 0.0, PARAMETERS)
    assert called <= 6  # level 0.01; more than 6 of 200 has a probability of 0.004


@pytest.mark.parametrize("held_out", [1.8, 3.0])
def test_what_is_missed_by_much_more_is_louder(held_out):
    assert _louder(stage(held_out), residuals(1), 1.0, PARAMETERS)


def test_of_more_parameters_the_fit_is_expected_to_leave_less_than_the_noise():
    assert _louder(stage(1.4), residuals(1), 1.0, PARAMETERS)
    assert not _louder(stage(1.4), residuals(1), 1.0, 80)


def test_where_nothing_was_held_out_nothing_is_louder():
    assert not _louder(stage(None), residuals(1), 1.0, PARAMETERS)


def test_a_fit_below_the_noise_makes_nothing_else_louder():
    assert _louder(stage(1.0), [0.7 * part for part in residuals(1, decay=0.0)], 0.0, PARAMETERS)
    assert not _louder(stage(1.0), [0.7 * part for part in residuals(1, decay=0.0)], 1.0, PARAMETERS)


@pytest.mark.parametrize("decay", [0.0, 0.5, 0.9, 0.98])
def test_slow_noise_is_as_loud_at_one_time_as_at_another(decay):
    p = np.array([equally_loud(residuals(seed, decay)) for seed in range(150)])
    assert np.sum(p < 0.01) <= 5  # more than 5 of 150 has a probability of 0.004
    assert np.mean(p < 1.0) > 0.5  # most are long enough to be asked


def test_what_comes_with_the_drive_is_not():
    """Where it moves fast a model is off, elsewhere the noise alone is left."""
    rng, fast = np.random.default_rng(4), np.sin(np.linspace(0.0, 3.0 * np.pi, SAMPLES)) > 0.3
    parts = [np.where(fast, 3.0, 0.0) * slow + rng.standard_normal(SAMPLES) for slow in residuals(2)]
    assert equally_loud(_averaged(parts, 1.0)) < 1e-6


def test_noise_from_sample_to_sample_may_be_louder_at_some_times():
    rng, louder = np.random.default_rng(5), np.linspace(0.4, 1.6, SAMPLES)
    parts = [slow + louder * rng.standard_normal(SAMPLES) for slow in residuals(3)]
    assert equally_loud(parts) < 0.01
    assert equally_loud(_averaged(parts, 1.0)) > 0.05


@pytest.mark.parametrize("parts", [[np.zeros(200)], [np.ones(12)], residuals(1, 0.999)[:1]])
def test_of_too_little_nothing_is_said_of_how_loud_it_is(parts):
    assert equally_loud(parts) == 1.0


def test_noise_of_many_independent_samples_hides_little():
    parts = residuals(1)
    assert _hidden(parts, 14) < 0.5 * np.sqrt(np.mean(np.concatenate(parts) ** 2))


def test_one_loop_hides_almost_all_that_it_leaves():
    """A smooth misfit, two loops of it: whatever the number of samples, it is a handful of independent ones."""
    phase = np.linspace(0.0, 2.0 * np.pi, 2000)
    parts = [np.sin(2.0 * phase), np.cos(2.0 * phase)]
    assert _hidden(parts, 14) > 0.9 * np.sqrt(np.mean(np.concatenate(parts) ** 2))


@pytest.mark.parametrize(
    ("rmse", "constant", "told"),
    [
        (1.1, 1.0, True),
        (1.1, 0.7, False),  # the shape is missed as well
        (0.15, 0.14, False),  # at the noise of 0.1
    ],
)
def test_a_zero_that_lies_elsewhere_is_told(rmse, constant, told):
    words = other_zero(Of(held_out=Of(rmse=rmse), constant=constant), 0.1, " um")
    assert bool(words) is told
    if told:
        assert "1 um is a constant" in words
        assert "0.458 um is left" in words


def test_without_held_out_records_no_zero_is_missed():
    assert other_zero(Of(held_out=None, constant=0.0), 0.1, "") == ""


@pytest.mark.parametrize(
    ("slow", "heavy", "matters"), [(True, False, True), (False, True, True), (False, False, False)]
)
def test_what_was_predicted_is_no_noise(slow, heavy, matters):
    left = Remainder(None, matters=False, slow=slow, heavy=heavy, louder=False).of_a_cause()
    assert (left.matters, left.noise) == (matters, False)


def of_own_noise(left, noises, significant=True):
    """What is said where records of these noises leave so much;  left, noises : RMS, a record each."""
    names = "slow", "fast", "third"
    rng = np.random.default_rng(7)
    views = [
        Of(
            record=Of(name=name, input=np.linspace(0.0, 1.0, SAMPLES), measured=np.ones(1), steps=1, input_error=0.0),
            y=np.ones(1),
        )
        for name in names
    ]
    for view, noise in zip(views, noises, strict=True):
        view.noise = Of(floor=noise)
    parts = [rms * rng.standard_normal(SAMPLES) for rms in left]
    tests = [Of(record=name, name="noise-floor", significant=significant) for name in names]
    pooled = float(np.sqrt(np.mean(np.square(noises))))
    whole = Of(tests=tests, fitted=Of(rmse=float(np.sqrt(np.mean(np.square(left))))))
    return _missed_by_its_own_noise(whole, views, parts, pooled)


def test_a_quiet_record_is_not_excused_by_the_noise_of_a_loud_one():
    said = of_own_noise([0.2, 0.2, 0.2], [0.03, 0.3, 0.3])
    assert said.startswith("slow is missed by 6.")
    assert not of_own_noise([0.2, 0.2, 0.2], [0.03, 0.3, 0.3], significant=False)


@pytest.mark.parametrize(
    ("left", "noises"),
    [
        ([0.03, 0.3, 0.3], [0.03, 0.3, 0.3]),  # each as loud as its own noise
        ([0.05, 0.3, 0.3], [0.03, 0.3, 0.3]),
        ([0.4, 0.4, 0.4], [0.1, 0.1, 0.1]),  # slow noise: all are beyond that from sample to sample
        ([0.5, 0.4, 0.3], [0.1, 0.1, 0.1]),
    ],
)
def test_a_record_is_not_singled_out_where_all_are_alike(left, noises):
    assert not of_own_noise(left, noises)


def test_a_few_samples_that_are_far_off_are_no_fault_of_a_record():
    rng = np.random.default_rng(3)
    record = Of(name="slow", input=np.linspace(0.0, 1.0, SAMPLES), measured=np.ones(1), steps=1, input_error=0.0)
    part = rng.standard_normal(SAMPLES)
    part[::100] += 40.0
    whole = Of(tests=[Of(record="slow", name="noise-floor", significant=True)], fitted=Of(rmse=1.0))
    view = Of(record=record, y=np.ones(1), noise=Of(floor=1.0))
    assert not _missed_by_its_own_noise(whole, [view], [part], 1.0)
    assert _missed_by_its_own_noise(whole, [view], [3.0 * part], 1.0)


def test_a_record_in_which_slow_noise_seems_to_have_a_cause_is_told():
    slow = Remainder(None, False, True, False, False)
    assert "depends on nothing that was measured here, and no term" in slow.told_as_noise(1.3)
    said = replace(slow, alone=("grw", "dec")).told_as_noise(1.3)
    assert "nothing that was measured here in all records together, though in grw and dec it seems to, and no" in said
