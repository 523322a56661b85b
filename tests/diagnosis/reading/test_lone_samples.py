"""Spikes that only a fitted system shows: at an end, beside each other, where the output moves fast."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import measure
from hysteresis_bench.data.faults.spikes import spikes
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.reading.lone_samples import lone_part, without_lone_samples
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


def outputs(records):
    return [record.output for record in records]


def found_by(dataset):
    prepared = prepare(dataset, QUESTION)
    return search(prepared, gather(prepared.views), QUESTION), prepared.dataset


def test_spikes_that_hide_from_their_neighbours_are_found_in_what_is_left():
    dataset = data(())
    assert not any(spikes(record).size for record in dataset.records)
    mended = without_lone_samples(*found_by(dataset))
    for record, before, clean in zip(mended.records, dataset.records, data((), spiked=False).records, strict=True):
        touched = np.flatnonzero(record.output != before.output).tolist()
        assert touched == (sorted(SPIKES[record.name]) if record.name == "fast" else [])
        if record.name != "mixed":
            assert record.output == pytest.approx(clean.output, abs=0.3)
    assert mended.refit
    assert "taken for spikes: fast (at time" in mended.note


def test_what_is_held_out_stays_as_measured_and_is_told():
    """The error on it would be one on what the fitted system made of it."""
    dataset = data((), spiked=False).map(lambda record: _off(record) if record.name == "mixed" else record)
    assert not any(spikes(record).size for record in dataset.records)
    mended = without_lone_samples(*found_by(dataset))
    assert all(np.array_equal(*pair) for pair in zip(outputs(mended.records), outputs(dataset.records), strict=True))
    assert not mended.refit
    assert "count in the error on what was held out: mixed (at time" in mended.note


def test_lone_samples_that_are_held_out_are_no_fault_of_the_system():
    """Five of 800 samples: what is missed with them is no noise, and without them it is."""
    clean = data((), spiked=False)
    at, off = np.array([100, 250, 400, 550, 700]), np.array([2.0, -1.5, 1.8, -2.2, 1.6])
    output = clean.records[-1].output.copy()
    output[at] += off
    dirty = replace(clean.records[-1], output=output)
    found, dataset = found_by(replace(clean, records=(*clean.records[:-1], dirty)))
    assert not np.array_equal(dataset.held_out[0].output, clean.held_out[0].output)
    system, values = found.thin.fitted(found.best)
    (held_out,) = dataset.held_out
    left = held_out.measured - system.respond(held_out, values[:, None])[held_out.scored, 0]
    added = np.sqrt(np.sum(left[at] ** 2) / left.size)
    floor = found.selection.floor
    assert lone_part(system, values, [held_out], floor) == pytest.approx(added)
    assert np.mean(left**2) > 1.3**2 * floor**2
    assert np.mean(left**2) - added**2 == pytest.approx(floor**2, rel=0.2)
    assert lone_part(system, values, [held_out], 0.1 * floor) == 0.0
    assert lone_part(system, values, [], floor) == 0.0


@pytest.mark.long
def test_an_effect_beside_them_is_named_and_they_are_told():
    likely = ("asymmetry", "bias", "fatigue", "saturation", "stop-above", "stop-below")
    found = diagnose(data(("stop-above",)), replace(QUESTION, among=likely))
    assert found.effects == ("stop-above",)
    assert found.verdict == "effect-found"
    assert any("Lone samples" in told for told in found.warnings)


def test_nothing_is_touched_without_them_or_where_the_law_does_not_follow():
    assert without_lone_samples(*found_by(data((), spiked=False))) is None
    found, dataset = found_by(data(()))
    found.selection.floor /= 10.0
    assert without_lone_samples(found, dataset) is None
