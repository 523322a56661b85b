"""The Duhem kernel against its plain twin, its differential equation, and what is known in closed form."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from hysteresis_bench.kernels.duhem import duhem, means


def outputs(u, parameters):
    """y of one particle, sample by sample: the means by quadrature, the cubic as [1] of the kernel has it."""
    rate, centre, width, slope, height, lost, lost_height = parameters
    found, lag, before, before_t = [], 0.0, u[0], math.tanh((u[0] - centre) / width)
    for now in u:
        t, step = math.tanh((now - centre) / width), now - before
        chord, x = t - before_t, rate * abs(step)
        most = 3.0 * abs(chord)
        sign = math.copysign(1.0, step)
        begins = sign * min((1.0 - before_t**2) / width * abs(step), most)
        ends = sign * min((1.0 - t**2) / width * abs(step), most)

        def fading(s, x=x):
            return math.exp(-x * (1.0 - s))

        def slopes(s, begins=begins, ends=ends, chord=chord):
            return begins * (1 - 4 * s + 3 * s * s) + ends * (3 * s * s - 2 * s) + 6 * chord * (s - s * s)

        growth = lost * step * quad(fading, 0.0, 1.0, epsabs=1e-14)[0]
        growth += lost_height * quad(lambda s: fading(s) * slopes(s), 0.0, 1.0, epsabs=1e-14)[0]
        lag = math.exp(-x) * lag + growth
        before, before_t = now, t
        found.append(slope * now + height * t - lag)
    return np.array(found)


def swarm_at_the_corners(rng, swarm):
    """All parameters at the edges of a box and inside it."""
    return np.stack(
        [
            rng.choice([0.0, 1e-3, 0.7, 5.0, 100.0], swarm),
            rng.choice([-0.5, 0.0, 0.3], swarm),
            rng.choice([0.05, 0.5, 3.0], swarm),
            *rng.choice([-1.0, 0.0, 0.7], (2, swarm)),
            *rng.choice([-0.4, 0.0, 0.9], (2, swarm)),
        ]
    )


def simulated(u, parameters):
    y = np.empty((u.shape[0], parameters.shape[1]))
    duhem(u, parameters, y)
    return y


@pytest.mark.parametrize("swarm", [1, 8, 19])
@pytest.mark.parametrize("columns", [1, None])
def test_it_is_its_twin(swarm, columns):
    rng = np.random.default_rng(swarm)
    p = swarm_at_the_corners(rng, swarm)
    u = np.cumsum(rng.normal(size=(60, columns or swarm)), axis=0) * 0.1
    u[:5] = 0.0
    found = simulated(u, p)
    for column in range(swarm):
        own = u[:, min(column, u.shape[1] - 1)]
        np.testing.assert_allclose(found[:, column], outputs(own, p[:, column]), rtol=1e-12, atol=1e-12)


def test_a_particle_does_not_know_of_the_others():
    rng = np.random.default_rng(4)
    p, u = swarm_at_the_corners(rng, 19), rng.normal(size=(50, 1))
    assert np.array_equal(simulated(u, np.ascontiguousarray(p[:, 5:11])), simulated(u, p)[:, 5:11])


@pytest.mark.parametrize("x", [0.0, 1e-9, 0.1, 0.4999999, 0.5, 0.51, 3.0, 40.0, 900.0])
def test_the_means_are_the_integrals(x):
    for power, found in enumerate(means(x)[:3]):
        expected = quad(lambda s, k=power: s**k * math.exp(-x * (1 - s)), 0.0, 1.0, epsabs=1e-15, epsrel=1e-13)[0]
        assert found == pytest.approx(expected, rel=1e-12)
    assert means(x)[3] == pytest.approx(math.exp(-x), rel=1e-14)


def test_it_solves_coleman_and_hodgdons_equation_to_fourth_order():
    """y' = rate |u'| (f - y) + g u', by a tight integrator along the same straight pieces of the input."""
    rate, centre, width, slope, height, lost, lost_height = p = (2.0, 0.1, 0.4, 0.3, 1.0, 0.2, 0.7)
    turns = np.array([0.3, 1.2, -1.0, 0.5, 0.2, 1.1])

    def derivative(way, y, sign, start):
        u = start + sign * way
        bell = (1.0 - np.tanh((u - centre) / width) ** 2) / width
        f = slope * u + height * np.tanh((u - centre) / width)
        return rate * (f - y) + sign * (slope + height * bell - lost - lost_height * bell)

    y, expected = slope * turns[0] + height * np.tanh((turns[0] - centre) / width), []
    for start, end in pairwise(turns):
        branch = (0.0, abs(end - start))
        y = solve_ivp(derivative, branch, [y], args=(np.sign(end - start), start), rtol=1e-12, atol=1e-13).y[0, -1]
        expected.append(y)
    errors = []
    for finer in (10, 20, 40):
        u = np.interp(np.arange(5 * finer + 1) / finer, np.arange(6), turns)
        errors.append(np.max(np.abs(simulated(u[:, None], np.array(p)[:, None])[finer::finer, 0] - expected)))
    assert errors[-1] < 1e-5
    assert errors[0] / errors[1] > 10.0
    assert errors[1] / errors[2] > 10.0


def test_without_a_steep_part_it_is_bouc_wen():
    from hysteresis_bench.kernels.bouc_wen import bouc_wen

    rng = np.random.default_rng(3)
    u = np.cumsum(rng.normal(size=(200, 1)), axis=0) * 0.2
    u -= u[0]
    alpha, beta, d = 0.4, 1.5, 1.3
    found = simulated(u, np.array([beta, 0.0, 1.0, d, 0.0, alpha * d, 0.0])[:, None])
    one = [np.array([value]) for value in (alpha, beta, 0.0, d)]
    np.testing.assert_allclose(found, bouc_wen(u, *one), atol=1e-12)


def test_a_step_of_any_length_stays_within_the_curve():
    """Where all of the curve's height is lost, the lag of the steep part is no larger than its way."""
    rng = np.random.default_rng(6)
    u = rng.normal(size=(400, 1)) * 30.0
    p = np.array([[0.0, 0.02, 5.0], [0.0] * 3, [0.05] * 3, [0.0] * 3, [0.0] * 3, [0.0] * 3, [1.0] * 3])
    assert np.max(np.abs(simulated(u, p))) <= 2.0
