"""Is hysteresis needed? Laws without memory pass for what they are, loops for loops, on made and on real data."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lsim

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.diagnosis.evidence import memory as evidence
from hysteresis_bench.diagnosis.evidence.memory import Memory
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.signals import INDEX, Record

TIME = np.arange(2000) / 500.0
SINE = 5.0 * np.sin(2 * np.pi * 2 * TIME)
SWEEP = 5.0 * np.sin(2 * np.pi * (0.5 + 1.5 * TIME) * TIME)
NESTED = SINE * np.exp(-TIME / 2)


def memory(records: list[Record]) -> Memory:
    return evidence.memory(views_of(records))


def system(numerator: list[float], denominator: list[float]) -> Callable[[Array], Array]:
    return lambda u: lsim((numerator, denominator), u - u[0], TIME)[1] + u[0]


def relays(u: Array) -> Array:
    """A small Preisach model: relays that switch up and down at different inputs."""
    centre, width = (grid.ravel()[:, None] for grid in np.meshgrid(np.linspace(-3, 3, 12), np.linspace(0.3, 2, 6)))
    state = np.where(u[0] > centre, 1.0, -1.0)
    out = np.empty(u.size)
    for i, value in enumerate(u):
        state = np.where(value > centre + width, 1.0, np.where(value < centre - width, -1.0, state))
        out[i] = state.mean()
    return out + 0.1 * u


def records(law: Callable[[Array], Array], inputs: list[Array], noise: float) -> list[Record]:
    rng = np.random.default_rng(31)
    outputs = [law(u) for u in inputs]
    return [
        Record(TIME, u, y + noise * np.ptp(y) * rng.standard_normal(u.size), name=str(number))
        for number, (u, y) in enumerate(zip(inputs, outputs, strict=True))
    ]


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize(
    ("law", "inputs"),
    [
        (np.tanh, [SINE]),
        (lambda u: 2.0 * u + 1.0, [NESTED]),
        (system([1.0], [0.02, 1.0]), [SWEEP]),
        (system([80.0**2], [1.0, 16.0, 80.0**2]), [SWEEP]),
        (lambda u: np.interp(TIME - 0.02, TIME, u), [SINE, SWEEP]),
        (lambda u: np.interp(TIME - 0.005, TIME, np.tanh(u / 3)), [SINE]),
        (lambda u: system([1.0], [0.01, 1.0])(np.tanh(u / 3)), [SINE, SWEEP]),
    ],
    ids=["curve", "line", "lag", "resonance", "delay", "curve and delay", "curve, then lag"],
)
def test_laws_without_memory_need_no_hysteresis(law: Callable, inputs: list[Array], noise: float) -> None:
    assert not memory(records(law, inputs, noise)).needed


@pytest.mark.parametrize(("unit", "told"), [("s", "0.02 s ago"), ("ms", "20 ms ago")])
def test_the_best_law_without_memory_is_told_in_the_unit_of_time(unit: str, told: str) -> None:
    delayed = records(lambda u: np.interp(TIME - 0.02, TIME, np.tanh(u / 3)), [SWEEP], 0.0)
    scale = 1000.0 if unit == "ms" else 1.0
    in_unit = [replace(one, time=scale * one.time, units={**one.units, "time": unit}) for one in delayed]
    assert f"(curve of the input {told})" in memory(in_unit).words


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize("inputs", [[SINE], [NESTED], [SWEEP, SINE]], ids=["one amplitude", "nested", "sweep"])
def test_loops_need_hysteresis(inputs: list[Array], noise: float) -> None:
    answer = memory(records(relays, inputs, noise))
    assert answer.needed
    assert answer.p < 1e-4
    assert answer.branch_rmse < answer.dynamic_rmse <= answer.static_rmse


@pytest.mark.parametrize("samples", [2000, 500, 129])
def test_an_index_is_no_time(samples: int) -> None:
    """One closed loop without a time base, from its tip."""
    u = 5.0 * np.cos(2 * np.pi * np.arange(samples) / (samples - 1))
    loop = relays(np.concatenate([u, u]))[samples:]
    units = {"time": INDEX, "input": "1", "output": "1"}
    answer = memory([Record(np.arange(float(samples)), u, loop, units=units)])
    assert answer.needed
    assert answer.law == "static curve"
    assert not memory([Record(np.arange(float(samples)), u, u**3, units=units)]).needed


def test_a_long_lag_at_one_speed_is_called_ambiguous() -> None:
    sine = memory(records(lambda u: np.interp(TIME - 0.04, TIME, u), [SINE], 0.005))
    assert sine.ambiguous or not sine.needed
    assert not memory(records(lambda u: np.interp(TIME - 0.04, TIME, u), [SINE, SWEEP], 0.005)).needed


def test_a_drift_ten_times_the_loop_hides_nothing() -> None:
    def drifting(law: Callable[[Array], Array]) -> Callable[[Array], Array]:
        return lambda u: law(u) + 10.0 * np.ptp(relays(u)) * TIME / TIME[-1]

    def judged(law: Callable[[Array], Array]) -> Memory:
        return memory([record.take(slice(None, None, 4)) for record in records(law, [NESTED], 2e-4)])

    answer = judged(drifting(relays))
    assert answer.needed
    assert answer.explained == pytest.approx(judged(relays).explained, rel=0.1)
    assert not judged(drifting(np.tanh)).needed


def test_what_no_law_explains_is_not_judged() -> None:
    """A loop that fades with the path travelled and swells with a temperature: branches that stay are no better."""
    hidden = {"effects": ("fatigue", "temperature-sensitivity"), "draw": 3, "model": "bouc-wen"}
    rig = registry.build("rigs", "hidden-effects", hidden)
    rng = np.random.default_rng(7)
    measured = [rig.measure(name, rng).records[0] for name in ("slow", "fast", "nested", "sweep")]
    answer = memory([record.take(slice(None, None, 4)) for record in measured])
    assert not answer.needed
    assert answer.ambiguous
    assert "cannot be judged" in answer.words


def test_delays_are_found() -> None:
    answer = memory(records(lambda u: np.interp(TIME - 0.004, TIME, u), [SINE, SWEEP], 0.002))
    assert answer.delays == pytest.approx((0.004, 0.004), abs=0.0008)


def test_an_output_that_has_nothing_to_do_with_the_input() -> None:
    rng = np.random.default_rng(32)
    for output in (rng.standard_normal(TIME.size), np.full(TIME.size, 2.0)):
        answer = memory([Record(TIME, SINE, output)])
        assert not answer.needed
        assert answer.p > 0.01


def test_history_is_simulated_and_not_scored() -> None:
    output = relays(SINE)
    output[:300] = 100.0
    assert memory([Record(TIME, SINE, output, history=300)]).static_rmse < 1.0


def real(folder: Path, timed: bool = True) -> list[Record]:
    found = [record for file in sorted(folder.glob("*.csv")) for record in read_data([file]).records]
    if timed:
        return found[:8]
    return [replace(record, units={**record.units, "time": INDEX}) for record in found[:8]]


def test_linear_capacitor_needs_none(real_data: Path) -> None:
    """Its tester delays by 1.8, 0.8 and, from 400 Hz, 13 us: see the folder's README."""
    answer = memory(real(real_data / "linear-capacitor-reference"))
    assert not answer.needed
    assert np.array(answer.delays[2:]) == pytest.approx(13e-6, rel=0.1)


@pytest.mark.parametrize(
    ("folder", "timed"),
    [
        ("piezo-picma-ntu", True),
        ("magcore-go-steel-m130", False),
        ("magcore-mnzn-ferrite", False),
        ("ferroelectric-hfo2-film", True),
        ("ferroelectric-pzt-film-a", True),
        ("ferroelectric-fefet-stack", True),
        ("sma-isobaric-tamu", False),
    ],
)
def test_hysteretic_materials_need_it(real_data: Path, folder: str, timed: bool) -> None:
    found = real(real_data / folder, timed)
    if folder.startswith("piezo"):
        found = [record.skip(0.5) for record in found]
    assert memory(found).needed


def test_shares_and_chances_are_told_as_the_pages_tell_them() -> None:
    told = memory(records(relays, [SINE, NESTED], 0.001)).words
    assert re.search(r"leaves \d+\.\d\d % of the output's range; branches explain \d+\.\d\d % \(p < 0\.001\)", told)
