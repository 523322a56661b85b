"""Residual tests: silent on noise of any colour, loud on what was planted, alone in naming it."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.autocorrelated import autoregression, effective_samples, f_test, overlooked
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest, p_in_words, residual_tests
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.signals import INDEX, Record

UNIT = Noise(1.0, 0.02, 0.0, 0.0, None, (1.0, 1.0, 1.0), 0.0, 1000)
TIME = np.arange(1000) / 1000.0
SINE = np.sin(2 * np.pi * 5 * TIME)
TEMPERATURE = 20.0 + 5.0 * np.sin(11.0 * TIME)
RECORD = Record(TIME, SINE, SINE, columns={"temperature": TEMPERATURE})
TRUE_OF_COLOURED_NOISE = ("whiteness", "noise-floor")


def told_of(records: list[Record], residuals: list[Array], noises: list[Noise]) -> list[ResidualTest]:
    return residual_tests([View(*pair) for pair in zip(records, noises, strict=True)], residuals)


def coloured(rho: float, rng: np.random.Generator, samples: int = TIME.size) -> Array:
    return lfilter([np.sqrt(1 - rho**2)], [1, -rho], rng.standard_normal(samples + 300))[300:]


def found(tests: list[ResidualTest]) -> set[str]:
    return {test.name for test in tests if test.significant}


@pytest.mark.parametrize(
    "rho", [0.0, pytest.param(0.5, marks=pytest.mark.long), pytest.param(0.8, marks=pytest.mark.long), 0.95]
)
def test_false_positives_on_autocorrelated_noise(rho: float) -> None:
    rng = np.random.default_rng(11)
    low, families, hypotheses = Counter[str](), 0, 100
    for _ in range(hypotheses):
        tests = told_of([RECORD], [coloured(rho, rng)], [UNIT])
        low.update(test.name for test in tests if test.p < 0.05 and test.name not in TRUE_OF_COLOURED_NOISE)
        families += bool(found(tests) - set(TRUE_OF_COLOURED_NOISE))
    assert sum(low.values()) / (hypotheses * 15) < 0.065  # 15 such tests; standard error 0.006
    assert max(low.values()) / hypotheses < 0.13
    assert families / hypotheses < 0.11


@pytest.mark.parametrize("rho", [0.0, 0.7])
@pytest.mark.parametrize(
    ("cause", "planted"),
    [
        ("offset", np.ones(TIME.size)),
        ("input", 2.0 * SINE**2 - 1.0),
        ("rate", np.gradient(SINE, TIME) / 30.0),
        ("direction", np.sign(np.gradient(SINE))),
        ("time", np.log1p(5 * TIME)),
        ("cycle", (TIME - 0.5) * SINE * 3.0),
        ("temperature", (TEMPERATURE - 20.0) / 5.0),
        ("spectral-line", 1.4 * np.sin(2 * np.pi * 50.3 * TIME)),
        ("ripple-input", 1.4 * np.sin(12.0 * np.pi * SINE)),
        ("coherence", 1.6 * 1.6 * np.sin(2 * np.pi * 5 * TIME - 0.6)),
    ],
)
def test_finds_what_was_planted(cause: str, planted: Array, rho: float) -> None:
    rng = np.random.default_rng(12)
    hits = sum(cause in found(told_of([RECORD], [coloured(rho, rng) + planted], [UNIT])) for _ in range(10))
    assert hits >= 9


def test_a_line_is_placed_and_compared_with_the_drive() -> None:
    rng = np.random.default_rng(13)
    noise = rng.standard_normal(TIME.size)
    by_name = {t.name: t for t in told_of([RECORD], [noise + np.sin(2 * np.pi * 52.5 * TIME)], [UNIT])}
    assert "no multiple of the input's frequency" in by_name["spectral-line"].words
    assert " 52 Hz" in by_name["spectral-line"].words or " 53 Hz" in by_name["spectral-line"].words
    by_name = {t.name: t for t in told_of([RECORD], [noise + np.sin(2 * np.pi * 15 * TIME)], [UNIT])}
    assert "15 Hz, 3 times the input's frequency" in by_name["spectral-line"].words
    assert by_name["spectral-line"].share == pytest.approx(0.5 / 1.5, abs=0.05)
    slow = replace(RECORD, time=1000.0 * TIME, units={**RECORD.units, "time": "ms"})
    by_name = {t.name: t for t in told_of([slow], [noise + np.sin(2 * np.pi * 15 * TIME)], [UNIT])}
    assert "0.015 cycles a ms, 3 times the input's frequency" in by_name["spectral-line"].words


@pytest.mark.parametrize("along", ["input", "output"])
def test_a_ripple_is_placed(along: str) -> None:
    """Once a tooth of a gear, or a fringe of an interferometer, whatever the time."""
    rng = np.random.default_rng(22)
    records = [Record(TIME, SINE, response := SINE**3 + 0.4 * np.cos(2 * np.pi * 5 * TIME), name="a")]
    records.append(Record(TIME, 0.7 * SINE, 0.6 * response, name="b"))
    planted = [0.02 * np.sin(14.0 * np.pi * (one.input if along == "input" else one.output)) for one in records]
    residuals = [one + 0.01 * rng.standard_normal(TIME.size) for one in planted]
    measured = [replace(one, output=one.output + left) for one, left in zip(records, residuals, strict=True)]
    told = {t.name: t for t in told_of(measured, residuals, [UNIT, UNIT]) if t.record == "all" and t.significant}
    range_ = np.ptp(records[0].input if along == "input" else records[0].output)
    cycles = 7.0 * float(range_)
    assert f"repeats itself {cycles:.2g} times over the range of the {along}" in told[f"ripple-{along}"].words
    assert told[f"ripple-{along}"].share == pytest.approx(2.0 / 3.0, abs=0.1)


@pytest.mark.parametrize("told", [True, False])
def test_what_a_converter_rounds_is_no_ripple_and_hides_none(told: bool) -> None:
    """Noise of a third of a step leaves a tenth of a step of the rounding, at the period of the grid."""
    rng, step = np.random.default_rng(25), 0.05
    time = np.arange(4000) / 1000.0
    true = np.sin(2 * np.pi * 1.7 * time) + 0.3 * np.cos(2 * np.pi * 0.6 * time)
    other = 0.01 * np.sin(2 * np.pi * true / 0.13) if told else 0.0
    measured = step * np.round((true + other + 0.3 * step * rng.standard_normal(4000)) / step)
    noise = replace(UNIT, rms=0.02, quantum=step)
    names = found(told_of([Record(time, true, measured)], [measured - true], [noise]))
    assert ("ripple-output" in names) == told
    assert "ripple-output" in found(
        told_of([Record(time, true, measured)], [measured - true], [replace(noise, quantum=0.0)])
    )


@pytest.mark.parametrize(
    "fault",
    [
        np.abs(SINE + 0.3),  # an edge
        np.sign(SINE - 0.2),
        np.exp(-((SINE - 0.4) ** 2) / 0.02),
        np.gradient(SINE) * np.abs(np.gradient(SINE)) * 1e3,
        np.sin(2 * np.pi * 37.0 * TIME),  # hum
    ],
)
def test_no_other_fault_is_a_ripple(fault: Array) -> None:
    residual = fault + 0.1 * np.random.default_rng(23).standard_normal(TIME.size)
    assert not {name for name in found(told_of([RECORD], [residual], [UNIT])) if name.startswith("ripple-input")}


def test_where_the_samples_lie_far_apart_no_ripple_is_looked_for() -> None:
    coarse = Record(np.arange(60.0), np.sin(np.arange(60.0)), np.sin(np.arange(60.0)))
    residual = np.random.default_rng(24).standard_normal(60)
    assert not {test.name for test in told_of([coarse], [residual], [UNIT])} & {"ripple-input", "ripple-output"}


def test_scatter_that_follows_the_input() -> None:
    rng = np.random.default_rng(14)
    noise = rng.standard_normal(TIME.size)
    assert "scatter-input" in found(told_of([RECORD], [noise * (0.3 + np.abs(SINE))], [UNIT]))
    assert "scatter-time" in found(told_of([RECORD], [noise * (0.5 + TIME)], [UNIT]))


def test_noise_floor_knows_how_sure_it_is() -> None:
    rng = np.random.default_rng(15)
    residual = 1.15 * rng.standard_normal(TIME.size)
    assert "noise-floor" in found(told_of([RECORD], [residual], [UNIT]))
    unsure = Noise(1.0, 0.2, 0.0, 0.0, None, (1.0, 1.0, 1.0), 0.0, 1000)
    assert "noise-floor" not in found(told_of([RECORD], [residual], [unsure]))


def test_past_extrema_on_nested_loops() -> None:
    rng = np.random.default_rng(16)
    u = SINE * np.exp(-TIME)
    turns = covariates.turning_points(u, 0.01)
    planted = covariates.last_extremum(u, turns) * 1.5
    assert "past-extrema" in found(told_of([Record(TIME, u, u)], [rng.standard_normal(u.size) + planted], [UNIT]))


def test_several_records_are_told_one_by_one_and_together() -> None:
    rng = np.random.default_rng(17)
    records = [Record(TIME, SINE, SINE, name=name) for name in "ab"]
    residuals = [rng.standard_normal(TIME.size) + 0.5, rng.standard_normal(TIME.size) - 0.5]
    tests = told_of(records, residuals, [UNIT, UNIT])
    assert {test.record for test in tests} == {"a", "b", "all"}
    assert {t.record for t in tests if t.name == "offset" and t.significant} == {"a", "b", "all"}
    assert all(test.corrected_p >= test.p for test in tests)


def test_without_a_time_base_nothing_is_said_of_time() -> None:
    rng = np.random.default_rng(18)
    record = Record(np.arange(1000.0), SINE, SINE, units={"time": INDEX, "input": "1", "output": "1"})
    names = {test.name for test in told_of([record], [rng.standard_normal(1000)], [UNIT])}
    assert names.isdisjoint(
        {"rate", "time", "scatter-rate", "scatter-time", "spectral-line", "coherence", "temperature"}
    )
    assert {"input", "direction", "past-extrema", "cycle"} <= names


@pytest.mark.parametrize("residual", [np.zeros(1000), np.ones(1000), 1e-300 * SINE, 1e70 * SINE])
def test_degenerate_residuals_give_numbers(residual: Array) -> None:
    for test in told_of([RECORD], [residual], [UNIT]):
        assert 0.0 <= test.p <= 1.0
        assert 0.0 <= test.share <= 1.0


def test_history_is_not_scored() -> None:
    rng = np.random.default_rng(19)
    record = Record(TIME, SINE, SINE, history=300)
    assert not found(told_of([record], [rng.standard_normal(700)], [UNIT]))


def test_effective_samples_of_an_autoregression() -> None:
    """n (1 - rho) / (1 + rho) in closed form."""
    rng = np.random.default_rng(20)
    errors = [coloured(0.8, rng, 20000)]
    assert effective_samples(errors) == pytest.approx(20000 * 0.2 / 1.8, rel=0.15)
    assert autoregression(errors)[0] == pytest.approx(0.8, abs=0.03)
    assert effective_samples([coloured(-0.5, rng, 2000)]) <= 2000


def test_f_test_without_autocorrelation_is_the_textbook_one() -> None:
    rng = np.random.default_rng(21)
    x, e = rng.standard_normal(500), rng.standard_normal(500)
    answer = f_test([e + 0.1 * x], [x[:, None]])
    from scipy.stats import linregress

    assert answer.p == pytest.approx(linregress(x, e + 0.1 * x).pvalue, rel=0.15)
    assert f_test([e], [np.ones((500, 1))]).p == 1.0


@pytest.mark.parametrize("samples", [100, 1000])
def test_a_dependence_of_the_share_that_is_overlooked_just_passes(samples: int) -> None:
    rng = np.random.default_rng(5)
    columns = rng.standard_normal((samples, 4))
    passed = {}
    for factor in (0.5, 1.0, 2.0):
        share = factor * overlooked(samples, 4, 0.01)
        called = []
        for _ in range(60):
            noise, signal = rng.standard_normal(samples), columns @ rng.standard_normal(4)
            residual = np.sqrt(share) * signal / signal.std() + np.sqrt(1.0 - share) * noise
            called.append(f_test([residual], [columns]).p < 0.01)
        passed[factor] = np.mean(called)
    assert passed[0.5] < 0.4 < passed[1.0] < 0.95 <= passed[2.0]


def test_of_too_few_samples_everything_is_overlooked() -> None:
    assert overlooked(5.0, 4, 0.01) == 1.0
    assert overlooked(1e6, 4, 0.01) < 1e-4


def controlled(noise: Array, bandwidth: float = 80.0) -> Array:
    """Input that an integral controller makes of the output's noise beside a sine, answering with the next sample."""
    gain = 2.0 * np.pi * bandwidth * float(TIME[1])
    return SINE - lfilter([0.0, gain], [1.0, gain - 1.0], noise)


