"""Each effect against its own formula, its box, and why it would not apply."""

from collections import namedtuple
from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.contracts import Effect
from hysteresis_bench.signals import INDEX, Record, Signal

TIME = np.linspace(2.0, 6.0, 401)
DRIVE = 3.0 * np.sin(2 * np.pi * TIME) + 0.5


def record(time=TIME, drive=DRIVE, name="record", **changes) -> Record:
    return replace(Record(time, drive, 2.0 * drive, name=name), **changes)


def applied(name: str, signal: Signal, settings=None, **values) -> np.ndarray:
    """The effect around y = 2 u, for one set of parameters."""
    effect: Effect = registry.build("effects", name, settings)
    p = namedtuple("Values", values)(*(np.array([float(value)]) for value in values.values()))
    return effect.apply(lambda seen: 2.0 * seen.input, signal, p)[:, 0]


def box(name: str, *records: Record) -> dict[str, tuple[float, float]]:
    parameters = registry.build("effects", name).box(records)
    return {parameter.name: (parameter.lower, parameter.upper) for parameter in parameters}


def against(name: str, *records: Record) -> str:
    return registry.build("effects", name).inapplicable(records)


STEP = Signal(TIME, np.where(TIME > 2.0, 1.0, 0.0)[:, None])
SINCE = TIME - TIME[1]


@pytest.mark.parametrize("name", ["input-lag", "output-lag"])
def test_a_lag_answers_a_step_exponentially(name):
    y = applied(name, STEP, time_constant=0.5)
    start = y[1] - 2.0
    np.testing.assert_allclose(y[1:], 2.0 + start * np.exp(-SINCE[1:] / 0.5), atol=1e-12)
    assert abs(start + 2.0) < 0.03  # the step's own edge takes one sample


def test_a_lag_before_and_after_a_linear_model_are_the_same():
    signal = record().signal
    before, after = (applied(name, signal, time_constant=0.3) for name in ("input-lag", "output-lag"))
    np.testing.assert_allclose(before, after, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "first"), [("second-order-lag", "output-lag"), ("second-order-input-lag", "input-lag")]
)
def test_a_second_order_lag_is_two_lags_in_series(name, first):
    """Of a step, against the closed form of two lags; each of them once, against a lag of the other's answer."""
    slow, fast = 0.4, 0.1
    damping = 0.5 * (slow + fast) / np.sqrt(slow * fast)
    y = applied(name, STEP, time_constant=slow + fast, damping=damping)
    left = (slow * np.exp(-SINCE[1:] / slow) - fast * np.exp(-SINCE[1:] / fast)) / (slow - fast)
    np.testing.assert_allclose(y[1:], 2.0 * (1.0 - left), atol=0.03)  # the step's own edge takes one sample
    fine = np.linspace(2.0, 6.0, 40001)
    signal = record(fine, 3.0 * np.sin(2 * np.pi * fine) + 0.5).signal
    lagged = applied("output-lag", signal, time_constant=slow)
    twice = applied(first, signal.with_input(0.5 * lagged[:, None]), time_constant=fast)
    np.testing.assert_allclose(applied(name, signal, time_constant=slow + fast, damping=damping), twice, atol=1e-7)


def test_a_damped_stage_is_a_resonance_up_to_where_it_has_a_peak_and_a_second_order_lag_beyond():
    slower = record(drive=3.0 * np.sin(np.pi * TIME))
    assert box("resonance", record(), slower)["damping"][1] == box("second-order-lag", record(), slower)["damping"][0]
    values = {"damping": np.sqrt(0.5), "time_constant": 0.2}
    period = np.pi * values["time_constant"] / values["damping"]
    resonating = applied("resonance", record().signal, period=period, damping=values["damping"])
    np.testing.assert_allclose(applied("second-order-lag", record().signal, **values), resonating, atol=1e-12)
    frequency = np.geomspace(0.01, 10.0, 400)
    gains = {z: 1.0 / np.hypot(1.0 - frequency**2, 2.0 * z * frequency) for z in (0.65, 0.72)}
    assert gains[0.65].max() > 1.01
    assert gains[0.72].max() <= 1.0


