"""Laws of metals, timber, superelastic bars and rocking walls on data of known truth."""

import numpy as np
import pytest

from hysteresis_plugins.models.chaboche import Chaboche
from hysteresis_plugins.models.chaboche_bowed import ChabocheBowed
from hysteresis_plugins.models.flag_shaped import FlagShaped
from hysteresis_plugins.models.folz_filiatrault import FolzFiliatrault
from hysteresis_plugins.models.pinching import Pinching
from hysteresis_plugins.models.self_centring import SelfCentring
from tests.plugins.truths import assert_found_again, record, waves

METAL = {"u_y": 0.1, "Q": 0.4, "b": 0.1, "D": 0.1, "a": 1.0, "S_1": 0.6, "gamma_1": 9.0, "S_2": 0.8, "gamma_2": 2.0}
TRUTHS = (
    (Chaboche(), METAL, {"E": 2.0}),
    (ChabocheBowed(), {**METAL, "bow": 0.8, "u_b": 0.1}, {"E": 2.0, "loss": 0.5}),
    (
        FolzFiliatrault(),
        {"u_y": 0.1, "r_1": 0.05, "r_3": 1.2, "f_I": 0.1, "r_4": 0.3, "alpha": 0.6, "beta": 1.05},
        {"F_0": 1.5},
    ),
    (
        Pinching(),
        {"u_y": 0.1, "r_1": 0.08, "f_I": 0.05, "gamma": 0.4, "r_4": 0.7, "beta": 1.05, "rho": 0.08, "corner": 0.3},
        {"F_0": 1.5},
    ),
    (FlagShaped(), {"u_y": 0.2, "beta": 0.6, "m": 6.0, "centre": 0.02}, {"up": 1.0, "down": 0.8, "slope": 0.1}),
    (
        SelfCentring(),
        {"u_r": 0.2, "m": 3.0, "centre": 0.02, "u_y": 0.1, "i": 1.0, "q": 0.6},
        {"up": 0.4, "down": 0.3, "F_r": 1.5, "F_y": 0.3, "loss": 0.2},
    ),
)


@pytest.mark.parametrize(("law", "known", "linear"), TRUTHS, ids=lambda one: type(one).__name__)
def test_forces_are_found_again_inside_the_box(law, known, linear):
    assert_found_again(law, known, linear)


@pytest.mark.parametrize(("law", "known", "linear"), TRUTHS, ids=lambda one: type(one).__name__)
def test_they_take_energy_from_a_closed_path(law, known, linear):
    one = record(law, np.concatenate([waves(), waves()[::-1]]), **known, **linear)
    assert np.sum(0.5 * (one.output[1:] + one.output[:-1]) * np.diff(one.input)) > 0.0


def test_a_rocking_wall_comes_back_to_its_centre():
    law, known, linear = TRUTHS[-1]
    linear = {**linear, "F_y": 0.0, "loss": 0.0}
    one = record(law, waves(), **known, **linear)
    rest = record(law, np.full(3, 0.02), **known, **linear)
    np.testing.assert_allclose(rest.output, 0.0, atol=1e-15)
    large = np.abs(one.input - 0.02) > 5 * 0.2
    side = np.where(one.input > 0.02, 0.4, 0.3)
    straight = side * (one.input - 0.02) + 1.5 * np.sign(one.input - 0.02)
    np.testing.assert_allclose(one.output[large], straight[large], rtol=5e-3)


def test_a_rocking_wall_loses_force_on_the_side_that_it_went_to():
    law, known, linear = TRUTHS[-1]
    there, back = np.linspace(0.02, 1.02, 50), np.linspace(-0.98, 1.02, 50)
    one = record(law, np.concatenate([there, back[::-1], back]), **known, **{**linear, "F_y": 0.0})
    left = 1.5 - 0.2 * 5.0**0.6
    held = left * np.array([1.0, -1.0, 1.0]) * 5.0 / (1.0 + 5.0**3) ** (1.0 / 3.0) + np.array([0.4, -0.3, 0.4])
    np.testing.assert_allclose(one.output[[49, 99, 149]], held, rtol=1e-12)
    first, again = np.interp(0.52, there, one.output[:50]), np.interp(0.52, back, one.output[100:])
    np.testing.assert_allclose(again, left * 2.5 / (1.0 + 2.5**3) ** (1.0 / 3.0) + 0.4 * 0.5, rtol=1e-3)
    assert again < first - 0.05
