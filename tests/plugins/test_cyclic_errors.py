"""What repeats itself along the input or the output against its harmonics, and where a fit of it begins."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
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
