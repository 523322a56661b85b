"""The energy-based law on data of known truth."""

import numpy as np

from hysteresis_plugins.models.energy_based import EnergyBased
from tests.plugins.truths import held, record, solved, waves

TRUTH = {**EnergyBased.example.parameters}


def test_slope_and_saturation_are_found_again_inside_the_box():
    law = EnergyBased()
    one = record(law, waves(4.0), **TRUTH)
    found = solved(law, one, **{name: value for name, value in TRUTH.items() if name not in law.linear})
    np.testing.assert_allclose([found[name] for name in law.linear], [TRUTH[name] for name in law.linear], rtol=1e-8)
    assert not held(law, [one], TRUTH)
