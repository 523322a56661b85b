"""Records: parts, history, and loops repeated until they settle."""

import numpy as np
import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Record


def loop():
    time = np.arange(8) * 0.5
    return Record(time, np.sin(time), np.cos(time), columns={"temperature": time + 20})


def test_settled_repeats_the_loop_as_history():
    settled = loop().settled(2)
    assert settled.time.size == 24
    assert np.all(np.diff(settled.time) > 0)
    assert np.allclose(np.diff(settled.time), 0.5)
    assert np.array_equal(settled.time[settled.scored], loop().time)
    assert np.array_equal(settled.measured, loop().output)
    assert np.array_equal(settled.input[:8], settled.input[16:])


def test_a_part_keeps_its_share_of_the_history():
    part = loop().skip(1.5).take(slice(2, 6))
    assert part.history == 1
    assert part.columns["temperature"].tolist() == [21, 21.5, 22, 22.5]
    assert part.measured.size == 3


def test_an_input_shared_by_the_swarm_is_one_column():
    assert loop().signal.input.shape == (8, 1)
    assert loop().signal.input.flags.c_contiguous


@pytest.mark.parametrize("time", [[0.0, 0.0, 1.0], [0.0, 2.0, 1.0], [0.0, np.nan, 1.0], [0.0, 1.0, np.inf]])
def test_a_time_that_does_not_increase_is_refused(time):
    with pytest.raises(UserError, match="record up: its times must be finite and strictly increase"):
        Record(np.array(time), np.zeros(3), None, "up")