def test_a_delayed_output_is_the_output_of_an_earlier_input():
    y = applied("transport-delay", record().signal, delay=0.137)
    np.testing.assert_allclose(y, 2.0 * np.interp(TIME - 0.137, TIME, DRIVE), atol=1e-12)


def test_creep_keeps_the_static_gain_and_grows_with_the_logarithm_of_time():
    time = np.concatenate([[-1e-6], np.geomspace(1e-6, 1e5, 2000)])
    step = Signal(time, np.where(time > 0, 1.0, 0.0)[:, None])
    y = applied("creep", step, share=0.3, time_constant=1.0, decades=4.0)
    np.testing.assert_allclose(y[[0, 1, -1]], [0.0, 1.4, 2.0], atol=1e-4)
    decades = np.log10(time[1:])
    between = (decades > -1.5) & (decades < 1.5)
    line = np.polynomial.Polynomial.fit(decades[between], y[1:][between], 1)
    ripple = y[1:][between] - line(decades[between])
    assert np.max(np.abs(ripple)) < 0.03 * 0.6
    np.testing.assert_allclose(line.convert().coef[1], 0.6 / 5, rtol=0.1)  # five relaxations, one a decade


def test_creep_of_no_decades_is_one_relaxation():
    signal = record().signal
    y = applied("creep", signal, share=0.4, time_constant=0.7, decades=0.0)
    expected = 0.6 * 2.0 * DRIVE + 0.4 * applied("output-lag", signal, time_constant=0.7)
    np.testing.assert_allclose(y, expected, atol=1e-12)


def test_droop_lets_a_step_decay_and_keeps_what_was_there_at_the_first_sample():
    time = np.concatenate([[-1e-9], np.linspace(1e-9, 8.0, 500)])
    step = Signal(time, np.where(time > 0, 1.5, 0.5)[:, None])
    y = applied("droop", step, rate=0.7, share=1.0)
    np.testing.assert_allclose(y, 1.0 + np.where(time > 0, 2.0 * np.exp(-0.7 * np.maximum(time, 0.0)), 0.0), atol=1e-8)


def test_droop_is_a_high_pass():
    from scipy.signal import lsim

    rate, signal = 0.8, record().signal
    _, passed, _ = lsim(([1.0, 0.0], [1.0, rate]), 2.0 * (DRIVE - DRIVE[0]), TIME - TIME[0])
    whole = applied("droop", signal, rate=rate, share=1.0)
    np.testing.assert_allclose(whole, 2.0 * DRIVE[0] + passed, atol=1e-10)
    np.testing.assert_allclose(
        applied("droop", signal, rate=rate, share=0.3), 0.3 * whole + 0.7 * 2.0 * DRIVE, atol=1e-12
    )


def test_drift_counts_from_the_first_sample():
    np.testing.assert_allclose(applied("drift", record().signal, rate=-0.25), 2.0 * DRIVE - 0.25 * (TIME - 2.0))


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


def test_a_bias_reaches_as_far_as_a_response_to_an_input_far_from_zero():
    """A displacement of 0 to 2, zeroed at a bias of 100 V."""
    drive = 100.0 + np.sin(2 * np.pi * TIME)
    low, high = box("bias", record(drive=drive, output=drive - 99.0))["offset"]
    assert low < -99.0
    low, high = box("bias", record(drive=drive - 100.0, output=drive - 99.0))["offset"]
    assert (low, high) == pytest.approx((-2.0, 4.0), abs=1e-3)


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


