"""What is odd about records is told, each by its sentence; a good pair of records is not scolded."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.inspection.oddities import oddities
from hysteresis_bench.signals import Record

TIME = np.arange(3000) / 1000.0


def record(rate=2.0, name="loop", envelope=None, time=TIME):
    size = 0.3 + time / time[-1] if envelope is None else envelope
    phase = 2 * np.pi * rate * time
    return Record(time, 5 * size * np.sin(phase), 2 * size * np.sin(phase - 0.2) + 0.2 * np.sin(0.2), name)


def even(**change):
    made = record(envelope=np.ones(TIME.size))
    return replace(made, **{name: change_of(made) for name, change_of in change.items()})


def noise(size):
    return size * np.random.default_rng(0).standard_normal(TIME.size)


def rested(values):
    return np.concatenate([np.full(400, values[0]), values[:-400]])


CASES = {
    "a false reversal": (even(input=lambda r: r.input + noise(0.05)), "reversals. A model of hysteresis takes each"),
    "noise": (even(input=lambda r: r.input + noise(0.05)), "noise of 0.5% of its range"),
    "a plateau": (even(input=lambda r: np.where(np.abs(r.input) > 4.5, 4.5, r.input)), "the input rests for"),
    "a late start": (even(input=lambda r: rested(r.input), output=lambda r: rested(r.output)), "--skip 0.4 leaves"),
    "an open loop": (even(output=lambda r: r.output + 1.5 * TIME), "--settle repeats"),
    "drift": (even(output=lambda r: r.output + 0.4 * TIME), "drifts by"),
    "clipping": (even(output=lambda r: np.minimum(r.output, 1.5)), "stays at its largest value, 1.5, for"),
    "aliasing": (record(1.0, time=np.arange(60) / 12.0), "only 12 samples a cycle"),
    "jitter": (even(time=lambda r: TIME + 2e-4 * np.random.default_rng(1).random(TIME.size)), "--rate HZ"),
    "an output that never moves": (even(output=lambda r: 3.0 + 0.0 * r.output), "the output is 3 throughout"),
    "exchanged columns": (even(input=lambda r: r.output, output=lambda r: r.input), "may be exchanged"),
    "one amplitude": (even(), "one amplitude only (5)"),
    "one frequency": (record(), "one frequency only (about 2"),
}


@pytest.mark.parametrize("name", CASES)
def test_it_is_told(name):
    odd, words = CASES[name]
    said = oddities([odd])
    assert any(words in one for one in said), said


def test_good_records_are_not_scolded():
    good = [record(2.0, "slow"), record(6.0, "fast")]
    assert oddities(good) == ()
    assert oddities([replace(one, output=-one.output) for one in good]) == ()


def test_noise_is_not_said_to_run_ahead_and_a_force_over_its_way_is():
    for seed in range(20):
        output = np.random.default_rng(seed).standard_normal(200)
        alone = replace(record(time=TIME[:200] * 5.0), output=output)
        assert "runs ahead" not in " ".join(oddities([alone]))
    ahead = 2.0 * np.sin(2 * np.pi * 2.0 * TIME + 0.2) + noise(0.2)
    assert "runs ahead" in " ".join(oddities([even(output=lambda _: ahead)]))


def test_an_input_that_never_turns_is_told_but_not_of_reversal_curves():
    one_way = Record(TIME, TIME, TIME**2)
    assert "the input never turns" in " ".join(oddities([one_way]))
    curves = [Record(TIME, start + (3.0 - start) * TIME / 3.0, TIME**2, str(start)) for start in (0.0, 1.0, 2.0)]
    assert "never turns" not in " ".join(oddities(curves))


def test_of_a_constant_input_nothing_else_is_said():
    (said,) = oddities([Record(TIME, np.ones(TIME.size), np.sin(TIME))])
    assert "the input is 1 throughout" in said


def test_a_record_of_many_frequencies_is_not_said_to_have_one():
    chirp = np.sin(2 * np.pi * (0.5 * TIME + 0.8 * TIME**2))
    said = " ".join(oddities([replace(record(), input=5.0 * chirp, output=chirp)]))
    assert "one frequency only" not in said
    phases = np.random.default_rng(3).uniform(0.0, 2 * np.pi, (20, 6, 1))
    tones = np.linspace(1.0, 10.0, 6)[:, None]
    for phase in phases:
        multisine = np.sin(2 * np.pi * tones * TIME + phase).sum(axis=0)
        assert "one frequency only" not in " ".join(oddities([Record(TIME, multisine, multisine)]))
    noisy = replace(record(), input=record().input + noise(0.002))
    assert "one frequency only (about 2" in " ".join(oddities([noisy]))


def test_a_frequency_is_told_in_the_unit_of_time():
    units = {"input": "V", "output": "um"}
    one, other = (replace(record(), units={**units, "time": unit}) for unit in ("s", "min"))
    assert "(about 2 Hz)" in " ".join(oddities([one]))
    assert "(about 2 cycles a min)" in " ".join(oddities([other]))


def test_a_record_without_output_or_movement_is_looked_at():
    still = Record(TIME, np.zeros(TIME.size), None)
    assert all("still" in one or "rests" in one or "frequency" not in one for one in oddities([still]))
