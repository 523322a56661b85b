"""A spring beside a hysteresis: named where it is a cubic, its family where it follows another formula."""

import numpy as np
import pytest

from hysteresis_bench import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 2.0, 500)
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


def measured(spring) -> Dataset:
    rng, made = np.random.default_rng(8), []
    for amplitude, frequency, other in ((1.0, 1.0, 0.0), (0.8, 1.5, 0.4), (0.9, 0.5, 0.6)):
        u = np.sin(2 * np.pi * frequency * TIME) + other * np.sin(7.4 * np.pi * frequency * TIME)
        u *= amplitude / np.max(np.abs(u))
        made.append(Record(TIME, u, loop(u) + spring(u), name=f"run {len(made)}"))
    noise = NOISE * np.ptp(made[0].output)
    return Dataset(tuple(Record(r.time, r.input, r.output + noise * rng.standard_normal(500), r.name) for r in made))


@pytest.mark.parametrize(
    ("spring", "name"),
    [
        (lambda u: 0.25 * u**3, "cubic-stiffness"),
        (lambda u: -0.15 * u**3, "cubic-stiffness"),
        (lambda u: 0.25 * u**5, "parallel-curve"),
    ],
)
def test_a_spring_beside_the_law_is_named_or_its_family(spring, name):
    found = diagnose(measured(spring), "bouc-wen", options=DiagnosisOptions(jobs=1))
    assert found.effects == (name,)
    assert found.before.fitted.rmse > 3.0 * found.floor
    assert found.after.fitted.rmse < 1.1 * found.floor
