"""The floor under every judgement."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.evidence.noise import pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import FINEST, floor_of
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.signals import Record


def floor(records):
    views = views_of(records)
    return floor_of(views, pooled_noise([view.noise for view in views]))


def test_the_floor_is_noise_or_what_is_below_any_judgement():
    time = np.linspace(0.0, 10.0, 997)
    zigzag = np.abs((time * np.pi / 3) % 1.0 - 0.5)
    silent = (Record(time, zigzag, 2.0 * zigzag),)
    assert floor(silent) == pytest.approx(FINEST * np.ptp(silent[0].output))
    loud = (Record(time, zigzag, 2.0 * zigzag + 0.02 * np.random.default_rng(5).standard_normal(time.size)),)
    assert floor(loud) == pytest.approx(0.02, rel=0.1)
