"""What acts beside the law against its own formula."""

from collections import namedtuple
from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.signals import Record
from tests.plugins.around import DRIVE, TIME, applied, record


def test_rayleigh_s_remanence_grows_with_the_square_of_the_amplitude():
    for amplitude in (1.0, 3.0):
        drive = amplitude * np.sin(2 * np.pi * (TIME - 2.0))
        y = applied("rayleigh-hysteresis", record(drive=drive).signal, coefficient=0.2)
        remanence = 0.2 * amplitude**2 / 4  # up to coefficient a²/2, and a quarter of a² less on the way back
        np.testing.assert_allclose(y[[200, 250]], [-remanence, remanence], atol=1e-12)


def test_a_cubic_of_the_input_acts_beside_the_law():
    y = applied("cubic-stiffness", record().signal, cubic=-0.07)
    np.testing.assert_allclose(y, 2.0 * DRIVE - 0.07 * DRIVE**3, rtol=1e-13)


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


def test_a_mass_adds_a_force_that_goes_with_the_acceleration():
    """Of a cubic the central difference of central differences is the second derivative itself, of even samples."""
    time = np.linspace(0.0, 2.0, 401)
    signal = Record(time, time**3, None).signal
    y = applied("inertia", signal, mass=-0.25)
    np.testing.assert_allclose(y[2:-2], (2.0 * time**3 - 0.25 * 6.0 * time)[2:-2], rtol=1e-9)
    still = applied("inertia", replace(signal, timed=False), mass=-0.25)
    np.testing.assert_array_equal(still, 2.0 * time**3)


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
