"""A mass on a hysteretic spring: against a tight integration, exact answers, and the law itself."""

from collections import namedtuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hysteresis_bench.signals import Signal
from hysteresis_plugins.models.oscillator import LAWS, Oscillator

TIME = np.linspace(0.0, 3.0, 601)


def driven(t):
    return 40.0 * np.sin(2 * np.pi * 3.0 * t) * np.exp(-0.3 * t) + 20.0 * np.sin(2 * np.pi * 7.3 * t)


FORCE = driven(TIME)


def of(model, values):
    names = [q.name for q in model.parameters]
    return namedtuple("Values", names)(*(np.array([values[name]]) for name in names))


def simulated(law, substeps=20, force=FORCE, **values):
    model = Oscillator(law, substeps)
    return model.simulate(Signal(TIME, force[:, None]), of(model, values))[:, 0]


def test_a_linear_spring_answers_as_it_must():
    mass, damping, stiffness = 0.1, 0.4, 90.0
    x = simulated("dahl", mass=mass, damping=damping, distance=1.0, i=1.0, gap=0.0, slope=stiffness, F_C=0.0)

    def rate(t, state):
        return [state[1], (driven(t) - damping * state[1] - stiffness * state[0]) / mass]

    found = solve_ivp(rate, (0.0, 3.0), [0.0, 0.0], t_eval=TIME, rtol=1e-9, atol=1e-10, max_step=1e-3)
    np.testing.assert_allclose(x, found.y[0], atol=2e-3 * np.max(np.abs(x)))


def test_bouc_wen_in_feedback_is_its_equations():
    mass, damping, alpha, beta, gamma, d = 0.1, 0.3, -1.5, 2.0, 1.0, 60.0
    x = simulated("bouc-wen", 40, mass=mass, damping=damping, alpha=alpha, beta=beta, gamma=gamma, d=d)

    def rate(t, state):
        place, speed, h = state
        turned = alpha * d * speed - beta * abs(speed) * h - gamma * speed * abs(h)
        return [speed, (driven(t) - damping * speed - d * place + h) / mass, turned]

    found = solve_ivp(rate, (0.0, 3.0), [0.0, 0.0, 0.0], t_eval=TIME, rtol=1e-9, atol=1e-11, max_step=1e-3)
    np.testing.assert_allclose(x, found.y[0], atol=2e-3 * np.max(np.abs(x)))


@pytest.mark.parametrize("law", sorted(LAWS))
def test_a_slow_force_meets_the_law_itself(law):
    """With next to no mass the force is the law of the displacement found."""
    model = LAWS[law]
    values = dict(model.example.parameters)
    if law in ("prandtl-ishlinskii", "preisach"):
        values = {name: 0.0 if name.endswith(("_2", "_3")) else abs(value) for name, value in values.items()}
    force = 2.0 * np.sin(2 * np.pi * TIME) * (1.0 - 0.2 * TIME)
    x = simulated(law, 4, force, mass=1e-8, damping=1e-3, **values)
    met = model.simulate(Signal(TIME, x[:, None]), of(model, values))[:, 0]
    np.testing.assert_allclose(met[20:], force[20:], atol=0.05)  # at first the mass has to get going


def test_an_unstable_law_stays_finite():
    x = simulated("dahl", mass=1e-3, damping=0.0, distance=0.01, i=1.0, gap=0.0, slope=-500.0, F_C=1.0)
    assert np.all(np.isfinite(x))


def test_halving_the_steps_quarters_the_error():
    values = {"mass": 0.1, "damping": 0.3, "alpha": -1.5, "beta": 2.0, "gamma": 1.0, "d": 60.0}
    best = simulated("bouc-wen", 128, **values)
    coarse, fine = (np.max(np.abs(simulated("bouc-wen", steps, **values) - best)) for steps in (4, 8))
    assert 3.0 < coarse / fine < 5.0
