"""The magnetostrictive rig of domains: minima of their energy, jumps, memory, what it writes."""

import itertools

import numpy as np
import pytest

from hysteresis_plugins.rigs._gma_domains import directions
from hysteresis_plugins.rigs.gma_domains import GmaDomainsRig

CUBIC, STRESS = 40e3, 50e3
QUIET = {"ripple": 0.0, "noise": 0.0}


def energy(theta, field, easy):
    return CUBIC / 8 * np.sin(2 * (theta - easy)) ** 2 + STRESS / 2 * np.cos(theta) ** 2 - field * np.cos(theta)


def swept(easy, fields):
    return directions(np.asarray(fields, dtype=float), np.array([easy]), CUBIC, np.array([STRESS]))[:, 0]


@pytest.mark.parametrize("easy", [-0.4, 0.1, 0.3])
def test_every_domain_rests_in_a_minimum_of_its_energy(easy):
    fields = np.concatenate([np.linspace(0, 90e3, 400), np.linspace(90e3, 0, 400)])
    angles = swept(easy, fields)
    for step in (-1e-3, 1e-3):
        assert np.all(energy(angles + step, fields, easy) > energy(angles, fields, easy))


def test_without_load_a_domain_lies_across_the_rod_and_a_strong_field_turns_it_along():
    angles = swept(0.1, [0.0, 1e6])
    assert abs(np.cos(angles[0])) < 0.15
    assert np.cos(angles[1]) > 0.99


def test_a_domain_jumps_up_at_a_higher_field_than_down():
    fields = np.linspace(0.0, 90e3, 1000)
    angles = swept(0.1, np.concatenate([fields, fields[::-1]]))
    along = np.cos(angles) ** 2
    up, down = np.argmax(np.diff(along[:1000])), np.argmin(np.diff(along[1000:]))
    assert np.diff(along[:1000])[up] > 0.1  # a jump, not a turn
    assert fields[up] > fields[::-1][down] + 1e3


def test_small_loops_close_and_remember():
    """A domain's state is which minimum it is in: a loop between the same two fields comes back."""
    turns = [0.0, 80e3, 30e3, 60e3, 30e3, 60e3]
    path = np.concatenate([np.linspace(a, b, 300) for a, b in itertools.pairwise(turns)])
    easy = np.linspace(-0.5, 0.5, 9)
    angles = directions(path, easy, CUBIC, np.full(9, STRESS))
    np.testing.assert_allclose(angles[899], angles[1499], atol=1e-6)


def test_strain_follows_directions_not_the_sign_of_the_magnetization():
    rig = GmaDomainsRig(field_lag=0.0)
    time = np.linspace(0.0, 1.0, 200)
    there, back = (rig.rod_strain(time, sign * np.linspace(0.0, 90e3, 200)) for sign in (1.0, -1.0))
    np.testing.assert_allclose(there, back, atol=1e-9)
    assert pytest.approx(there[0], abs=1e-12) == 0.0
    assert there[-1] > 1e-3


def test_the_lag_opens_the_loop_with_frequency():
    def opening(experiment, **settings):
        record = GmaDomainsRig(**QUIET, **settings).measure(experiment, np.random.default_rng(0)).records[0]
        return abs(np.trapezoid(record.output[-501:], record.input[-501:]))

    gains = [opening(e) / opening(e, field_lag=0.0) - 1 for e in ("sine-1hz", "sine-50hz", "sine-200hz")]
    assert abs(gains[0]) < 0.05 < gains[1] < gains[2]


def test_settings_that_make_no_rig_are_told():
    for settings, words in (({"cubic": 0.0}, "cubic"), ({"field_lag": -1.0}, "field_lag"), ({"noise": -1.0}, "noise")):
        with pytest.raises(ValueError, match=words):
            GmaDomainsRig(**settings)
