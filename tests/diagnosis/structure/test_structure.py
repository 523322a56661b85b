"""Structure tests refute what is false, keep what is true, and say where the data do not allow them."""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.structure.colour import colour
from hysteresis_bench.diagnosis.structure.structure import TESTS, structure
from hysteresis_bench.signals import INDEX, Record
from tests.diagnosis.structure.made import (
    CYCLES,
    coleman_hodgdon,
    late,
    minor_loops,
    modulated,
    noise,
    plays,
    seen,
    sine,
    triangle,
)

TRUE_OF_PLAYS = (
    "closure",
    "odd symmetry",
    "rising and falling branches",
    "Masing's rule",
    "return-point memory",
    "congruency",
    "rate independence",
)


@pytest.mark.parametrize("drive", [sine, triangle, modulated, minor_loops])
@pytest.mark.parametrize("decay", [0.0, 0.9])
def test_a_sum_of_plays_keeps_all_that_it_has(drive, decay):
    for seed, samples in enumerate((150, 500)):
        found = structure(seen(plays(), drive, decay=decay, samples=samples, seed=seed))
        refuted = [finding.name for finding in found.findings if finding.name in TRUE_OF_PLAYS and finding.p < 0.01]
        assert not refuted
        assert found.side == 1


@pytest.mark.parametrize("level", [0.001, 0.003, 0.01])
def test_a_law_of_another_making_is_no_sum_of_plays(level):
    """Coleman and Hodgdon's: odd and rate-independent, without Masing's rule and return-point memory."""
    found = structure(seen(coleman_hodgdon(alpha=1.5), minor_loops, level=level))
    assert found.of("return-point memory").refutes
    assert found.of("Masing's rule").refutes == (level < 0.01)
    assert found.of("rate independence").p > 0.01
    assert found.of("odd symmetry").p > 0.01
    assert "no law with return-point memory" in found.of("return-point memory").words


def test_the_least_error_is_one_that_no_law_of_the_property_undercuts():
    """What a law of Masing's rule leaves is more than the finding says; plays are as many as could be needed."""
    views = seen(coleman_hodgdon(), modulated, level=0.001)
    least = structure(views).of("Masing's rule").least
    columns, outputs = [], []
    for number, view in enumerate(views):
        bank = [plays(np.array([radius]), 0.0)(view.time, view.u) for radius in np.linspace(0.01, 1.0, 40)]
        own = np.eye(len(views))[[number] * view.y.size]
        columns.append(np.column_stack([view.u, *bank, own]))
        outputs.append(view.y)
    design, target = np.vstack(columns), np.concatenate(outputs)
    left = target - design @ np.linalg.lstsq(design, target, rcond=None)[0]
    reached = float(np.sqrt(np.mean(left**2)))
    assert 0.1 * reached < least < reached


def test_a_lag_depends_on_the_rate_and_is_told():
    found = structure(seen(late(), sine))
    assert found.of("rate independence").refutes
    assert found.of("growth of the area").statistic == pytest.approx(2.0, abs=0.1)


def test_a_delay_of_a_hysteretic_output_is_a_reversal_lag():
    def delayed(time, u):
        whole = plays()(time, u)
        return np.interp(time - 0.06 * (time[-1] - time[0]) / CYCLES, time, whole)

    found = structure(seen(delayed, triangle)).of("reversal lag")
    assert found.refutes
    assert not structure(seen(plays(), triangle)).of("reversal lag").refutes


def test_a_curve_that_is_not_odd_is_seen():
    def bent(time, u):
        whole = plays()(time, u)
        return whole + 0.2 * whole**2

    found = structure(seen(bent, sine))
    assert found.of("odd symmetry").refutes
    assert found.of("rising and falling branches").refutes
    assert not found.of("rate independence").refutes


def test_drift_and_creep_are_told_apart():
    def beside(trend):
        return structure(seen(lambda time, u: plays()(time, u) + 0.3 * trend(time / 4.0), sine)).of("closure")

    steady, slowing = beside(lambda share: share), beside(lambda share: np.log(0.01 + share))
    assert "drift" in steady.words
    assert "logarithm" in slowing.words


