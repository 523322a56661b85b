"""Effects that the user puts around a model are fitted no worse than if they had been found one by one."""

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.signals import Record

OFFSET = registry.RECORD_OFFSET
AROUND = ("creep", "input-lag")


def record() -> Record:
    """Of a Prandtl-Ishlinskii law behind a lag and creep: a ferroelectric law can follow it, but not to the noise."""
    time = np.linspace(0.0, 8.0, 801)
    drive = 3.0 * np.sin(2 * np.pi * time) * (1.0 - time / 10.0)
    model = registry.build("models", "prandtl-ishlinskii")
    system = System(model, registry.build_effects(model, AROUND))
    box = system.box((Record(time, drive, drive),))
    middle = [[0.6 * p.lower + 0.4 * p.upper if p.scaling == "linear" else np.sqrt(p.lower * p.upper)] for p in box]
    clean = system.simulate(Record(time, drive, None).signal, np.array(middle))[:, 0]
    noise = 0.005 * np.std(clean) * np.random.default_rng(1).standard_normal(time.size)
    return Record(time, drive, clean + noise)


def test_effects_around_a_model_are_fitted_as_well_as_one_after_the_other():
    model, records = registry.build("models", "ferroelectric"), (record(),)
    alone = Fitter(Stack(model, records))
    found = alone.bare(frozenset({OFFSET}))
    for name in ("input-lag", "creep"):
        found = alone.refitted(alone.extended(found, name))
    given = Fitter(Stack(model, records, AROUND)).bare(frozenset({OFFSET}))
    assert given.names == {OFFSET}, "what the user gave is no claim"
    assert given.rmse < 1.001 * found.rmse


def test_an_offset_that_the_user_gave_too_is_there_once():
    model, records = registry.build("models", "bouc-wen"), (record(),)
    given = Fitter(Stack(model, records, (OFFSET, "input-lag"))).bare(frozenset({OFFSET}))
    plain = Fitter(Stack(model, records, ("input-lag",))).bare(frozenset({OFFSET}))
    assert given.rmse == plain.rmse
