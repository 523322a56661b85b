"""The offset of every record is exchanged for one of all records, however far the output lies from zero."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import measure, registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.search.offset import with_simplest_offset


@pytest.mark.parametrize(
    ("law", "names", "spans"),
    [("bouc-wen", ("asymmetry", "saturation"), 10.0), ("jiles-atherton", ("creep", "saturation"), -3.0)],
)
def test_an_output_far_from_zero_is_followed_as_well(law, names, spans):
    """Without an offset the other values are bent so far away that no search found back from there."""
    made = measure("hidden-effects", "mixed", settings={"model": law, "effects": names, "draw": 7}, seed=1)
    (record,), noise = made.records, made.hidden["noise"]
    far = replace(record, output=record.output + spans * np.ptp(record.output))
    fitter = Fitter(Stack(registry.build("models", law), (far,)))
    system = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    for name in names:
        system = fitter.refitted(fitter.extended(system, name))
    selection = SimpleNamespace(
        fitter=fitter, candidates=names, needed=lambda less, more, count: less.rmse > 1.1 * more.rmse
    )
    simplest = with_simplest_offset(selection, system)
    assert simplest.names == {*names, registry.COMMON_OFFSET}
    assert simplest.rmse < 1.1 * noise
