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


def bent(law: str, shape, amplitudes: tuple[float, ...] = (1.0, 0.6)) -> tuple[Record, ...]:
    """Of a law with its example's parameters, whose output a curve bends; a swept sine of every amplitude."""
    model = registry.build("models", law)
    example, time, rng = model.example, np.linspace(0.0, 10.0, 600), np.random.default_rng(3)
    values = np.array([example.parameters[p.name] for p in model.parameters])[:, None]
    drives = [example.amplitude * a * np.sin(np.pi * time) * (0.5 + 0.05 * time) for a in amplitudes]
    outputs = [System(model).simulate(Record(time, u, None).signal, values)[:, 0] for u in drives]
    scale, middle = 0.5 * max(np.ptp(y) for y in outputs), outputs[0].mean()
    return tuple(
        Record(time, u, shape((y - middle) / scale) + 0.002 * rng.standard_normal(y.size), name=f"run {number}")
        for number, (u, y) in enumerate(zip(drives, outputs, strict=True))
    )


def test_a_curve_takes_over_what_the_law_alone_was_bent_to():
    """Around the best bare law a local fit ends at 0.0086."""
    fitter = Fitter(Stack(registry.build("models", "energy-based"), bent("energy-based", lambda y: np.exp(1.5 * y))))
    alone = fitter.bare(frozenset({OFFSET}))
    assert alone.rmse > 0.3
    assert fitter.extended(alone, "output-curve").rmse < 0.004


def test_an_excitation_that_goes_further_is_judged_by_its_blocks():
    """How a law extrapolates is no part of what it leaves unseen."""
    fitter = Fitter(Stack(registry.build("models", "dahl"), bent("energy-based", np.tanh, (1.0, 0.1))))
    alone = fitter.bare(frozenset({OFFSET}))
    unseen, apart, large = fitter.unseen(alone), fitter.apart(alone), fitter.excitations.number == 0
    np.testing.assert_allclose(unseen[~large], apart[~large], rtol=0.05, atol=0.05 * np.std(apart[~large]))
    assert np.std(unseen[large]) < 0.9 * np.std(apart[large])
