"""The offset of every record is exchanged for one of all records, however far the output lies from zero."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import measure, registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.search.offset import with_simplest_offset
from tests.diagnosis.search.handmade import fit, leaving, selection_of


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
        fitter=fitter, candidates=names, floor=noise, needed=lambda less, more, count: less.rmse > 1.1 * more.rmse
    )
    simplest = with_simplest_offset(selection, system)
    assert simplest.names == {*names, registry.COMMON_OFFSET}
    assert simplest.rmse < 1.1 * noise


@pytest.mark.parametrize(
    ("left", "share", "records", "helps", "kept"),
    [
        (9.0, 0.2, 1, True, False),  # far from the noise a constant takes its part of what the law does wrong
        (9.0, 0.4, 2, False, False),
        (9.0, 0.4, 2, True, True),
        (9.0, 0.6, 1, False, True),
        (0.01, 0.2, 1, False, True),  # near the noise it is an offset
    ],
)
def test_far_from_the_noise_a_constant_has_to_explain_or_to_predict(left, share, records, helps, kept):
    none, common, each = fit("", leaving(left / (1.0 - share))), fit("b", leaving(left)), fit("r", leaving(left))
    selection = selection_of()
    selection.fitter.stack.records = (None,) * records
    selection.fitter.reduced = lambda *_: none
    selection.fitter.extended = lambda *_: common
    selection.fitter.unseen = lambda one: np.array([1.0 if helps is (one is common) else 2.0])
    selection.needed = lambda less, more, count: less is none
    assert with_simplest_offset(selection, each) is (common if kept else none)
