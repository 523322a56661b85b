"""A drift of its own in every record is told from a beginning in mid-loop."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.reading.drifts import drift_of_each
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.signals import joined


@pytest.mark.parametrize(("imperfect", "drift", "told"), [("", 1.0, "record-drift"), ("in-mid-loop", 0.0, "")])
def test_a_line_of_each_record_comes_down_to_the_noise_where_it_drifts(imperfect, drift, told):
    rig = HiddenEffects(effects=(), draw=1, imperfect=imperfect)
    seen = joined(*(rig.measure(name, np.random.default_rng(k)) for k, name in enumerate(("slow", "fast", "nested"))))

    def drifting(record, rate):
        return replace(record, output=record.output + drift * rate * (record.time - record.time[0]))

    records = tuple(drifting(record, rate) for record, rate in zip(seen.records, (0.5, -0.4, 0.3), strict=True))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), records))
    base = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    floor = seen.hidden["noise"]
    assert base.rmse > 1.2 * floor
    assert (
        drift_of_each(SimpleNamespace(thin=fitter, base=base, best=base, selection=SimpleNamespace(floor=floor)))
        == told
    )


def test_a_drift_that_was_asked_for_is_not_taken_in_again():
    seen = HiddenEffects(effects=(), draw=1).measure("slow", np.random.default_rng(0))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), seen.records, own=("record-drift",)))
    base = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    floor = SimpleNamespace(floor=10.0 * base.rmse)
    assert drift_of_each(SimpleNamespace(thin=fitter, base=base, best=base, selection=floor)) == ""
