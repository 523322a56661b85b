"""Pinning that depends on the magnetization: against the plain kernel, and against the equation."""

import numpy as np
import pytest

from hysteresis_bench.kernels import jiles_atherton as plain
from hysteresis_bench.kernels import jiles_atherton_pinning as pinned
from hysteresis_bench.kernels.jiles_atherton import MU0
from tests.conftest import as_models_call

jiles_atherton = as_models_call(plain.jiles_atherton, 0)
jiles_atherton_pinning = as_models_call(pinned.jiles_atherton_pinning, 0)

LAW = [np.array([value]) for value in (1e-6, 6.0, 10.0, 2.5e6, 0.2)]


def drive(samples):
    return 60.0 * np.sin(2 * np.pi * np.linspace(0.0, 1.25, samples))[:, None]


def test_without_it_the_kernel_is_the_clamped_one():
    H = drive(800)
    np.testing.assert_allclose(
        jiles_atherton_pinning(H, *LAW, np.zeros(1)), jiles_atherton(H, *LAW, True), rtol=1e-9, atol=1e-9
    )


@pytest.mark.parametrize("kappa", [-0.5, 3.0])
def test_it_is_its_equation(kappa):
    """dM_irr/dH = D / (delta k(M) - alpha D), clamped, by Heun's rule on a fine path; alpha M is explicit."""
    alpha, a, k, M_s, c = (float(value[0]) for value in LAW)
    fine = drive(200_001)[:, 0]

    def anhysteretic(field, M):
        x = (field + alpha * M) / a
        return M_s * (1.0 / np.tanh(x) - 1.0 / x if abs(x) > 1e-3 else x / 3.0)

    Mi = M = 0.0
    found = [MU0 * fine[0]]
    for before, field in zip(fine[:-1].tolist(), fine[1:].tolist(), strict=True):
        dH = field - before
        delta = np.sign(dH)
        D = anhysteretic(0.5 * (before + field), M) - Mi
        pinned = k * (1.0 + kappa * (1.0 - (M / M_s) ** 2))
        Mi += max(D * delta, 0.0) / (pinned - alpha * D * delta) * delta * abs(dH)
        M = (1.0 - c) * Mi + c * anhysteretic(field, M)
        found.append(MU0 * (field + M))
    coarse = jiles_atherton_pinning(drive(2001), *LAW, np.array([kappa]))[:, 0]
    np.testing.assert_allclose(coarse, np.array(found)[::100], atol=5e-3 * np.max(found))


def test_a_positive_one_widens_the_middle_of_the_loop():
    H = drive(2001)
    falling = slice(600, 1000)
    coercive = []
    for kappa in (0.0, 2.0):
        B = jiles_atherton_pinning(H, *LAW, np.array([kappa]))[falling, 0]
        coercive.append(abs(np.interp(0.0, B[::-1], H[falling, 0][::-1])))
    assert coercive[1] > 1.5 * coercive[0]