def test_noise_that_a_controller_feeds_back_is_no_dependence() -> None:
    rng = np.random.default_rng(21)
    claimed = Counter[str]()
    for _ in range(20):
        noise = 0.2 * rng.standard_normal(TIME.size)
        record = Record(TIME, controlled(noise), SINE)
        rough = np.gradient(record.input, TIME)
        assert f_test([noise], [rough[:, None]]).p < 1e-6  # the next input answers to it
        claimed.update(found(told_of([record], [noise], [UNIT])) - {"noise-floor"})
    assert max(claimed.values(), default=0) <= 1, claimed


@pytest.mark.parametrize("cause", ["rate", "coherence"])
def test_in_a_closed_loop_a_dependence_is_still_found(cause: str) -> None:
    rng = np.random.default_rng(22)
    slow = {"rate": np.gradient(SINE, TIME) / 30.0, "coherence": 2.0 * np.sin(2 * np.pi * 5 * TIME - 0.6)}[cause]
    hits = 0
    for _ in range(10):
        noise = 0.2 * rng.standard_normal(TIME.size)
        record = Record(TIME, controlled(noise), SINE)
        hits += cause in found(told_of([record], [noise + 0.2 * slow], [UNIT]))
    assert hits >= 9


def test_noise_of_a_measured_input_is_no_dependence_on_its_rate() -> None:
    rng = np.random.default_rng(23)
    hits = 0
    for _ in range(20):
        own = 0.05 * rng.standard_normal(TIME.size)
        record = Record(TIME, SINE + own, SINE)
        hits += "rate" in found(told_of([record], [-2.0 * own], [UNIT]))
    assert hits <= 1


def test_a_p_too_small_to_mean_more_is_told_as_such():
    assert [p_in_words(p) for p in (0.0, 2.8e-204, 0.00099, 0.001, 0.0234)] == [
        *3 * ["p < 0.001"],
        "p = 0.001",
        "p = 0.023",
    ]


def test_a_finding_is_told_with_the_share_it_explains():
    drift = 20.0 * TIME + np.random.default_rng(1).standard_normal(TIME.size)
    told = {test.name: test.words for test in told_of([RECORD], [drift], [UNIT])}["time"]
    assert re.fullmatch(r"the residual drifts in time \(9\d % of its variance\), p < 0\.001", told)
