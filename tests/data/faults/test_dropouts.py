"""Dropouts are found where they were put, nowhere else, and the rows are left out."""

import numpy as np
import pytest

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.faults.dropouts import dropouts, dropouts_told, without_dropouts
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 5.0, 1500)
U = 4.0 * np.sin(2 * np.pi * 1.3 * TIME)


def friction(u: Array) -> Array:
    """A spring beside a slider."""
    force, out = 0.0, np.zeros(u.size)
    for i in range(1, u.size):
        force = min(max(force + 9.0 * (u[i] - u[i - 1]), -14.0), 14.0)
        out[i] = force + 6.0 * u[i]
    return out


def lost_rows(rng: np.random.Generator, runs: int = 8) -> Array:
    lost = np.zeros(TIME.size, dtype=bool)
    for first in np.linspace(40, TIME.size - 60, runs).astype(int):
        first += int(rng.integers(0, 30))
        lost[first : first + int(rng.integers(1, 5))] = True
    return lost


@pytest.mark.parametrize("value", [0.0, -999.0])
@pytest.mark.parametrize("seed", range(4))
def test_rows_of_an_output_that_was_lost_are_left_out_all_of_them(seed, value):
    rng = np.random.default_rng(seed)
    y, lost = friction(U) + 0.1 * rng.standard_normal(TIME.size), lost_rows(rng)
    record = Record(TIME, U, np.where(lost, value, y), "sweep")
    assert np.array_equal(dropouts(record), lost)
    kept = without_dropouts(Dataset((record,)))
    assert np.array_equal(kept.records[0].output, y[~lost])
    assert kept.notes == (
        f"record sweep: the output leaps to {value:g} and back ({np.count_nonzero(lost)} samples): were they lost? "
        "These rows are left out.",
    )


def test_whole_rows_that_were_lost_are_left_out():
    rng = np.random.default_rng(9)
    y, lost = friction(U) + 0.1 * rng.standard_normal(TIME.size), lost_rows(rng)
    record = Record(TIME, np.where(lost, 0.0, U), np.where(lost, 0.0, y), "sweep")
    assert np.array_equal(dropouts(record), lost)
    assert dropouts_told(record).count("leaps to 0 and back") == 2


def test_an_input_that_was_lost_where_the_output_was_not_is_told():
    rng = np.random.default_rng(10)
    lost = lost_rows(rng)
    record = Record(TIME, np.where(lost, -1.0, U), friction(U) + 0.1 * rng.standard_normal(TIME.size), "sweep")
    assert np.array_equal(dropouts(record), lost)


@pytest.mark.parametrize("step", [0.0, 2.0])
def test_pulses_and_what_answers_to_them_are_not_lost(step):
    """As of a film that is written and read: the input leaps to one value and back, the output to about one."""
    u = np.zeros(TIME.size)
    for first in range(50, 1400, 40):
        u[first : first + 6] = 4.0 if first % 80 else -4.0
    y = friction(u) + 0.1 * np.random.default_rng(0).standard_normal(u.size)
    y = np.rint(y / step) * step if step else y
    assert not np.any(dropouts(Record(TIME, u, y)))


@pytest.mark.parametrize("step", [0.5, 5.0, 15.0])
def test_a_coarse_output_is_not_lost(step):
    y = np.rint((friction(U) + 0.1 * np.random.default_rng(1).standard_normal(U.size)) / step) * step
    assert not np.any(dropouts(Record(TIME, U, y)))


def test_two_spikes_of_one_value_are_not_lost_but_spikes():
    y = friction(U) + 0.1 * np.random.default_rng(2).standard_normal(U.size)
    y[[300, 900]] = 0.0
    assert not np.any(dropouts(Record(TIME, U, y)))


def test_stick_and_slip_is_not_lost():
    """The force builds up and falls back to 0, where it stays for some samples, again and again."""
    phase = np.arange(TIME.size) % 60
    y = np.where(phase < 8, 0.0, 3.0 * (phase - 7.0))
    assert not np.any(dropouts(Record(TIME, np.arange(TIME.size) * 0.01, y)))


@pytest.mark.parametrize("steps", [1, 2])
def test_a_column_of_two_or_three_values_is_not_lost(steps):
    y = np.repeat(np.arange(steps + 1.0), TIME.size // (steps + 1))
    assert not np.any(dropouts(Record(TIME[: y.size], U[: y.size], y)))