def test_minor_loops_of_equal_ends_and_another_history_are_no_repeated_cycle():
    """Entered from below and from above, they lie one above the other; behind a curve they are not even congruent."""
    turns = 2 * [-1.0, 0.3, -0.3, 0.3, -0.3, 1.0, -0.3, 0.3, -0.3, 0.3]
    u = np.concatenate([np.linspace(0.0, turns[0], 100), *(np.linspace(a, b, 101)[1:] for a, b in pairwise(turns))])
    time = np.arange(u.size) / 500.0
    y = np.tanh(plays()(time, u)) + 0.003 * noise(np.random.default_rng(5), u.size, 0.0)
    closed = structure(views_of([Record(time, u, y, "loops")])).of("closure")
    assert closed.applies
    assert closed.p > 0.01


def test_clockwise_loops_have_the_other_sense_and_mixed_ones_none():
    views = seen(lambda time, u: u - 0.3 * plays()(time, u), sine)
    found = structure(views)
    assert found.side == -1
    assert "clockwise" in found.of("sense").words
    turned = [replace(view.record, name=f"turned {view.record.name}", output=-view.y) for view in views[:1]]
    mixed = structure(views_of([*turned, *(view.record for view in views[1:])]))
    assert mixed.side == 0
    assert "no law with one set of parameters" in mixed.of("sense").words


def test_what_cannot_be_asked_is_answered_with_the_reason():
    time = np.linspace(0.0, 1.0, 300)
    once = structure(views_of([Record(time, time, time**2 + 0.001 * np.cos(900.0 * time))]))
    assert not any(finding.applies for finding in once.findings)
    assert all(finding.words.endswith(".") for finding in once.findings)
    still = structure(views_of([Record(time, np.ones(300), np.sin(time))]))
    assert {finding.name for finding in still.findings} == {finding.name for finding in once.findings}
    one = structure(seen(plays(), sine)[:1])
    for name in ("Masing's rule", "congruency", "rate independence", "growth of the area"):
        assert not one.of(name).applies
    index = [replace(view.record, units={**view.record.units, "time": INDEX}) for view in seen(plays(), sine)]
    assert "only an index" in structure(views_of(index)).of("rate independence").words
    assert len(TESTS) == len(once.findings)


def test_a_noisy_input_still_has_branches_that_are_alike():
    rng, noisy = np.random.default_rng(2), []
    for view in seen(plays(), sine):
        jitter = 1e-4 * rng.standard_normal(view.u.size)
        noisy.append(replace(view.record, input=view.u + jitter))
    found = structure(views_of(noisy))
    for name in ("closure", "odd symmetry", "rising and falling branches", "rate independence"):
        assert found.of(name).applies
        assert found.of(name).p > 0.01


def test_slow_noise_is_not_taken_for_fast_noise():
    """The variance of a mean over eight samples, of noise whose neighbours correlate by 0.9."""
    weights = np.zeros((1, 2000))
    weights[0, 300:308] = 1.0 / 8.0
    lags = np.abs(np.subtract.outer(np.arange(8), np.arange(8)))
    for decay in (0.0, 0.9):
        rng = np.random.default_rng(4)
        found = colour([noise(rng, 100, decay) for _ in range(20)], [0, 2000], 0.0).covariance(weights)[0, 0]
        true = float(np.mean(decay**lags)) if decay else 1.0 / 8.0
        assert 0.9 * true < found < 3.0 * true


def test_the_benchmark_holds_on_one_law(monkeypatch, capsys):
    monkeypatch.syspath_prepend("benchmarks")
    import structure as benchmark

    monkeypatch.setattr(benchmark, "SAMPLES", (300,))
    monkeypatch.setattr(benchmark, "DRIVES", {"minor loops": benchmark.minor_loops})
    monkeypatch.setattr(benchmark, "LEVELS", (0.003,))
    benchmark.main(["dahl", "prandtl-ishlinskii", "--seeds", "1"])
    told = capsys.readouterr().out
    assert "dahl" in told
    assert "Masing's rule" in told
    sys.modules.pop("structure")
