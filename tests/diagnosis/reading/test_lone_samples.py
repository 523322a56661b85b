"""Spikes that only a fitted system shows: at an end, beside each other, where the output moves fast."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.data.spikes import spikes
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.reading.lone_samples import without_lone_samples
from hysteresis_bench.diagnosis.search.search import search

RECORDS = ("slow", "fast", "nested", "mixed")
QUESTION = Question("bouc-wen", options=DiagnosisOptions(jobs=1))
SPIKES = {"fast": {799: 2.0, 400: -1.6, 401: -1.9}, "mixed": {798: 1.8}}


def data(effects, spiked=True):
    settings = {"model": "bouc-wen", "effects": effects, "noise": 0.01}
    seen = measure("hidden-effects", *RECORDS, settings=settings, seed=3)
    return seen.map(_off if spiked else lambda record: record).split(RECORDS[-1:])


def _off(record):
    output = record.output.copy()
    for sample, off in SPIKES.get(record.name, {}).items():
        output[sample] += off
    return replace(record, output=output)


def found_by(dataset):
    prepared = prepare(dataset, QUESTION)
    return search(prepared, gather(prepared.views), QUESTION), prepared.dataset.records


def test_spikes_that_hide_from_their_neighbours_are_found_in_what_is_left():
    dataset = data(())
    assert not any(spikes(record).size for record in dataset.records)
    mended = without_lone_samples(*found_by(dataset))
    for record, before, clean in zip(mended.records, dataset.records, data((), spiked=False).records, strict=True):
        touched = np.flatnonzero(record.output != before.output).tolist()
        assert touched == sorted(SPIKES.get(record.name, {}))
        assert record.output == pytest.approx(clean.output, abs=0.3)
    assert "fast (at time" in mended.note
    assert "mixed (at time" in mended.note


@pytest.mark.long
def test_an_effect_beside_them_is_named_and_they_are_told():
    likely = ("asymmetry", "bias", "fatigue", "saturation", "stop-above", "stop-below")
    found = diagnose(data(("stop-above",)), replace(QUESTION, among=likely))
    assert found.effects == ("stop-above",)
    assert found.verdict == "effect-found"
    assert any("Lone samples" in told for told in found.warnings)


def test_nothing_is_touched_without_them_or_where_the_law_does_not_follow():
    assert without_lone_samples(*found_by(data((), spiked=False))) is None
    found, records = found_by(data(()))
    found.selection.floor /= 10.0
    assert without_lone_samples(found, records) is None
