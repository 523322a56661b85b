"""A hum that every record meets at another phase, which no sinusoid of one clock can be."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.free_forms import with_free_forms
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.signals import joined

FREQUENCY, SIZE, OVERTONE = 31.7, 0.4, 0.2


@pytest.fixture(scope="module", params=["own phases", "one clock"])
def asked(request):
    rig = HiddenEffects(effects=(), draw=1)
    seen = joined(*(rig.measure(name, np.random.default_rng(k)) for k, name in enumerate(("slow", "fast", "nested"))))
    phases = (0.3, 2.1, 4.4) if request.param == "own phases" else (0.3, 0.3, 0.3)

    def humming(record, phase):
        turns = 2.0 * np.pi * FREQUENCY * record.time + phase
        overtone = 0.0 if request.param == "one clock" else OVERTONE * np.cos(3.0 * turns + phase**2)
        return record.output + SIZE * np.cos(turns) + overtone

    records = tuple(
        replace(record, output=humming(record, phase)) for record, phase in zip(seen.records, phases, strict=True)
    )
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), records))
    with Workers(fitter, jobs=1) as workers:
        names = ("asymmetry", "creep", "periodic-disturbance")
        selection = Selection(fitter, workers, seen.hidden["noise"], names)
        named = selection.named(selection.run(fitter.bare(frozenset({registry.RECORD_OFFSET}))))
        yield request.param, selection, with_free_forms(selection, named), records


def test_the_hum_is_told_by_name_where_there_is_one_clock(asked):
    clock, selection, found, _ = asked
    assert selection.adopted(found) == (("periodic-disturbance",) if clock == "one clock" else ("record-wave",))
    assert found.rmse < 1.06 * selection.floor


@pytest.mark.parametrize("asked", ["own phases"], indirect=True)
def test_its_frequency_and_its_amplitude_are_the_true_ones(asked):
    _, selection, found, records = asked
    assert found.values["record-wave.frequency"] == pytest.approx(FREQUENCY, rel=1e-3)
    assert found.values["record-wave.amplitude2"] == pytest.approx(SIZE, rel=0.1)
    assert abs(found.values["record-wave.amplitude_of_3"]) == pytest.approx(OVERTONE, rel=0.1)
    system, values = selection.fitter.fitted(found)
    silent = replace(records[0], output=None)
    assert np.array_equal(  # without an output its phase is not known
        system.respond(silent, values[:, None]), silent.at_samples(system.simulate(silent.signal, values[:, None]))
    )
