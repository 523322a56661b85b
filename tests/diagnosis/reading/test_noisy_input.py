"""Smoothed inputs: as much is taken off as their noise has, and corners stay."""

from dataclasses import replace
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.reading.noisy_input import with_smooth_inputs
from hysteresis_bench.signals import Dataset, Record
from tests.diagnosis.search.handmade import fit


def sine(time):
    return np.sin(2.0 * np.pi * time) * (1.0 - 0.1 * time)


def triangle(time):
    return 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * time))


@pytest.mark.parametrize("drive", [sine, triangle])
@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("share", [0.001, 0.01])
def test_most_of_the_noise_is_taken_off(drive, uneven, share):
    rng = np.random.default_rng(1)
    time = np.linspace(0.0, 4.0, 1200)
    time = np.sort(rng.choice(time, 800, replace=False)) if uneven else time
    true, noise = drive(time), share * rng.standard_normal(time.size)
    (smooth,) = with_smooth_inputs([Record(time, true + noise, true)])
    left = smooth.input - true
    assert np.sqrt(np.mean(left**2)) < 0.5 * np.sqrt(np.mean(noise**2))
    assert np.max(np.abs(left)) < 4.0 * share
    assert 0.6 < smooth.input_error / np.sqrt(np.mean(left**2)) < 1.4


@pytest.mark.parametrize("step", [0.003, 0.01, 0.03])
def test_an_encoders_steps_are_taken_off(step):
    """Slower than a step a sample in half of the record, where most differences are 0."""
    time = np.linspace(0.0, 4.0, 1200)
    true = 0.5 * np.sin(np.pi * time) + 0.5 * np.sin(np.pi * time**2 / 4.0)
    read = Record(time, step * np.rint(true / step), true)
    known, (smooth,) = gather(views_of([read])), with_smooth_inputs([read])
    assert known.noise.input_rms == pytest.approx(step / np.sqrt(12.0), rel=0.1)
    assert known.noise.input_heard
    assert np.sqrt(np.mean((smooth.input - true) ** 2)) < 0.6 * known.noise.input_rms


def test_an_input_without_noise_is_left_alone():
    time = np.linspace(0.0, 3.0, 900)
    for u in (sine(time), triangle(time), np.zeros(time.size)):
        record = Record(time, u, u)
        assert with_smooth_inputs([record]) == (record,)


@pytest.mark.parametrize("share", [0.0, 0.001])
def test_a_hum_on_the_input_is_noise_and_is_taken_off(share):
    rng, time = np.random.default_rng(3), np.linspace(0.0, 4.0, 1600)
    true, noise = sine(time), share * rng.standard_normal(1600)
    hum = 0.02 * np.sin(2.0 * np.pi * 50.0 * time + 0.4)
    read = Record(time, true + hum + noise, true)
    assert gather(views_of([read])).noise.input_rms == pytest.approx(np.hypot(np.std(hum), share), rel=0.02)
    (smooth,) = with_smooth_inputs([read])
    assert np.sqrt(np.mean((smooth.input - true) ** 2)) < 0.5 * share + 1e-4


def test_what_smoothing_may_leave_is_in_the_floor():
    rng, time = np.random.default_rng(2), np.linspace(0.0, 4.0, 800)
    true = triangle(time)
    output = 3.0 * true + 0.001 * rng.standard_normal(800)
    records = with_smooth_inputs([Record(time, true + 0.01 * rng.standard_normal(800), output)])
    left = output - 3.0 * records[0].input
    floor = gather(views_of(records)).floor
    assert 0.6 < floor / np.sqrt(np.mean(left**2)) < 1.4
    exact = [replace(record, input_error=0.0) for record in records]
    assert gather(views_of(exact)).floor < 0.5 * floor


class Stop(Exception):
    """The search is over."""


@pytest.mark.parametrize(("left", "again"), [(1.05, True), (1.9, True), (2.1, False), (8.4, False)])
def test_inputs_are_smoothed_only_where_their_noise_may_explain_what_is_left(monkeypatch, left, again):
    module = import_module("hysteresis_bench.diagnosis.around")
    told, found = (
        [],
        SimpleNamespace(follows=False, best=fit("", left), selection=SimpleNamespace(floor=1.0)),
    )
    prepared = SimpleNamespace(views=(), dataset=Dataset(()))
    prepared.read_as = lambda records, why: told.append(why) or prepared

    def enough(found):
        raise Stop

    heard = SimpleNamespace(input_heard=True)
    evidence = SimpleNamespace(noise=heard)
    for name, answer in (("prepare", prepared), ("gather", evidence), ("search", found), ("pooled_noise", heard)):
        monkeypatch.setattr(module, name, lambda *rest, answer=answer: answer)
    monkeypatch.setattr(module, "few_samples", enough)
    with pytest.raises(Stop):
        module.searched(Dataset(()), Question("bouc-wen"))
    assert told == ([module.SMOOTHED] if again else [])


@pytest.mark.parametrize(
    ("names", "left", "floor", "taken"),
    [
        *[("", 1.05, 0.5, True), ("", 1.07, 0.5, False), ("", 1.07, 1.02, True), ("", 1.07, 1.0, False)],
        *[("a", 1.01, 0.5, True), ("a", 1.03, 2.0, False), ("b", 0.99, 0.5, True), ("b", 1.01, 2.0, False)],
    ],
)
def test_a_smooth_input_may_leave_a_little_more_in_the_place_of_an_effect_and_less_of_another_one(
    names, left, floor, taken
):
    module = import_module("hysteresis_bench.diagnosis.around")
    assert module.explains_more(fit(names, left), fit("b", 1.0), floor) == taken