def test_fatigue_falls_with_the_path_and_not_with_time():
    drive = np.array([0.0, 1.0, 1.0, -1.0, 1.0])
    y = applied("fatigue", Signal(np.arange(5.0), drive[:, None]), rate=0.1)
    np.testing.assert_allclose(y, 2.0 * drive * np.exp(-0.1 * np.array([0, 1, 1, 3, 5])))


def test_a_disturbance_keeps_its_phase_in_a_part_of_a_record():
    whole = record()
    values = {"cosine": 0.3, "sine": -0.2, "frequency": 7.3}
    full = applied("periodic-disturbance", whole.signal, **values)
    part = applied("periodic-disturbance", whole.take(slice(100, None)).signal, **values)
    np.testing.assert_allclose(part, full[100:], rtol=0, atol=1e-12)
    amplitude, phase = np.hypot(0.3, 0.2), np.arctan2(-0.2, 0.3)
    np.testing.assert_allclose(full - 2 * DRIVE, amplitude * np.cos(2 * np.pi * 7.3 * TIME - phase), atol=1e-12)


@pytest.mark.parametrize("uneven", [False, True])
def test_a_hum_is_found_beside_noise_a_trend_and_harmonics_of_the_drive(uneven):
    rng = np.random.default_rng(1)
    records, residuals = [], []
    for name, samples in (("a", 1500), ("b", 2100)):
        time = np.linspace(0.0, samples / 500, samples)
        time = time + (rng.uniform(-4e-4, 4e-4, samples) if uneven else 0.0)
        drive = np.sin(2 * np.pi * 2.0 * time)
        hum = 0.05 * np.sin(2 * np.pi * 49.9 * time + 0.4)
        misfit = 0.4 * drive**3 + 0.3 * np.cos(2 * np.pi * 8.0 * time) + 0.2 * time
        records.append(Record(time, drive, drive, name=name))
        residuals.append(hum + misfit + 0.1 * rng.normal(size=samples))
    first, *_ = registry.build("effects", "periodic-disturbance").starts(records, residuals)
    assert abs(first["frequency"] - 49.9) < 0.1
    assert abs(np.hypot(first["cosine"], first["sine"]) - 0.05) < 0.02
    for key, (low, high) in box("periodic-disturbance", *records).items():
        assert low <= first[key] <= high


def test_temperature_scales_and_shifts():
    warm = np.linspace(20.0, 60.0, TIME.size)
    signal = replace(record().signal, columns={"temperature": warm})
    y = applied("temperature-sensitivity", signal, gain=0.01, expansion=-0.02)
    np.testing.assert_allclose(y, 2.0 * DRIVE * (1 + 0.01 * (warm - 20)) - 0.02 * (warm - 20))
    kelvin = replace(signal, columns={"temperature": warm + 273.15})
    again = applied("temperature-sensitivity", kelvin, {"reference": 293.15}, gain=0.01, expansion=-0.02)
    np.testing.assert_allclose(again, y, rtol=1e-12)


def test_without_a_temperature_it_says_so():
    with pytest.raises(ValueError, match="column temperature"):
        applied("temperature-sensitivity", record().signal, gain=0.0, expansion=0.0)


def test_boxes_follow_the_data():
    data = record()
    assert box("drift", data)["rate"] == pytest.approx((-3.0, 3.0), rel=1e-3)  # 12 in 4 s
    assert box("backlash", data)["half_width"] == pytest.approx((0.0, 2.4), rel=1e-3)
    assert box("saturation", data)["inverse_level"] == pytest.approx((0.0, 1 / 5.4), rel=1e-3)
    assert box("asymmetry", data)["curvature"] == pytest.approx((-0.45 / 3.5, 0.45 / 3.5), rel=1e-3)
    assert box("fatigue", data)["rate"] == pytest.approx((0.0, 3.0 / 48.0), rel=1e-3)  # four cycles of 12
    assert box("transport-delay", data)["delay"] == pytest.approx((2e-4, 0.5), rel=1e-2)  # half a period
    for name in ("input-lag", "output-lag"):
        assert box(name, data)["time_constant"] == pytest.approx((2e-4, 4.0), rel=1e-6)
    assert box("periodic-disturbance", data)["frequency"] == pytest.approx((0.75, 50.0), rel=1e-6)


