"""Curves of the input and of the output, and plays, against their own formulas; where a search for a stop begins."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.signals import Signal
from tests.plugins.around import DRIVE, TIME, applied, box, record


def test_saturation_is_rapp_s_and_stays_below_its_level():
    signal = record().signal
    y = applied("saturation", signal, inverse_level=0.2, sharpness=2.0)
    np.testing.assert_allclose(y, 2.0 * DRIVE / np.sqrt(1.0 + (0.4 * DRIVE) ** 2), rtol=1e-12)
    huge = signal.with_input(1e40 * signal.input)
    sharp = applied("saturation", huge, inverse_level=0.2, sharpness=20.0)
    np.testing.assert_allclose(sharp, 5.0 * np.sign(DRIVE), rtol=1e-12)


def test_saturation_comes_near_to_tanh_and_to_a_clip():
    x = np.linspace(-1.5, 1.5, 301)
    signal = Signal(x, x[:, None])
    bent = applied("saturation", signal, inverse_level=1 / 0.97, sharpness=2.7)
    assert np.max(np.abs(bent - 0.97 * np.tanh(2 * x / 0.97))) < 0.02
    cut = applied("saturation", signal, inverse_level=1.0, sharpness=20.0)
    assert np.sqrt(np.mean((cut - np.clip(2 * x, -1, 1)) ** 2)) < 0.01


def test_a_rigid_stop_cuts_off_and_an_elastic_one_bends():
    signal = record().signal
    cut = applied("stop-above", signal, level=0.5, share=1.0, rounding=0.0)
    np.testing.assert_allclose(cut, np.minimum(2.0 * DRIVE, 0.5), atol=1e-15)
    bent = applied("stop-above", signal, level=0.5, share=0.25, rounding=0.0)
    np.testing.assert_allclose(bent, np.where(2.0 * DRIVE > 0.5, 0.5 + 1.5 * (DRIVE - 0.25), 2.0 * DRIVE), atol=1e-15)


def test_a_rounded_stop_is_a_hyperbola_between_its_straight_ways():
    drive = np.linspace(-1.0, 1.0, 201)
    signal, level, share, width = Signal(drive, drive[:, None]), 0.5, 0.8, 0.3
    held = (2.0 * drive - applied("stop-above", signal, level=level, share=share, rounding=width)) / share
    np.testing.assert_allclose(held * (held - 2.0 * drive + level), width**2 / 4.0, atol=1e-14)
    assert np.interp(0.25, drive, held) == pytest.approx(0.5 * width)  # at the level


def test_a_stop_below_is_one_above_upside_down():
    signal = record().signal
    below = applied("stop-below", signal, level=-0.3, share=0.7, rounding=0.2)
    upside_down = signal.with_input(-signal.input)
    np.testing.assert_allclose(
        below, -applied("stop-above", upside_down, level=0.3, share=0.7, rounding=0.2), atol=1e-15
    )


def test_a_dead_zone_lets_through_what_is_beyond_it_and_leaks_the_rest():
    signal = record().signal
    beyond = np.where(DRIVE > 1.0, DRIVE - 1.0, np.minimum(DRIVE, 0.0))
    sharp = {"half_width": 0.5, "centre": 0.5, "rounding": 0.0}
    np.testing.assert_allclose(applied("input-dead-zone", signal, share=1.0, **sharp), 2.0 * beyond, atol=1e-14)
    leaking = applied("input-dead-zone", signal, share=0.8, **sharp)
    np.testing.assert_allclose(leaking, 1.6 * beyond + 0.4 * DRIVE, atol=1e-14)
    deaf = np.where(2.0 * DRIVE > 1.0, 2.0 * DRIVE - 1.0, np.where(2.0 * DRIVE < -1.0, 2.0 * DRIVE + 1.0, 0.0))
    found = applied("output-dead-zone", signal, share=1.0, half_width=1.0, centre=0.0, rounding=0.0)
    np.testing.assert_allclose(found, deaf, atol=1e-14)


@pytest.mark.parametrize("rounding", [0.0, 0.3])
def test_a_dead_zone_aside_leaves_zero_where_it_is(rounding):
    drive = np.array([0.0, 0.5, -0.5])
    aside = {"share": 1.0, "half_width": 0.4, "centre": 2.0, "rounding": rounding}
    y = applied("output-dead-zone", Signal(np.arange(3.0), drive[:, None]), **aside)
    assert y[0] == 0.0
    np.testing.assert_allclose(y, 2.0 * drive, atol=0.1 * rounding)


def test_a_rounded_dead_zone_is_odd_and_ends_in_the_straight_ways_of_a_sharp_one():
    drive = np.linspace(-100.0, 100.0, 2001)
    signal, half, width = Signal(drive, drive[:, None]), 0.5, 0.2
    y = 0.5 * applied("input-dead-zone", signal, share=1.0, half_width=half, centre=0.0, rounding=width)
    np.testing.assert_allclose(y, -y[::-1], atol=1e-12)
    assert y[-1] == pytest.approx(100.0 - half, abs=1e-5)
    slope = np.gradient(y, drive)[1000]
    assert slope == pytest.approx(1.0 - half / np.hypot(half, width), abs=0.02)
    assert np.all(np.diff(y) > 0.0)


def test_the_search_for_a_dead_zone_begins_about_zero_or_about_the_middle():
    left = [np.zeros(TIME.size)]
    for name in ("input-dead-zone", "output-dead-zone"):
        effect = registry.build("effects", name)
        assert {start["centre"] for start in effect.starts([record()], left)} == {0.0}
        far = record(drive=DRIVE + 40.0)
        low, high = box(name, far)["centre"]
        assert {start["centre"] for start in effect.starts([far], left)} == {0.5 * (low + high)}


@pytest.mark.parametrize(
    ("name", "side"), [("stop-above", np.minimum), ("stop-below", lambda x, low: np.maximum(x, -low))]
)
def test_the_search_for_a_stop_begins_at_its_level(name, side):
    held = record(output=side(2.0 * DRIVE, 0.4))
    start, *_ = registry.build("effects", name).starts([held], [np.zeros(held.time.size)])
    level = box(name, held)["level"]
    assert abs(start["level"]) == pytest.approx(0.4)
    assert level[0] <= start["level"] <= level[1]
    assert start["share"] == 1.0


@pytest.mark.parametrize("phase", [0.0, 0.7])  # from rest, and not
@pytest.mark.parametrize("far", [-30.0, 4.0])
def test_a_stop_is_sought_about_the_response_where_the_output_is_far_from_zero(phase, far):
    drive = np.sin(2 * np.pi * TIME + phase)
    held = record(drive=drive, output=np.minimum(2.0 * drive, 1.2) + far)
    *_, start = registry.build("effects", "stop-above").starts([held], [np.zeros(held.time.size)])
    low, high = box("stop-above", held)["level"]
    assert start["level"] == pytest.approx(1.2, abs=0.3)
    assert low < 1.1
    assert high > 1.1
    lowest, highest = (box("output-curve", held)[end] for end in ("lowest", "highest"))
    assert lowest[1] < -1.6
    assert highest[0] > 1.2


def test_a_curve_of_the_input_has_a_corner_where_the_input_changes_its_sign():
    lows, highs = zip(*(box("input-curve", record())[end] for end in ("lowest", "highest", "origin")), strict=True)
    lowest, highest, origin = 0.5 * (np.array(lows) + np.array(highs))
    assert origin == 0.0
    off = {one.name: 0.0 for one in registry.build("effects", "input-curve").parameters if one.name.startswith("bend")}
    values = {"lowest": lowest, "highest": highest, "origin": origin, "corner": 0.25, **off}
    y = applied("input-curve", record().signal, **values)
    np.testing.assert_allclose(y, 2.0 * np.where(DRIVE > 0.0, 1.25, 0.75) * DRIVE, rtol=1e-12)
    far = box("input-curve", record(drive=DRIVE + 40.0))["origin"]
    assert 0.5 * sum(far) == pytest.approx(40.5, abs=0.01)  # no zero to be seen: in the middle


def test_asymmetry_stays_monotone_in_its_box():
    low, high = box("asymmetry", record())["curvature"]
    rising = np.linspace(-3.5, 3.5, 200)
    for curvature in (low, high):
        y = applied("asymmetry", Signal(rising, rising[:, None]), curvature=curvature)
        assert np.all(np.diff(y) > 0)
        np.testing.assert_allclose(y, 2.0 * (rising + curvature * rising**2))


def test_backlash_holds_after_a_reversal():
    drive = np.array([0.0, 1.0, 2.0, 1.5, 1.0, 0.0])
    y = applied("backlash", Signal(np.arange(6.0), drive[:, None]), half_width=0.5)
    np.testing.assert_array_equal(y, 2.0 * np.array([0.0, 0.5, 1.5, 1.5, 1.5, 0.5]))
