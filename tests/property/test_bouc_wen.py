"""What physics promises of Bouc-Wen, the Hammerstein model and the resonance."""

from collections import namedtuple

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares

from hysteresis_bench.compose import System
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Objective, Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects.resonance import Resonance
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.models.hammerstein import Hammerstein

PUBLISHED = np.array([0.304225, 0.675313, 0.497724, 1.045814])  # PEA paper, Table 2, G-Pmix
LINEAR = np.array([267_700.0, 510.1069, 255_700.0])  # PEA paper, Table 3, G-Pmix

turning_points = st.lists(st.floats(-10, 10), min_size=2, max_size=8)
shapes = st.tuples(st.floats(0.01, 0.9), st.floats(0.05, 5), st.floats(-0.9, 0.9), st.floats(0.1, 5))


def through(points, samples=40):
    """A path that starts at 0 and runs linearly from point to point."""
    knots = np.concatenate([[0.0], points])
    return np.interp(np.linspace(0, knots.size - 1, samples * (knots.size - 1) + 1), np.arange(knots.size), knots)


def output(u, parameters, n=1.0, time=None):
    time = np.arange(u.size, dtype=float) if time is None else time
    system = System(BoucWen(n))
    return system.simulate(Signal(time, u[:, None]), np.asarray(parameters, dtype=float)[:, None])[:, 0]


def shaped(shape):
    alpha, beta, ratio, d = shape
    return alpha, beta, ratio * beta, d  # |gamma| < beta: the physical shapes


def record(u, parameters=PUBLISHED, name="data"):
    time = np.linspace(0, 6, u.size)
    return Record(time, u, output(u, parameters), name)


@given(turning_points, shapes, st.floats(1e-3, 1e3), st.sampled_from([1.0, 2.5]))
@settings(max_examples=25, deadline=None)
def test_time_never_enters(points, shape, stretch, n):
    u = through(points)
    time = stretch * np.cumsum(np.linspace(1, 3, u.size))
    np.testing.assert_array_equal(output(u, shaped(shape), n, time), output(u, shaped(shape), n))


@given(turning_points, shapes, st.integers(2, 9))
@example([1e-20, 0.0, -1.0], (0.5, 1.0, 0.5, 1.0), 2)  # the way back to 0 rounds to a force of exactly 0
@settings(max_examples=25, deadline=None)
def test_sampling_the_same_path_more_finely_changes_rounding_only(points, shape, times):
    u = through(points, samples=8)
    finer = np.interp(np.linspace(0, u.size - 1, times * (u.size - 1) + 1), np.arange(u.size), u)
    coarse, fine = output(u, shaped(shape)), output(finer, shaped(shape))[::times]
    np.testing.assert_allclose(fine, coarse, rtol=0, atol=1e-11 * (1 + np.abs(coarse).max()))


@given(st.floats(0.2, 10), shapes)
@settings(max_examples=25, deadline=None)
def test_repeated_cycles_close_and_dissipate(amplitude, shape):
    parameters = shaped(shape)
    cycles = int(20 / (amplitude * parameters[1])) + 12  # it closes as the path relaxes: exp(-4 amplitude beta) a cycle
    u = through(np.tile([amplitude, -amplitude], min(cycles, 300)))
    v = output(u, parameters)
    last = slice(-81, None)
    work = np.sum(0.5 * (u[last][1:] + u[last][:-1]) * np.diff(v[last]))  # of u dv around the loop
    span = np.ptp(v)
    if cycles <= 300:
        assert abs(v[-1] - v[-81]) < 1e-6 * span
        assert work >= -1e-9 * span * amplitude


@given(shapes, turning_points)
@settings(max_examples=25, deadline=None)
def test_a_mirrored_input_gives_a_mirrored_output(shape, points):
    u = through(points)
    np.testing.assert_array_equal(output(-u, shaped(shape)), -output(u, shaped(shape)))


