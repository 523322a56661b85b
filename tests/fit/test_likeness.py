"""Is what is held out like what was fitted? Inputs only are asked, and records that were left out whole are needed."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.signals import Dataset, Record

PHASE = np.linspace(0.0, 3.0, 400)


def record(amplitude: float, frequency: float) -> Record:
    u = amplitude * np.sin(2.0 * np.pi * PHASE)
    return Record(PHASE / frequency, u, u, name=f"{amplitude} at {frequency}")


def like(fitted: Sequence[tuple[float, float]], held_out: tuple[float, float]) -> bool:
    records = [record(*one) for one in (*fitted, held_out)]
    unmeasured = replace(records[-1], name="held out", output=np.full(PHASE.size, np.nan))  # it is not opened
    return judged(records[:-1], Dataset((*records[:-1], unmeasured), (unmeasured.name,))).like


FREQUENCIES = [(1.0, f) for f in (1.0, 2.0, 8.0, 16.0)]
AMPLITUDES = [(a, 1.0) for a in (0.25, 0.5, 1.0)]


@pytest.mark.parametrize(
    ("fitted", "held_out", "expected"),
    [
        (FREQUENCIES, (1.0, 4.0), True),
        (FREQUENCIES, (1.0, 24.0), False),
        ([(1.0, f) for f in (1.0, 1.2, 15.0, 16.0)], (1.0, 4.0), False),
        (AMPLITUDES, (0.75, 1.0), True),
        (AMPLITUDES, (1.5, 1.0), False),
        ([(0.1, 1.0), (1.0, 1.0)], (0.2, 1.0), False),
        ([(1.0, 1.0)], (1.0, 1.0), False),
    ],
    ids=["between", "faster", "in a wide gap", "between amplitudes", "larger", "one left out whole", "a lone record"],
)
def test_what_is_asked_is_like_what_was_left_out(fitted, held_out, expected):
    assert like(fitted, held_out) == expected


def test_nothing_held_out_asks_nothing():
    records = tuple(record(*one) for one in FREQUENCIES)
    assert not judged(records, Dataset(records)).like
