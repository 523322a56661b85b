"""What physics promises of the effects: stacking, rest, time-stretch, time invariance, scaling."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record

NAMES = registry.names("effects")
RATE_INDEPENDENT = ("asymmetry", "backlash", "bias", "fatigue", "input-dead-zone", "output-dead-zone", "saturation")
TIME_INVARIANT = (
    *("creep", "droop", "input-lag", "output-lag", "resonance", "transport-delay"),
    *("second-order-lag", "second-order-input-lag", "slew-rate-limit"),
)
MODEL = np.array([[1.3], [0.4]])

seeds = st.integers(0, 2**32 - 1)
orders = st.permutations(NAMES)


def wandering(seed: int, samples: int = 90, rest: int = 1) -> Record:
    """A random path on an uneven grid; the first `rest` samples stand still."""
    rng = np.random.default_rng(seed)
    time = np.cumsum(rng.uniform(0.002, 0.02, samples))
    steps = rng.normal(size=samples)
    steps[:rest] = 0.0
    drive = 0.5 + 0.2 * np.cumsum(np.convolve(steps, np.hanning(7)[1:-1], "same") * (np.arange(samples) >= rest))
    temperature = 25.0 + 0.1 * np.cumsum(rng.normal(size=samples))
    return Record(time, drive, drive + 0.2 * drive**3, columns={"temperature": temperature})


def stack(names, record: Record, rng: np.random.Generator, swarm: int = 3, off: bool = False):
    """The system with these effects, innermost first, and a swarm from their boxes, or at their nulls."""
    system = System(
        registry.build("models", "polynomial"), tuple((name, registry.build("effects", name)) for name in names)
    )
    box = system.box([record])
    values = Space(box).from_unit(rng.random((len(box), swarm)))
    values[:2] = MODEL
    if off:
        for row, parameter in enumerate(box):
            values[row] = values[row] if parameter.null is None else parameter.null
    return system, values


@settings(max_examples=20, deadline=None)
@given(orders, seeds)
def test_all_effects_stack_in_any_order(order, seed):
    record = wandering(seed)
    rng = np.random.default_rng(seed)
    system, values = stack(order, record, rng)
    simulated = system.respond(record, values)
    assert simulated.shape == (record.time.size, 3)
    assert np.all(np.isfinite(simulated))


@settings(max_examples=20, deadline=None)
@given(orders, seeds)
def test_all_effects_switched_off_are_the_model_bit_for_bit(order, seed):
    record = wandering(seed)
    system, values = stack(order, record, np.random.default_rng(seed), off=True)
    bare = System(registry.build("models", "polynomial")).simulate(record.signal, MODEL)
    assert np.array_equal(system.simulate(record.signal, values), np.repeat(bare, 3, axis=1))


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(RATE_INDEPENDENT), seeds, st.floats(1e-3, 1e3))
def test_rate_independent_effects_do_not_feel_a_stretched_time(name, seed, stretch):
    record = wandering(seed)
    system, values = stack([name], record, np.random.default_rng(seed))
    slow = Record(stretch * record.time, record.input, record.output, columns=record.columns)
    assert np.array_equal(system.simulate(slow.signal, values), system.simulate(record.signal, values))


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(TIME_INVARIANT), seeds)
def test_lags_rest_in_static_equilibrium_until_the_input_moves(name, seed):
    record = wandering(seed, rest=30)
    system, values = stack([name], record, np.random.default_rng(seed))
    simulated = system.simulate(record.signal, values)
    still = np.flatnonzero(np.diff(record.input))[0]
    np.testing.assert_allclose(simulated[:still], np.broadcast_to(simulated[0], simulated[:still].shape), rtol=1e-13)
    np.testing.assert_allclose(simulated[0], 1.3 * record.input[0] + 0.4 * record.input[0] ** 3, rtol=1e-13)


@settings(max_examples=20, deadline=None)
@given(st.lists(st.sampled_from(TIME_INVARIANT), min_size=1, max_size=3, unique=True), seeds)
def test_time_invariant_effects_do_not_feel_when_a_record_begins(names, seed):
    """Neither a shifted clock nor a rest before the motion changes the response to the motion."""
    record = wandering(seed)
    system, values = stack(names, record, np.random.default_rng(seed))
    expected = system.simulate(record.signal, values)
    lead = record.time[0] + np.linspace(-3.0, -0.1, 5)
    rested = Record(
        np.concatenate([lead, record.time]) + 17.0, np.concatenate([np.full(5, record.input[0]), record.input]), None
    )
    np.testing.assert_allclose(system.simulate(rested.signal, values)[5:], expected, rtol=0, atol=1e-8)


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(["input-lag", "output-lag", "transport-delay", "backlash"]), seeds)
def test_what_lags_or_holds_never_leaves_the_range(name, seed):
    record = wandering(seed)
    system, values = stack([name], record, np.random.default_rng(seed))
    static = 1.3 * record.input + 0.4 * record.input**3
    simulated = system.simulate(record.signal, values)
    slack = 1e-12 * np.ptp(static)
    assert np.all((simulated >= static.min() - slack) & (simulated <= static.max() + slack))


@settings(max_examples=20, deadline=None)
@given(seeds, st.floats(0.01, 0.5), st.floats(0.01, 0.5))
def test_lags_in_series_commute(seed, first, second):
    record = wandering(seed)
    system, _ = stack(["output-lag"], record, np.random.default_rng(seed))
    twice = System(system.model, (*system.effects, ("again", registry.build("effects", "output-lag"))))
    values = np.array([[1.3], [0.0], [first], [second]])
    fine = np.linspace(record.time[0], record.time[-1], 4000)
    signal = Record(fine, np.interp(fine, record.time, record.input), None).signal
    one, other = twice.simulate(signal, values), twice.simulate(signal, values[[0, 1, 3, 2]])
    np.testing.assert_allclose(one, other, atol=1e-4 * np.ptp(record.input))


@pytest.mark.parametrize("name", TIME_INVARIANT)
def test_what_comes_first_does_not_know_of_what_follows(name):
    record = wandering(7)
    system, values = stack([name], record, np.random.default_rng(7))
    whole = system.simulate(record.signal, values)
    part = system.simulate(record.take(slice(0, 40)).signal, values)
    assert np.array_equal(part, whole[:40])
