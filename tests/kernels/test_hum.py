"""A hum that a channel picks up is told from what drives."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.kernels.hum import hum

TIME = np.arange(3000) / 500.0
TONES = sum(np.sin(2.0 * np.pi * f * TIME + f) for f in (0.3, 0.8, 1.7, 2.6))
DRIVES = {
    "sine": 2.0 * np.sin(np.pi * TIME),
    "tones": TONES,
    "sweep": 1.5 * np.sin(2.0 * np.pi * (0.5 + 0.4 * TIME) * TIME),
    "triangle": 1.3 * np.arcsin(np.sin(3.0 * TIME)),
    "stairs": np.repeat(np.random.default_rng(1).uniform(-2.0, 2.0, 60), 50),
    "cycles that grow": TIME * np.sin(2.0 * np.pi * TIME),
}


@pytest.mark.parametrize("drive", ["sine", "tones", "sweep", "cycles that grow"])
@pytest.mark.parametrize(("frequency", "share"), [(49.97, 0.015), (60.02, 0.003), (150.3, 0.01)])
def test_a_hum_is_found_and_nothing_else(drive, frequency, share):
    rng = np.random.default_rng(2)
    true = share * np.ptp(DRIVES[drive]) * np.sin(2.0 * np.pi * frequency * TIME + 1.0)
    noise = 0.02 * share * np.ptp(DRIVES[drive]) * rng.standard_normal(TIME.size)
    found = hum(TIME, DRIVES[drive] + true + noise)
    assert np.sqrt(np.mean((found - true) ** 2)) < 0.02 * np.std(true)


@pytest.mark.parametrize("drive", DRIVES.values(), ids=DRIVES)
@pytest.mark.parametrize("noise", [0.0, 0.001, 0.01])
def test_what_drives_is_no_hum(drive, noise):
    rng = np.random.default_rng(3)
    assert not np.any(hum(TIME, drive + noise * np.ptp(drive) * rng.standard_normal(TIME.size)))


def test_two_tones_of_one_size_are_no_hum():
    assert not np.any(hum(TIME, np.sin(6.0 * TIME) + 0.2 * np.sin(180.0 * TIME)))


def test_of_uneven_samples_or_a_constant_nothing_is_said():
    uneven = np.sort(np.random.default_rng(4).uniform(0.0, 6.0, 3000))
    assert not np.any(hum(uneven, np.sin(uneven) + 0.01 * np.sin(300.0 * uneven)))
    assert not np.any(hum(TIME, np.full(TIME.size, 3.0)))