def test_published_parameters_are_recovered_from_noise_free_data():
    u = 2.5 * np.sin(2 * np.pi * 0.5 * np.linspace(0, 6, 6000))
    data = record(u)
    system = System(BoucWen())
    problem = Problem(system, (data,), Space(system.box((data,))), LOSSES["rmse"])
    meter = Objective(problem, 400)
    found = least_squares(meter.residuals, np.full(4, 0.5), bounds=(0, 1), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    assert meter.evaluations < 400
    np.testing.assert_allclose(problem.space.from_unit(found.x[:, None])[:, 0], PUBLISHED, rtol=1e-6)


@pytest.mark.parametrize(("scale_in", "scale_out"), [(1.0, 1.0), (100.0, 1e-6)])
def test_the_box_follows_the_units_of_the_data(scale_in, scale_out):
    u = 2.5 * scale_in * np.sin(np.linspace(0, 20, 500))
    parameters = PUBLISHED * [1.0, 1 / scale_in, 1 / scale_in, scale_out / scale_in]
    data = record(u, parameters)
    for model, truth in ((BoucWen(), parameters), (BoucWen(2.0), parameters[:1])):
        for parameter, value in zip(model.box((data,)), truth, strict=False):
            assert not parameter.faults()
            assert parameter.lower < value < parameter.upper


def test_the_sense_of_the_loop_decides_the_side_of_alpha():
    u = 2.5 * np.sin(np.linspace(0, 20, 500))
    lagging = record(u)
    force = record(u, [-20.0, 2.0, 0.4, 0.1])
    line = Record(lagging.time, u, 2.0 * u)
    edges = [(BoucWen().box((one,))[0].lower, BoucWen().box((one,))[0].upper) for one in (lagging, force, line)]
    assert edges == [(0.0, 2.0), (-200.0, 0.0), (-200.0, 2.0)]
    mirrored = Record(lagging.time, -u, lagging.output)
    assert BoucWen().box((mirrored,))[0].upper == 0.0
    assert BoucWen().box((lagging, force))[0].lower < 0.0 < BoucWen().box((lagging, force))[0].upper


def test_advice_on_the_sign_holds_whether_the_input_was_turned_or_not():
    u = 2.5 * np.sin(np.linspace(0, 20, 500))
    rising, falling = record(u), Record(np.arange(u.size) * 1.0, u, -record(u).output, "falling")
    (told,) = BoucWen().advice((falling,))
    assert "input" in told
    assert "or without it where it was given" in told
    (told,) = BoucWen().advice((rising, falling))
    assert "--flip" not in told
    noise = np.random.default_rng(1).normal(size=u.size)
    assert not any("flip" in said for said in BoucWen().advice((Record(np.arange(u.size) * 1.0, u, noise - 0.05 * u),)))


def test_advice_on_sign_and_offset_and_silence_on_good_data():
    u = 2.5 * np.sin(np.linspace(0, 20, 500))
    good = record(u)
    flipped = Record(good.time, u, -good.output, "flipped")
    shifted = Record(good.time, u, good.output + 3.0, "shifted")
    assert BoucWen().advice((good,)) == ()
    assert "--flip" in BoucWen().advice((flipped,))[0]
    assert "bias" in BoucWen().advice((shifted,))[0]


def test_n_below_one_is_refused():
    with pytest.raises(ValueError, match="at least 1"):
        BoucWen(0.5)
    with pytest.raises(ValueError, match="at least 1"):
        Hammerstein(0.5)


def test_hammerstein_is_bouc_wen_under_resonance_with_the_static_gain():
    time = np.linspace(0, 0.5, 2500)
    signal = Signal(time, 2.5 * np.sin(2 * np.pi * 30 * time)[:, None])
    b, c, k = LINEAR
    hammerstein = System(Hammerstein()).simulate(signal, np.array([*PUBLISHED, *LINEAR])[:, None])
    period, damping = 2 * np.pi / np.sqrt(k), c / (2 * np.sqrt(k))
    wrapped = System(BoucWen(), (("resonance", Resonance()),))
    resonant = wrapped.simulate(signal, np.array([*PUBLISHED, period, damping])[:, None])
    np.testing.assert_allclose(hammerstein, resonant * b / k, rtol=0, atol=1e-12)


def test_only_the_product_of_d_and_b_is_seen():
    time = np.linspace(0, 0.5, 1000)
    signal = Signal(time, 2.5 * np.sin(2 * np.pi * 30 * time)[:, None])
    one = np.array([*PUBLISHED, *LINEAR])
    other = one * [1, 1 * 2, 1 * 2, 0.5, 2, 1, 1]  # h scales with d, so beta and gamma stay: not this one
    same = one * [1, 1, 1, 0.5, 2, 1, 1]
    y = System(Hammerstein()).simulate(signal, np.column_stack([one, same, other]))
    np.testing.assert_allclose(y[:, 1], y[:, 0], rtol=0, atol=1e-12)
    assert np.abs(y[:, 2] - y[:, 0]).max() > 1e-3


def test_without_a_clock_the_linear_stage_is_its_gain():
    u = 2.5 * np.sin(np.linspace(0, 20, 500))
    signal = Signal(np.arange(500.0), u[:, None], timed=False)
    y = System(Hammerstein()).simulate(signal, np.array([*PUBLISHED, *LINEAR])[:, None])[:, 0]
    np.testing.assert_allclose(y, output(u, PUBLISHED) * LINEAR[0] / LINEAR[2], rtol=1e-14)
    data = Record(signal.time, u, y, units={"time": "sample", "input": "V", "output": "um"})
    assert "index" in Resonance().inapplicable((data,))
    assert "index" in Hammerstein().advice((data,))[-1]


def test_resonance_is_off_at_its_null_and_near_it():
    p = namedtuple("P", "period damping")(np.array([0.0, 1e-7, 0.0124]), np.array([0.5, 0.5, 0.5]))
    time = np.linspace(0, 1, 2000)
    x = np.sin(2 * np.pi * 20 * time)[:, None]
    y = Resonance().apply(lambda signal: np.repeat(x, 3, axis=1), Signal(time, x), p)
    np.testing.assert_array_equal(y[:, 0], x[:, 0])
    assert 0 < np.abs(y[:, 1] - x[:, 0]).max() < 1e-5
    assert np.abs(y[:, 2] - x[:, 0]).max() > 0.1


def test_boxes_of_the_linear_stage_hold_the_published_one():
    time = np.linspace(0, 1.2, 6000)
    data = Record(time, 2.5 * np.sin(2 * np.pi * 50 * time), np.sin(2 * np.pi * 50 * time))
    boxes = {parameter.name: parameter for parameter in Hammerstein().box((data,))}
    for name, value in zip(("b", "c_over_m", "k_over_m"), LINEAR, strict=True):
        assert not boxes[name].faults()
        assert boxes[name].lower < value < boxes[name].upper
    period = Resonance().box((data,))[0]
    assert period.upper == pytest.approx(0.04, rel=0.01)


def test_the_published_linear_stage_is_recovered_from_a_noise_free_sweep():
    time = np.arange(5000) * 1e-3
    u = 2.5 * np.sin(2 * np.pi * (0.1 * time + 49.9 * time**2 / 10))  # 0.1 to 50 Hz
    system = System(Hammerstein())
    y = system.simulate(Signal(time, u[:, None]), np.array([*PUBLISHED, *LINEAR])[:, None])[:, 0]
    data = Record(time, u, y)
    space = Space(Hammerstein().box((data,))[4:])

    def residuals(point):
        stage = space.from_unit(point[:, None])[:, 0]
        return system.simulate(data.signal, np.array([*PUBLISHED, *stage])[:, None])[:, 0] - y

    found = least_squares(residuals, np.full(3, 0.5), bounds=(0, 1), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    np.testing.assert_allclose(space.from_unit(found.x[:, None])[:, 0], LINEAR, rtol=1e-6)
