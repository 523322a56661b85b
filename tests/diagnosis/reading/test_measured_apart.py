"""A scale, or a delay, that every record has for itself is told, with the records that have another one."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.reading.measured_apart import measured_apart
from hysteresis_bench.signals import Record


def told_of(time, responses, residuals):
    records = [Record(time, one, one, name) for name, one in responses.items()]
    return measured_apart(records, [*responses.values()], residuals, 1.0)


@pytest.mark.parametrize(("scale", "zero", "told"), [(1.07, 0.0, True), (1.0, 3.0, False), (1.0, 0.0, False)])
def test_a_scale_that_changes_halfway_is_told_and_no_zero_that_does(scale, zero, told):
    rng, time = np.random.default_rng(5), np.linspace(0.0, 4.0, 1000)
    responses = {name: 40.0 * np.sin(2 * np.pi * f * time) for name, f in (("slow", 1.0), ("fast", 3.0), ("mid", 2.0))}
    residuals = [rng.standard_normal(1000) for _ in responses]
    residuals[1][500:] += (scale - 1.0) * responses["fast"][500:] + zero
    said = told_of(time, responses, residuals)
    assert said.startswith("A scale of its own for each half of a record") == told
    assert ("the second half of fast 1.07 times as large" in said) == told


def test_scales_of_whole_records_are_told_as_theirs_beside_a_law_that_is_a_little_off():
    rng, time = np.random.default_rng(6), np.linspace(0.0, 4.0, 1000)
    scales = {"slow": 1.05, "fast": 0.96, "mid": 1.0, "last": 1.0}
    made = {name: 40.0 * np.sin(2 * np.pi * (k + 1.0) * time) for k, name in enumerate(scales)}
    off = [0.3 * np.cos(6 * np.pi * time) + rng.standard_normal(1000) for _ in made]
    residuals = [(scales[name] - 1.0) * made[name] + part for name, part in zip(made, off, strict=True)]
    said = told_of(time, made, residuals)
    assert said.startswith("A scale of its own for each record explains 9")
    assert "slow 1.05, fast 0.96 times as large as the others" in said


def test_no_scale_makes_up_for_a_wrong_shape():
    time = np.linspace(0.0, 4.0, 1000)
    response = 40.0 * np.sin(2 * np.pi * time)
    assert told_of(time, {"one": response}, [0.05 * response + 3.0 * np.cos(4 * np.pi * time)]) == ""


def smooth(time, number):
    return 40.0 * np.sin(2 * np.pi * (number + 1.0) * time + number) + 9.0 * np.sin(5.3 * np.pi * time)


@pytest.mark.parametrize("common", [0.0, 0.02])
def test_delays_of_records_that_were_started_apart_are_told(common):
    rng, time = np.random.default_rng(7), np.linspace(0.0, 4.0, 1000)
    late = {"slow": 0.0, "fast": 0.031, "mid": -0.024, "last": 0.0}
    made = {name: smooth(time, k) for k, name in enumerate(late)}
    moved = [smooth(time - common - late[name], k) for k, name in enumerate(late)]
    residuals = [one - made[name] + rng.standard_normal(1000) for name, one in zip(late, moved, strict=True)]
    said = told_of(time, made, residuals)
    assert said.startswith(
        ("A delay of its own for each record explains 99 %", "A delay of its own for each record explains 100")
    )
    assert "fast 0.031 s later, mid 0.024 s earlier than the others" in said


def test_a_delay_that_all_records_share_is_not_told_as_theirs():
    rng, time = np.random.default_rng(8), np.linspace(0.0, 4.0, 1000)
    made = {name: smooth(time, k) for k, name in enumerate(("slow", "fast", "mid"))}
    residuals = [smooth(time - 0.02, k) - made[name] + rng.standard_normal(1000) for k, name in enumerate(made)]
    assert "than the others" not in told_of(time, made, residuals)
