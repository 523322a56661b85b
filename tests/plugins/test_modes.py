"""Two modes beside a direct path are transfer functions of fourth order with unit static gain, whatever their zeros."""

from collections import namedtuple

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.signal import lsim

from hysteresis_bench import registry
from tests.plugins.around import DRIVE, TIME, against, applied, box, record


def mode(frequency, damping):
    omega = 2.0 * np.pi * frequency
    return Polynomial([1.0, 2.0 * damping / omega, 1.0 / omega**2])


LOW, HIGH = mode(3.0, 0.1), mode(8.0, 0.3)
ABOVE = {
    "in series": Polynomial([1.0]),
    "two antiresonances": mode(4.0, 0.02) * mode(9.0, 0.1),
    "on a soft mount": Polynomial([1.0, 0.05]),
    "with no minimum of its phase": Polynomial([1.0, -0.03]),
}


def parted(above):
    """Its parameters, by partial fractions of H(s) - 1, which is 0 at s = 0, over s.

    A mode is w ((1 + lead s / omega) / m(s) - 1), so over s it is w (lead / omega - m_1 - m_2 s) / m(s).
    """
    below = LOW * HIGH
    rest = (above - below).coef[1:]  # over s
    sides = np.zeros((4, 4))  # a cubic in s is (a + b s) high + (c + d s) low
    for column, (factor, power) in enumerate([(HIGH, 0), (HIGH, 1), (LOW, 0), (LOW, 1)]):
        sides[power : power + 3, column] = factor.coef
    first = np.linalg.solve(sides, np.pad(rest, (0, 4 - rest.size)))
    values = {}
    for k, (part, pair) in enumerate(zip((LOW, HIGH), (first[:2], first[2:]), strict=True), 1):
        _, linear, square = part.coef
        omega = square**-0.5
        weight = -pair[1] / square
        values |= {
            f"period{k}": 2.0 * np.pi / omega,
            f"damping{k}": 0.5 * linear * omega,
            f"weight{k}": weight,
            f"lead{k}": (pair[0] / weight + linear) * omega,
        }
    return values


@pytest.fixture(params=ABOVE.values(), ids=ABOVE.keys())
def transfer(request):
    return request.param, LOW * HIGH


def simulated(transfer, x):
    """From equilibrium with the first sample; x : linear between the samples"""
    above, below = (one.coef[::-1] for one in transfer)
    return x[0] + lsim((above, below), x - x[0], TIME, interp=True)[1]


def test_they_are_the_transfer_function_after(transfer):
    found = applied("modes-after", record().signal, **parted(transfer[0]))
    np.testing.assert_allclose(found, simulated(transfer, 2.0 * DRIVE), rtol=0, atol=1e-8)


def test_they_are_the_transfer_function_before(transfer):
    found = applied("modes-before", record().signal, **parted(transfer[0]))
    np.testing.assert_allclose(found, 2.0 * simulated(transfer, DRIVE), rtol=0, atol=1e-8)


def test_the_curve_is_the_gain(transfer):
    values = parted(transfer[0])
    curve = registry.build("effects", "modes-after").curve(namedtuple("Values", values)(**values))
    above, below = (one(2j * np.pi * curve.x) for one in transfer)
    np.testing.assert_allclose(curve.y, np.abs(above / below), rtol=1e-9)
    assert curve.x[0] < 0.5 < 30.0 < curve.x[-1]


def test_without_weights_nothing_changes_to_the_last_bit():
    values = parted(ABOVE["in series"]) | {"weight1": 0.0, "weight2": 0.0}
    for name in ("modes-after", "modes-before"):
        np.testing.assert_array_equal(applied(name, record().signal, **values), 2.0 * DRIVE)


def test_periods_go_from_two_steps_to_twice_the_drive_s():
    low, high = box("modes-after", record())["period1"]
    assert low == pytest.approx(2.0 * (TIME[1] - TIME[0]))
    assert high == pytest.approx(2.0, rel=0.01)
    assert "one frequency" in against("modes-before", record())
    assert not against("modes-before", record(), record(drive=3.0 * np.sin(8.0 * TIME)))
