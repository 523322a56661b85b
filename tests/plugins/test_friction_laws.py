"""Friction laws on data of known truth."""

import numpy as np
import pytest

from hysteresis_bench.signals import INDEX, Record
from hysteresis_plugins.models.bouc_wen_generalized import BoucWenGeneralized
from hysteresis_plugins.models.dahl import Dahl
from hysteresis_plugins.models.lugre import Lugre
from hysteresis_plugins.models.maxwell_slip import MaxwellSlip
from tests.plugins.truths import TIME, assert_found_again, held, record, waves

TRUTHS = (
    (MaxwellSlip(elements=3), {"radius": 0.5, "gap": 0.02}, {"slope": 0.4, "k1": 3.0, "k2": 2.0, "k3": 1.0}),
    (
        BoucWenGeneralized(),
        {
            "u_y": 0.1,
            "n": 1.6,
            "beta": 0.6,
            "phi": 0.1,
            "delta_nu": 0.02,
            "delta_eta": 0.02,
            "zeta": 0.4,
            "p": 0.5,
            "q": 0.1,
            "width": 0.3,
        },
        {"slope": 0.4, "F_y": 1.5},
    ),
    (Dahl(), {"distance": 0.1, "i": 0.6, "gap": 0.05}, {"slope": 0.4, "F_C": 1.5}),
    (
        Lugre(),
        {"distance": 0.1, "stiction": 1.4, "v_s": 1.0},
        {"slope": 0.4, "F_C": 1.5, "sigma_1": 0.02, "sigma_2": 0.05},
    ),
)


@pytest.mark.parametrize(("law", "known", "linear"), TRUTHS, ids=lambda one: type(one).__name__)
def test_forces_are_found_again_inside_the_box(law, known, linear):
    assert_found_again(law, known, linear)


@pytest.mark.parametrize(("law", "known", "linear"), TRUTHS, ids=lambda one: type(one).__name__)
def test_friction_that_drives_lies_on_the_other_side_of_the_box(law, known, linear):
    turned = {name: -value for name, value in linear.items()}
    one = record(law, waves(), **known, **turned)
    assert not held(law, [one], {**known, **turned})
    assert set(held(law, [one], {**known, **linear})) == {name for name in linear if name != "slope"}


@pytest.mark.parametrize(("law", "known", "linear"), TRUTHS, ids=lambda one: type(one).__name__)
def test_friction_takes_energy(law, known, linear):
    one = record(law, waves(), **known, **linear)
    work = np.sum(0.5 * (one.output[1:] + one.output[:-1]) * np.diff(one.input))
    stored = 0.5 * linear["slope"] * (one.input[-1] ** 2 - one.input[0] ** 2)
    assert work > stored


def test_nothing_of_the_velocity_without_a_clock():
    units = {"time": INDEX, "input": "m", "output": "N"}
    assert "dahl" in Lugre().advice([Record(TIME, waves(), waves(), units=units)])[-1]
    assert Lugre().advice([Record(TIME, waves(), waves())]) == ()
