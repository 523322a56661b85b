"""Records whose outputs have scales of their own."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.reading.scales import scaled, scales_of_each, scales_told
from hysteresis_bench.diagnosis.search.search import search

RECORDS = ("slow", "fast", "nested", "mixed")
AMONG = ("bias", "saturation", "inertia")
QUESTION = Question("bouc-wen", options=DiagnosisOptions(jobs=1), among=AMONG)


def data(scales, effects=()):
    settings = {"model": "bouc-wen", "effects": effects, "noise": 0.005}
    seen = measure("hidden-effects", *RECORDS, settings=settings, seed=4)
    return seen.map(lambda one: replace(one, output=scales.get(one.name, 1.0) * one.output)).split(RECORDS[-1:])


def scales_in(dataset):
    prepared = prepare(dataset, QUESTION)
    return scales_of_each(search(prepared, gather(prepared.views), QUESTION), prepared.dataset.held_out)


def test_the_scale_of_a_record_is_found_and_taken_out():
    found = diagnose(data({"fast": 1.15, "mixed": 0.97}), QUESTION)
    assert found.verdict == "no-effect-needed"
    assert not found.effects
    assert found.after.held_out.rmse < 1.1 * found.floor
    (told,) = (words for words in found.warnings if "scales of their own" in words)
    assert "fast 1.15" in told
    assert "mixed 0.97 times" in told


@pytest.mark.parametrize("effects", [(), ("saturation",), ("fatigue",)])
def test_none_is_found_where_there_is_none(effects):
    """`fatigue` is not asked for, and makes records look as if they had scales."""
    assert scales_in(data({}, effects)) == {}


def test_records_are_divided_by_what_is_told():
    records = data({}).records
    again = scaled(records, {"fast": 2.0, "slow": 1.001})
    assert [float(np.ptp(a.output) / np.ptp(b.output)) for a, b in zip(again, records, strict=True)] == pytest.approx(
        [1.0 / 1.001, 0.5, 1.0, 1.0]
    )
    words = scales_told(records, {"fast": 2.0, "slow": 1.001})
    assert "fast 2 times" in words
    assert "slow" not in words
