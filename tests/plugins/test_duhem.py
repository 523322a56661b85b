"""The Duhem law on data of known truth."""

import numpy as np
import pytest

from hysteresis_plugins.models.duhem import Duhem
from tests.plugins.truths import assert_found_again, record, simulated, waves

KNOWN, CURVE = {"alpha": 3.0, "centre": 0.1, "width": 0.4}, {"slope": 0.3, "height": 1.0}
SENSES = {"anticlockwise": {"lost": 0.1, "lost_height": 0.6}, "clockwise": {"lost": -0.4, "lost_height": -0.2}}


@pytest.mark.parametrize("lost", SENSES.values(), ids=SENSES.keys())
def test_the_curve_and_what_it_loses_are_found_again_inside_the_box(lost):
    assert_found_again(Duhem(), KNOWN, {**CURVE, **lost})


@pytest.mark.parametrize("sense", SENSES)
def test_the_loop_runs_as_its_losses_say(sense):
    one = record(Duhem(), waves(), **KNOWN, **CURVE, **SENSES[sense])
    area = np.sum(0.5 * (one.output[1:] + one.output[:-1]) * np.diff(one.input))
    assert (area < 0.0) == (sense == "anticlockwise")


def test_what_came_before_is_forgotten_along_the_path():
    """Two histories that end at the same input differ less the further they go on together."""
    onward = np.concatenate([np.linspace(0.0, 1.0, 50), np.linspace(1.0, -1.0, 100)])
    values = {**KNOWN, **CURVE, **SENSES["anticlockwise"]}
    histories = [np.concatenate([np.linspace(start, 0.0, 50), onward]) for start in (1.5, -1.5)]
    gap = np.subtract(*(simulated(Duhem(), u, np.arange(200.0), **values) for u in histories))[49:]
    path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(onward, prepend=0.0)))])
    np.testing.assert_allclose(gap, gap[0] * np.exp(-KNOWN["alpha"] * path), atol=1e-12)
