"""What repeats itself along the input or the output against its harmonics, and where a fit of it begins."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.kernels import periodicity
from tests.plugins.around import DRIVE, TIME, against, applied, record


def test_cogging_repeats_itself_along_the_input_and_an_error_of_the_output_along_the_response():
    waves = {"sine": 0.3, "cosine": -0.2, "second": 0.5, "second_aside": -0.25, "period": 0.7}

    def wave(x: np.ndarray) -> np.ndarray:
        w = 2.0 * np.pi * x / 0.7
        second = (0.3 - 0.2j) * (0.5 - 0.25j)  # a complex amplitude: of the sine, and of the cosine
        return 0.3 * np.sin(w) - 0.2 * np.cos(w) + second.real * np.sin(2.0 * w) + second.imag * np.cos(2.0 * w)

    for name, course in (("cogging", DRIVE), ("output-cyclic-error", 2.0 * DRIVE)):
        y = applied(name, record().signal, **waves)
        np.testing.assert_allclose(y, 2.0 * DRIVE + wave(course), atol=1e-12)
    off = applied("input-cyclic-error", record().signal, **waves)
    np.testing.assert_allclose(off, 2.0 * (DRIVE + wave(DRIVE)), atol=1e-12)


@pytest.mark.parametrize(
    ("name", "cycles"), [("cogging", 7.3), ("output-cyclic-error", 10.4), ("cogging", 9.9), ("input-cyclic-error", 8.2)]
)
def test_a_ripple_begins_at_the_period_that_the_residual_has(name, cycles):
    """Beside what is smooth along the course, and other on the way back."""
    made = record()
    y = made.measured
    course = y if name == "output-cyclic-error" else made.input
    ripple = 0.1 * np.sin(2.0 * np.pi * course * cycles / np.ptp(course) + 0.4)
    left = 0.3 * course**2 + 0.05 * np.sign(np.gradient(made.input))
    left += (2.0 if name == "input-cyclic-error" else 1.0) * ripple  # which the loop passes on twice as large
    left += 0.02 * np.random.default_rng(3).standard_normal(y.size)
    best = registry.build("effects", name).starts([replace(made, output=y + left)], [left])[0]
    assert abs(np.ptp(course) / best["period"] - cycles) < 0.4
    assert np.hypot(best["sine"], best["cosine"]) == pytest.approx(0.1, abs=0.03)
    assert np.hypot(best["second"], best["second_aside"]) < 0.3


def test_a_cogging_wave_begins_with_the_lines_of_cogging_and_with_twice_the_longest():
    made = record()
    left = 0.1 * np.sin(2.0 * np.pi * made.input / 0.8 + 0.4)
    lines = registry.build("effects", "cogging").starts([made], [left])
    starts = registry.build("effects", "cogging-wave").starts([made], [left])
    assert [one["period"] for one in starts] == [*(one["period"] for one in lines), 2.0 * lines[0]["period"]]
    assert (starts[-1]["sine2"], starts[-1]["cosine2"]) == (lines[0]["sine"], lines[0]["cosine"])


def test_no_ripple_is_seen_in_noise_nor_in_a_smooth_fault():
    made = record()
    noise = 0.01 * np.random.default_rng(7).standard_normal(made.input.size)
    corner = np.maximum(np.abs(made.input - 0.5) - 2.5, 0.0)  # as of an output that is cut off
    for name in ("cogging", "input-cyclic-error", "output-cyclic-error", "cogging-wave"):
        assert registry.build("effects", name).starts([made], [noise]) is None
        assert registry.build("effects", name).starts([made], [noise + 0.3 * corner]) is None


def test_too_few_samples_resolve_no_ripple():
    assert "too far apart" in against("cogging", record(TIME[::40], DRIVE[::40]))


def test_samples_too_far_apart_in_time_show_a_ripple_where_many_passes_take_other_values():
    """Nine samples a cycle of the drive follow no ripple in time; all passes together do."""
    time = np.arange(400) * 0.11
    drive = 3.0 * np.sin(2.0 * np.pi * time) * np.linspace(1.0, 0.7, time.size)
    coarse = record(time, drive)
    left = 0.1 * np.sin(2.0 * np.pi * drive / 0.45) + 0.02 * np.random.default_rng(5).standard_normal(drive.size)
    best = registry.build("effects", "cogging").starts([coarse], [left])[0]
    assert best["period"] == pytest.approx(0.45, rel=0.02)
    assert best["sine"] == pytest.approx(0.1, rel=0.2)
    same = record(time[:9], drive[:9])  # one cycle of it alone resolves none
    assert "too far apart" in registry.build("effects", "cogging").inapplicable([same])


@pytest.mark.parametrize(
    ("course", "cycles"),
    [
        (np.linspace(0.0, 1.0, 101), 40.0),  # evenly: 2.5 values a cycle
        (np.tile(np.linspace(0.0, 1.0, 101), 5), 40.0),  # the same values again tell no more
        (np.array([0.0, 0.0, 1.0, 1.0]), 0.4),
        (np.concatenate([np.linspace(0.0, 0.8, 801), [1.0]]), 2.0),  # a fifth of the range without a value
        (np.zeros(5), 0.0),
        (np.linspace(0.0, 1.0, 10_001), periodicity.MOST),
    ],
)
def test_cycles_are_resolved_by_the_values_that_a_course_takes(course, cycles):
    assert periodicity.resolved([course]) == pytest.approx(cycles)
    assert periodicity.resolved([course[::-1]]) == pytest.approx(cycles)
