"""The residual's equation: empty on noise of any colour, right on planted terms, and good on another record."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.signal import lfilter, lsim

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.findings.terms import Term, find_terms
from hysteresis_bench.signals import INDEX, Record

UNITS = {"time": "s", "input": "V", "output": "um"}
TIME = np.arange(1500) / 500.0
SINE = 5 + 4 * np.sin(2 * np.pi * 3 * TIME)
NESTED = 5 + 4 * np.sin(2 * np.pi * 3 * TIME) * np.exp(-TIME / 2)
SWEEP = 5 + 4 * np.sin(2 * np.pi * (0.5 + 1.5 * TIME) * TIME)
RECORDS = [Record(TIME, NESTED, NESTED, "nested", UNITS), Record(TIME, SWEEP, SWEEP, "sweep", UNITS)]
OTHER = Record(TIME, 5 + 3 * np.sin(4 * np.pi * TIME) * np.sin(2 * TIME), TIME, "other", UNITS)


def coloured(rho: float, rng: np.random.Generator, samples: int = TIME.size) -> Array:
    return lfilter([np.sqrt(1 - rho**2)], [1, -rho], rng.standard_normal(samples + 300))[300:]


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.8, 0.95])
def test_no_terms_on_noise(rho: float) -> None:
    rng = np.random.default_rng(41)
    claimed = 0
    for u in (SINE, SWEEP, NESTED):
        record = Record(TIME, u, u, units=UNITS)
        claimed += sum(bool(find_terms([record], [coloured(rho, rng)], [np.tanh(u - 5)]).terms) for _ in range(25))
    assert claimed <= 3  # of 75


def test_the_standard_error_is_that_of_the_coefficient() -> None:
    """Of a term that moves faster than the noise does: by plain least squares it scatters 4 times as far as told."""
    fast = Record(TIME, np.sin(0.9 * np.arange(TIME.size)) + SWEEP - 5, SWEEP, units=UNITS)
    rng, off = np.random.default_rng(43), []
    for _ in range(40):
        residual = 0.3 * fast.input**2 + coloured(0.95, rng)
        square = next(part for part in find_terms([fast], [residual]).terms if part.term.kind == "u2")
        off.append((square.coefficient - 0.3) / square.standard_error)
    assert 0.6 < np.std(off) < 1.4


def lagged(record: Record) -> Array:
    return 0.5 * (lsim(([1.0], [0.07, 1.0]), record.input - record.input[0], record.time)[1] - record.input)


@pytest.mark.parametrize("rho", [0.0, 0.8])
@pytest.mark.parametrize(
    ("planted", "kinds", "coefficient"),
    [
        (lambda r: 0.3 * (r.input - 5) ** 2, {"u2"}, 0.3),
        (lambda r: 0.01 * np.gradient(r.input, r.time), {"rate"}, 0.01),
        (lambda r: 0.7 * np.sign(np.gradient(r.input)), {"branch"}, 0.7),
        (lambda r: 0.4 * r.time, {"time"}, 0.4),
        (lagged, {"lag"}, 0.5),
        (lambda r: 0.2 * (r.input - 5) ** 2 + 0.02 * np.gradient(r.input, r.time), {"u2", "rate"}, None),
    ],
    ids=["square", "rate", "branch", "time", "lag", "two"],
)
def test_names_what_was_planted(planted: Callable, kinds: set[str], coefficient: float | None, rho: float) -> None:
    rng = np.random.default_rng(42)
    true = [planted(record) for record in RECORDS]
    level = 0.5 * np.std(np.concatenate(true))
    equation = find_terms(RECORDS, [part + level * coloured(rho, rng) for part in true])
    assert {part.term.kind for part in equation.terms} == kinds
    if coefficient is not None:
        [part] = equation.terms
        assert abs(part.coefficient - coefficient) < max(4 * part.standard_error, 0.05 * coefficient)
    wanted, found = planted(OTHER), equation.evaluate(OTHER)
    assert np.var(wanted - wanted.mean() - found + found.mean()) < 0.05 * np.var(wanted)


def test_memory_is_described_by_plays() -> None:
    """A play half-way between two of the library: other terms stand in for it, and predict."""
    rng = np.random.default_rng(43)
    true = [covariates.play(record.input, 1.2) for record in RECORDS]
    equation = find_terms(RECORDS, [part + 0.3 * rng.standard_normal(part.size) for part in true])
    assert "play" in {part.term.kind for part in equation.terms}
    wanted, found = covariates.play(OTHER.input, 1.2), equation.evaluate(OTHER)
    assert np.var(wanted - wanted.mean() - found + found.mean()) < 0.1 * np.var(wanted)


def test_the_share_is_what_is_left_to_gain() -> None:
    rng = np.random.default_rng(44)
    record = RECORDS[1]
    planted = (record.input - 5) ** 2
    noise = rng.standard_normal(planted.size) * np.std(planted)
    assert find_terms([record], [planted + noise]).share == pytest.approx(0.5, abs=0.06)


def test_offsets_between_records_are_left_alone() -> None:
    rng = np.random.default_rng(45)
    residuals = [5.0 + rng.standard_normal(TIME.size), -5.0 + rng.standard_normal(TIME.size)]
    assert not find_terms(RECORDS, residuals).terms


def test_equation_in_units() -> None:
    rng = np.random.default_rng(46)
    equation = find_terms(RECORDS, [0.3 * (r.input - 5) ** 2 + 0.1 * rng.standard_normal(TIME.size) for r in RECORDS])
    assert equation.terms[0].unit == "um/V^2"
    assert "um/V^2 * (u - " in str(equation)
    assert str(find_terms(RECORDS, [rng.standard_normal(TIME.size) for _ in RECORDS])).endswith("describe")


def test_output_terms_need_the_output() -> None:
    rng = np.random.default_rng(47)
    outputs = [np.cumsum(rng.standard_normal(TIME.size)) for _ in RECORDS]
    equation = find_terms(RECORDS, [0.2 * y + 0.1 * rng.standard_normal(y.size) for y in outputs], outputs)
    assert equation.terms[0].term.kind == "y"
    assert equation.terms[0].coefficient == pytest.approx(0.2, rel=0.05)
    assert np.std(equation.evaluate(OTHER, outputs[0]) - 0.2 * outputs[0]) < 0.1
    with pytest.raises(ValueError, match="output"):
        equation.evaluate(OTHER)


def test_no_time_base_no_rate() -> None:
    rng = np.random.default_rng(48)
    units = {**UNITS, "time": INDEX}
    record = Record(np.arange(1500.0), SWEEP, SWEEP, units=units)
    residual = np.gradient(SWEEP) * 20 + rng.standard_normal(1500)
    assert not any(part.term.rate for part in find_terms([record], [residual]).terms)


def test_history_is_left_out() -> None:
    rng = np.random.default_rng(49)
    record = Record(TIME, SWEEP, SWEEP, units=UNITS, history=400)
    equation = find_terms([record], [(0.3 * (SWEEP - 5) ** 2)[400:] + 0.1 * rng.standard_normal(1100)])
    assert {part.term.kind for part in equation.terms} == {"u2"}
    assert equation.evaluate(record).size == 1500


@pytest.mark.parametrize("residual", [np.zeros(TIME.size), np.ones(TIME.size)])
def test_nothing_left_is_described_by_nothing(residual: Array) -> None:
    assert not find_terms(RECORDS, [residual, residual]).terms
    still = Record(TIME, np.full(TIME.size, 2.0), TIME, units=UNITS)
    assert not find_terms([still], [residual]).terms


def test_low_pass_is_exact_on_any_grid() -> None:
    """Against a solution on a hundred times finer steps."""
    rng = np.random.default_rng(50)
    time = np.concatenate([[0.0], np.cumsum(rng.uniform(0.01, 0.1, 60))])
    u = rng.standard_normal(61)
    fine = np.linspace(0, time[-1], 120001)
    exact = lsim(([1.0], [0.2, 1.0]), np.interp(fine, time, u) - u[0], fine)[1] + u[0]
    record = Record(time, u, u)
    assert Term("lag", 0.2).column(record) + u == pytest.approx(np.interp(time, fine, exact), abs=1e-5)
    even = np.arange(200) * 0.05
    drive = rng.standard_normal(200)
    jittered = even + 1e-6 * np.sin(np.arange(200.0))
    assert covariates.low_pass(even, drive, 0.2) == pytest.approx(covariates.low_pass(jittered, drive, 0.2), abs=1e-4)


def test_turning_points_of_a_noisy_triangle() -> None:
    rng = np.random.default_rng(51)
    u = np.abs((np.arange(1000) / 200.0) % 1 - 0.5) * 4 + 0.02 * rng.standard_normal(1000)
    turns = covariates.turning_points(u, 0.2)
    assert turns == pytest.approx(np.arange(100, 1000, 100), abs=3)
    assert np.mean(covariates.branch(u, turns)[:95] == -1) == 1
    assert covariates.cycle(1000, turns)[-1] == pytest.approx(turns.size / 2)
    assert covariates.last_extremum(u, turns)[150] == pytest.approx(0.0, abs=0.1)
