"""Noise beside a model: what moves fast and is explained is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.evidence import Evidence, gather
from hysteresis_bench.diagnosis.evidence.noise_floor import FINEST
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.signals import Record

TIMES = [np.arange(2000) / 1000.0, np.sort(np.random.default_rng(3).uniform(5.0, 7.0, 1500))]


def heard(rough: float, hum: float, level: float) -> tuple[Evidence, list[Array]]:
    """Of an output of twice the input, and of one.

    rough, level : RMS of the input's own movement from sample to sample, and of the output's noise;  hum : amplitude
    """
    rng = np.random.default_rng(4)
    inputs = [np.sin(2.0 * np.pi * time) + rough * rng.standard_normal(time.size) for time in TIMES]
    explained = [2.0 * u + hum * np.sin(2.0 * np.pi * 447.0 * t) for t, u in zip(TIMES, inputs, strict=True)]
    outputs = [y + level * rng.standard_normal(y.size) for y in explained]
    rows = enumerate(zip(TIMES, inputs, outputs, strict=True))
    return gather(views_of([Record(*row, name=f"record {number}") for number, row in rows])), explained


@pytest.mark.parametrize(("rough", "hum"), [(0.02, 0.0), (0.0, 0.1), (0.02, 0.1)])
def test_what_moves_fast_and_is_explained_is_no_noise(rough: float, hum: float) -> None:
    loud, explained = heard(rough, hum, 0.01)
    assert loud.noise.rms > 0.03
    assert "explained" not in loud.noise.words
    quiet = loud.heard_beside(explained)
    assert quiet.noise.floor == pytest.approx(0.01, rel=0.06)
    assert quiet.floor == pytest.approx(0.01, rel=0.06)
    assert [view.noise.rms for view in quiet.views] == pytest.approx([0.01, 0.01], rel=0.1)
    assert not quiet.noise.input_heard
    assert quiet.noise.explained == pytest.approx(np.sqrt(loud.noise.floor**2 - quiet.noise.floor**2), rel=0.02)
    assert "is explained" in quiet.noise.words


def test_what_is_smooth_is_none_either_and_what_is_not_explained_stays() -> None:
    loud, explained = heard(0.0, 0.0, 0.01)
    beside = loud.heard_beside([0.5 * y for y in explained])
    assert beside.noise.floor == pytest.approx(loud.noise.floor, rel=0.03)
    assert loud.heard_beside([np.zeros_like(y) for y in explained]).noise.rms == loud.noise.rms


def test_beside_a_perfect_model_rounding_is_left() -> None:
    loud, explained = heard(0.02, 0.0, 0.0)
    span = max(float(np.ptp(view.y)) for view in loud.views)
    assert loud.heard_beside(explained).floor == pytest.approx(FINEST * span, rel=0.2)


def test_the_noise_of_a_hum_that_is_left_is_at_most_what_is_left() -> None:
    time = TIMES[0]
    hum = 0.1 * np.sin(2.0 * np.pi * 447.0 * time)  # of two samples a period
    smooth = np.sin(2.0 * np.pi * time)
    loud = gather(views_of([Record(time, smooth, 2.0 * smooth + hum)]))
    assert loud.noise.rms > 0.11
    assert loud.heard_beside([2.0 * smooth]).noise.rms == pytest.approx(0.1 / np.sqrt(2.0), rel=0.01)


def test_the_floor_is_told_where_the_samples_do_not_tell_the_input() -> None:
    """A smoothed input that may be off by more than the noise of the output."""
    time = np.linspace(0.0, 4.0, 1200)
    drive, noise = np.sin(2.0 * np.pi * time), 0.01 * np.random.default_rng(5).standard_normal(time.size)
    record = Record(time, drive, 2.0 * drive + noise)
    known = gather(views_of([record]))
    assert known.told == f"the noise is {known.noise.floor:.3g}"
    smoothed = gather(views_of([replace(record, input_error=0.01)]))
    assert smoothed.unknown == pytest.approx(0.02, rel=0.05)
    assert smoothed.told.endswith(f"with what the samples do not tell of the input {smoothed.floor:.3g}")
