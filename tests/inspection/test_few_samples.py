"""Records that are too short, or that hardly move, are told before another command refuses them."""

import numpy as np

from hysteresis_bench.diagnosis.question import FEWEST_SAMPLES
from hysteresis_bench.inspection.few_samples import NEEDED, few_told
from hysteresis_bench.inspection.oddities import oddities
from hysteresis_bench.signals import Record


def record(samples, name="loop", size=1.0):
    time = np.arange(samples) / 10.0
    return Record(time, size * np.sin(time), np.cos(time), name)


def test_the_limit_is_that_of_a_diagnosis():
    assert NEEDED == FEWEST_SAMPLES


def test_few_samples_are_told():
    for samples in (2, 3, NEEDED - 1):
        assert any(one.startswith(f"loop: {samples} samples are too few") for one in oddities([record(samples)]))
    assert few_told([record(NEEDED)]) == ""
    assert few_told([record(2, "a"), record(NEEDED, "b"), record(9, "c")]).startswith("a and 1 more: 2 to 9 samples")


def test_an_input_that_hardly_moves_is_told_with_a_remedy():
    (said,) = oddities([record(100, size=3e-150)])
    assert said.startswith("loop, column input: it moves by 6e-150 in all, too little to work with")
    assert "smaller unit" in said