RATE = ["input-lag", "output-lag", "transport-delay", "creep", "droop", "drift", "periodic-disturbance"]
STATIC = ["saturation", "asymmetry", "backlash", "fatigue"]


@pytest.mark.parametrize("name", RATE)
def test_an_index_is_no_time(name):
    assert "only an index" in against(name, record(units={"time": INDEX, "input": "V", "output": "um"}))


@pytest.mark.parametrize("name", [*STATIC, "stop-above", "stop-below"])
def test_an_index_is_enough_for_what_has_no_rate(name):
    assert against(name, record(units={"time": INDEX, "input": "V", "output": "um"})) == ""


@pytest.mark.parametrize("name", [*RATE[:4], *STATIC[1:]])
def test_an_input_that_never_moves_tells_nothing(name):
    assert against(name, record(drive=np.ones(TIME.size))) == "the input never moves"


@pytest.mark.parametrize("name", ["saturation", "stop-above", "stop-below"])
def test_an_output_that_never_moves_cannot_saturate(name):
    assert against(name, record(output=np.ones(TIME.size))) == "the output never moves"


@pytest.mark.parametrize("name", RATE[:4])
def test_coarse_and_short_records_do_not_resolve_a_lag(name):
    coarse = slice(None, None, 33)  # three samples a cycle
    assert "too coarse" in against(name, record(TIME[coarse], DRIVE[coarse]))
    assert against(name, record(TIME[:5], DRIVE[:5])) == "no record has 8 samples"


def test_one_loop_does_not_tell_fatigue():
    assert "less than four times" in against("fatigue", record(TIME[:101], DRIVE[:101]))


def test_passes_of_a_loop_that_had_settled_do_not_tell_fatigue():
    loop = record(TIME[:101], DRIVE[:101])
    assert "less than four times" in against("fatigue", loop.settled(8))
    assert "less than four times" in against("gain-with-path", loop.settled(8))


def test_too_few_samples_have_no_spectrum():
    assert against("periodic-disturbance", record(TIME[:9], DRIVE[:9])) == "no record has 12 samples"


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        ({}, "record warm has no column temperature"),
        ({"temperature": np.full(TIME.size, 25.0)}, "the temperature never changes"),
        ({"temperature": np.full(TIME.size, np.nan)}, "the temperature is not known at every sample"),
    ],
)
def test_temperature_has_to_be_known_and_to_change(columns, reason):
    assert against("temperature-sensitivity", record(name="warm", columns=columns)) == reason


def test_rayleigh_s_remanence_grows_with_the_square_of_the_amplitude():
    for amplitude in (1.0, 3.0):
        drive = amplitude * np.sin(2 * np.pi * (TIME - 2.0))
        y = applied("rayleigh-hysteresis", record(drive=drive).signal, coefficient=0.2)
        remanence = 0.2 * amplitude**2 / 4  # up to coefficient a²/2, and a quarter of a² less on the way back
        np.testing.assert_allclose(y[[200, 250]], [-remanence, remanence], atol=1e-12)


def test_a_cubic_of_the_input_acts_beside_the_law():
    y = applied("cubic-stiffness", record().signal, cubic=-0.07)
    np.testing.assert_allclose(y, 2.0 * DRIVE - 0.07 * DRIVE**3, rtol=1e-13)


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


