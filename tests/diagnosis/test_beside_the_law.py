"""A spring, a damper, cogging or a cyclic error: named where its formula is the program's, else by its family."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 2.0, 500)
FAST = 12.0
LIKELY = (
    *("cogging", "cubic-stiffness", "input-cyclic-error", "output-cyclic-error", "viscous-damping"),
    *("asymmetry", "bias", "clock-error", "creep", "inertia", "output-lag", "saturation"),
)
"""What there is here, and what it may be taken for."""

NOISE = 0.003


def loop(u: np.ndarray) -> np.ndarray:
    """Bouc-Wen, in small steps of its own."""
    z, y = 0.0, np.empty_like(u)
    for i, before in enumerate([u[0], *u[:-1]]):
        step = (u[i] - before) / 20
        for _ in range(20):
            z += 4.0 * step - 6.0 * abs(step) * z + 2.0 * step * abs(z)
        y[i] = 0.6 * u[i] - 0.3 * z
    return y


def beside(force):
    """force : of the input and of its rate over a fast one, added to the law's"""
    return lambda u, v: loop(u) + force(u, v)


def fringes(u, v):
    y = loop(u)
    return y + 0.02 * np.sin(2 * np.pi * y / 0.12 + 0.7)


def measured(device) -> Dataset:
    """device : output of the input, and of its rate over a fast one"""
    rng, made = np.random.default_rng(8), []
    for amplitude, frequency, other in ((1.0, 1.0, 0.0), (0.8, 1.5, 0.4), (0.9, 0.5, 0.6)):
        u = np.sin(2 * np.pi * frequency * TIME) + other * np.sin(7.4 * np.pi * frequency * TIME)
        u *= amplitude / np.max(np.abs(u))
        v = np.gradient(u, TIME) / FAST
        made.append(Record(TIME, u, device(u, v), name=f"run {len(made)}"))
    noise = NOISE * np.ptp(made[0].output)
    return Dataset(tuple(Record(r.time, r.input, r.output + noise * rng.standard_normal(500), r.name) for r in made))


@pytest.mark.parametrize(
    ("device", "name"),
    [
        (beside(lambda u, v: 0.25 * u**3), "cubic-stiffness"),
        (beside(lambda u, v: -0.15 * u**3), "cubic-stiffness"),
        pytest.param(beside(lambda u, v: 0.25 * u**5), "parallel-curve", marks=pytest.mark.long),
        (beside(lambda u, v: 0.1 * v), "viscous-damping"),
        pytest.param(beside(lambda u, v: 0.1 * v * np.abs(v)), "damping-curve", marks=pytest.mark.long),
        (beside(lambda u, v: -0.004 * np.gradient(v, TIME)), "inertia"),
        (lambda u, v: np.interp(0.994 * TIME, TIME, loop(u)), "clock-error"),
        (beside(lambda u, v: 0.02 * np.sin(2 * np.pi * u / 0.17 + 0.5)), "cogging"),
        (fringes, "output-cyclic-error"),
        (lambda u, v: loop(u + 0.012 * np.sin(2 * np.pi * u / 0.15 + 1.1)), "input-cyclic-error"),
    ],
)
def test_what_acts_beside_the_law_or_errs_is_named_or_its_family(device, name):
    found = diagnose(measured(device), Question("bouc-wen", among=LIKELY, options=DiagnosisOptions(jobs=1)))
    assert found.effects == (name,)
    assert found.before.fitted.rmse > 2.0 * found.floor
    assert found.after.fitted.rmse < 1.15 * found.floor
