"""What comes before the input has passed both ends of its range is history."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.reading.beginnings import MOST, without_beginnings
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 10.0, 1001)


@pytest.mark.parametrize(
    ("drive", "begins"),
    [
        (np.sin(TIME), 427),  # within 0.05 of its range from its lowest value
        (TIME * np.sin(5.0 * TIME), 900),  # both ends come last of all
    ],
)
def test_a_beginning_ends_where_both_ends_were_passed_and_leaves_a_tenth(drive, begins):
    (cut,) = without_beginnings([Record(TIME, drive, drive)])
    assert abs(cut.history - begins) <= 2
    assert cut.measured.size >= (1.0 - MOST) * TIME.size - 1