def test_a_parallel_curve_comes_near_every_spring_but_its_straight_part():
    """A cubic less the straight line that makes its ends alike, at all knots, and nearly between them."""
    effect = registry.build("effects", "parallel-curve")
    low, high = float(DRIVE.min()), float(DRIVE.max())
    knots = np.linspace(low, high, 11)
    mid = 0.5 * (low + high)

    def added(u: np.ndarray) -> np.ndarray:
        z = (u - mid) / (high - mid)
        return z**3 - z

    bends = {f"bend{k}": float(added(knots[k])) for k in range(10) if k != 5}
    y = applied("parallel-curve", record().signal, lowest=low, highest=high, **bends) - 2.0 * DRIVE
    np.testing.assert_allclose(y, added(DRIVE), atol=0.02)
    names = [p.name for p in effect.parameters]
    assert names == ["lowest", "highest", *bends]


def test_a_dashpot_adds_a_force_that_goes_with_the_rate():
    """Of a parabola the central difference is the slope itself, between even samples."""
    time = np.linspace(0.0, 2.0, 401)
    signal = Record(time, 3.0 * time**2, None).signal
    y = applied("viscous-damping", signal, damping=0.25)
    np.testing.assert_allclose(y[1:-1], (6.0 * time**2 + 0.25 * 6.0 * time)[1:-1], rtol=1e-10)
    still = applied("viscous-damping", replace(signal, timed=False), damping=0.25)
    np.testing.assert_array_equal(still, 6.0 * time**2)


@pytest.mark.parametrize(
    ("force", "within"),
    [
        (lambda v: v, 1e-12),
        (lambda v: v * np.abs(v), 6e-3),
        (lambda v: np.sign(v) * np.sqrt(np.abs(v)), 0.06),
        (np.tanh, 3e-3),
    ],
)
def test_a_damping_curve_comes_near_every_force_of_the_rate(force, within):
    """Through its knots; RMS between them, over the largest force."""
    effect = registry.build("effects", "damping-curve")
    knots = {p.name: float(p.meaning.split(" at ")[1].split()[0]) for p in effect.parameters if p.name != "fastest"}
    forces = {name: float(force(np.array(2.0 * knot - 1.0))) for name, knot in knots.items()}
    drawn = effect.curve(namedtuple("P", ["fastest", *forces])(1.0, **forces))
    wanted = force(drawn.x)
    assert float(np.sqrt(np.mean((drawn.y - wanted) ** 2))) < within * float(np.max(np.abs(wanted)))
    time = np.linspace(0.0, 1.0, 400)
    u = np.sin(2 * np.pi * time) / (2 * np.pi)
    y = applied("damping-curve", Record(time, u, None).signal, fastest=1.0, **forces) - 2.0 * u
    np.testing.assert_allclose(y, np.interp(np.cos(2 * np.pi * time), drawn.x, drawn.y), atol=0.02)


def test_record_drift_takes_a_line_from_every_record_and_leaves_its_mean():
    effect = registry.build("effects", "record-drift")
    slow = record(output=2.0 * DRIVE + 0.3 + 0.7 * (TIME - 2.0))
    adjusted = effect.adjust((2.0 * DRIVE)[:, None], slow)[:, 0]
    np.testing.assert_allclose(adjusted - 2.0 * DRIVE, 0.7 * (TIME - TIME.mean()), atol=1e-12)
    part = replace(slow, history=200)  # only what is scored counts
    np.testing.assert_allclose(
        effect.adjust((2.0 * DRIVE)[:, None], part)[:, 0] - 2.0 * DRIVE, 0.7 * (TIME - 5.0), atol=1e-12
    )
    assert np.array_equal(effect.adjust((2.0 * DRIVE)[:, None], replace(slow, output=None))[:, 0], 2.0 * DRIVE)


def test_one_frequency_does_not_tell_a_resonance():
    sine, slower = record(), record(drive=3.0 * np.sin(np.pi * TIME))
    shrinking = record(drive=DRIVE * (6.5 - TIME))
    triangle = record(drive=3.0 * np.arcsin(np.sin(2 * np.pi * TIME)))
    assert "one frequency" in against("resonance", sine, shrinking)
    assert against("resonance", sine, slower) == against("resonance", triangle) == ""
