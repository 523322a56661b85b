"""When what lies between the samples is asked for: the sooner, the more samples there are to decide between names."""

from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.search import between_samples
from hysteresis_bench.signals import Record


@pytest.mark.parametrize(
    ("samples", "change", "few"),
    [
        (1500, 0.20, True),  # 7.7 standard errors of the noise
        (400, 0.20, False),  # 4
        (100, 0.35, True),  # 3.5, and 6 % of what is left
        (1500, 0.10, False),
        (5000, 0.20, False),  # the search takes some of them only
    ],
)
def test_the_change_is_held_against_the_noise_and_its_standard_error(monkeypatch, samples, change, few):
    time = np.linspace(0.0, 1.0, samples)
    fitter = SimpleNamespace(
        stack=SimpleNamespace(records=(Record(time, time, time),)), fitted=lambda hypothesis: (hypothesis, time)
    )
    monkeypatch.setattr(between_samples, "between_samples", lambda system, records, values: 2.0 * system)
    found = SimpleNamespace(full=fitter, selection=SimpleNamespace(floor=2.0), base=0.0, best=change)
    assert between_samples.few_samples(found) is few
