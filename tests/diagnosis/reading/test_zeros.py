"""Records whose zero was set anew on the way."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.reading.zeros import AT, BY, levelled, zeros_of_each, zeros_told
from hysteresis_bench.diagnosis.search.search import search

RECORDS = ("slow", "fast", "nested", "mixed")
QUESTION = Question("bouc-wen", options=DiagnosisOptions(jobs=1), among=("bias", "drift", "saturation", "inertia"))
STEPS = {"slow": (2.1, 0.5), "fast": (1.3, -0.6), "mixed": (2.6, 0.4)}


def data(steps, effects=()):
    settings = {"model": "bouc-wen", "effects": effects, "noise": 0.005}
    seen = measure("hidden-effects", *RECORDS, settings=settings, seed=5)
    return seen.map(lambda record: _stepped(record, steps)).split(RECORDS[-1:])


def _stepped(record, steps):
    time, height = steps.get(record.name, (0.0, 0.0))
    return replace(record, output=record.output + height * (record.time >= time))


def zeros_in(dataset):
    prepared = prepare(dataset, QUESTION)
    return zeros_of_each(search(prepared, gather(prepared.views), QUESTION), prepared.dataset.held_out)


def test_zeros_set_anew_are_found_and_moved_back():
    found = diagnose(data(STEPS), QUESTION)
    assert found.verdict == "no-effect-needed"
    assert not found.effects
    assert found.after.held_out.rmse < 1.1 * found.floor
    assert sum("set anew within records" in words for words in found.warnings) == 1


def test_time_and_height_are_those_that_were_put_in():
    found = zeros_in(data(STEPS))
    assert {key for key in found if key.endswith(AT)} == {name + AT for name in STEPS}
    for name, (time, height) in STEPS.items():
        assert found[name + AT] == pytest.approx(time, abs=0.02)
        assert found[name + BY] == pytest.approx(height, rel=0.1)


@pytest.mark.parametrize("effects", [(), ("drift",), ("fatigue",)])
def test_none_is_found_where_there_is_none(effects):
    """`fatigue` is not asked for."""
    assert zeros_in(data({}, effects)) == {}


def test_records_are_moved_by_what_is_told():
    records = data({}).records
    steps = {"fast" + AT: 1.0, "fast" + BY: 0.25}
    for before, after in zip(records, levelled(records, steps), strict=True):
        moved = 0.25 * (before.time >= 1.0) if before.name == "fast" else 0.0
        np.testing.assert_allclose(before.output - after.output, moved, atol=1e-12)
    assert "fast by 0.25 before time 1." in zeros_told(records, steps)
