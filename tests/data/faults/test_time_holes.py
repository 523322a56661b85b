"""Holes in time are told where the steps are even, and of uneven records nothing is made up."""

import numpy as np
import pytest

from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.faults.time_holes import time_holes
from hysteresis_bench.signals import Record

COUNT = 1000


def record(time):
    """Seven cycles of a sine over these times."""
    drive = np.sin(14 * np.pi * (time - time[0]) / (time[-1] - time[0]))
    return Record(time, drive, 2.0 * drive)


def where_it_moved(by, of, rest=1.0):
    """Samples taken when an input had moved by so much since the last one."""
    time = np.arange(20_000) / 4000.0
    drive = np.clip(of(time), -rest, rest)
    kept = [0]
    for sample in range(time.size):
        if abs(drive[sample] - drive[kept[-1]]) >= by:
            kept.append(sample)
    return Record(time[kept], drive[kept], 2.0 * drive[kept])


def triangle(time):
    return 2 / np.pi * np.arcsin(np.sin(7.0 * time + 1.0))


@pytest.mark.parametrize(
    ("make", "missing"),
    [
        (lambda rng: np.arange(COUNT) / 100.0, 8),
        (lambda rng: np.round(np.arange(COUNT) / 70.0, 2), 8),
        (lambda rng: np.arange(COUNT) + 0.3 * rng.uniform(-1, 1, COUNT), 8),
        (lambda rng: np.arange(COUNT) + 0.45 * rng.uniform(-1, 1, COUNT), 20),
    ],
)
def test_a_hole_is_found_and_nothing_else(make, missing):
    time = make(np.random.default_rng(0))
    assert time_holes(record(time)).size == 0
    holed = np.delete(time, slice(300, 300 + missing))
    assert time_holes(record(holed)).tolist() == [299]


UNEVEN = {
    "exponential steps": lambda rng: record(np.cumsum(rng.exponential(size=COUNT))),
    "gamma steps": lambda rng: record(np.cumsum(rng.gamma(4, size=COUNT))),
    "log-normal steps": lambda rng: record(np.cumsum(np.exp(rng.standard_normal(COUNT)))),
    "lone samples missing": lambda rng: record(np.arange(COUNT)[rng.random(COUNT) > 0.05].astype(float)),
    "two rates": lambda rng: record(np.cumsum(np.where(abs(np.arange(COUNT) - 500) < 30, 1.0, 0.01))),
    "a sine by its movement": lambda rng: where_it_moved(0.05, lambda time: np.sin(7.0 * time + rng.uniform(0, 6))),
    "a triangle by its movement": lambda rng: where_it_moved(0.05, triangle),
    "a resting triangle by its movement": lambda rng: where_it_moved(0.05, triangle, rest=0.8),
}


@pytest.mark.parametrize("name", UNEVEN)
def test_uneven_records_raise_no_alarm(name):
    assert [time_holes(UNEVEN[name](np.random.default_rng(seed))).size for seed in range(5)] == [0] * 5


def test_removed_rows_are_told_as_empty_ones_are_and_no_gap_twice(tmp_path):
    rows = [f"{k / 100},{np.sin(k / 16):.6f},{np.sin(k / 16 - 0.2):.6f}" for k in range(400)]
    empty = [row if not 150 <= k < 220 else f"{k / 100},," for k, row in enumerate(rows)]
    found = {}
    for name, kept in {"removed": rows[:150] + rows[220:], "empty": empty, "whole": rows}.items():
        path = tmp_path / f"{name}.csv"
        path.write_text("\n".join(["time [s],input [V],output [um]", *kept]), encoding="utf-8")
        found[name] = read_data([path])
    assert {name: one.understood[0]["gaps"] for name, one in found.items()} == {
        "removed": "1",
        "empty": "1",
        "whole": "0",
    }
    (told,) = found["removed"].notes
    assert "no sample for 0.71 s between rows 151 and 152, where the others are 0.01 s apart" in told
    (told,) = found["empty"].notes
    assert "70 rows without a number left out" in told
    assert found["whole"].notes == ()
