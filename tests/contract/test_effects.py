"""What every registered effect promises, around a small model without hysteresis."""

import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import INDEX, Record

NAMES = registry.names("effects")
MODEL = np.array([[1.3], [0.4]])
LINEAR = np.array([[1.3], [0.0]])
QUANTITIES = {"input": "V", "output": "um", "time": "ms"}


def measured(samples: int = 241, uneven: bool = False) -> Record:
    """Two tones and a hold, a temperature that wanders."""
    rng = np.random.default_rng(5)
    time = np.linspace(0.5, 3.5, samples)
    if uneven:
        time = 0.5 + 3.0 * np.cumsum(rng.uniform(0.2, 1.8, samples)) / samples
    drive = np.where(time < 2.8, np.sin(7.0 * time) + 0.4 * np.sin(16.0 * time), 0.9)
    output = 1.3 * drive + 0.4 * drive**3 + 0.01 * rng.normal(size=samples)
    units = {**QUANTITIES, "temperature": "degC"}
    return Record(time, drive, output, units=units, columns={"temperature": 30.0 + 5.0 * np.sin(1.1 * time)})


def built(name: str) -> Effect:
    return registry.build("effects", name)


def around(name: str) -> System:
    return System(registry.build("models", "polynomial"), ((name, built(name)),))


def drawn(name: str, record: Record, swarm: int, seed: int = 0, model: np.ndarray = MODEL) -> np.ndarray:
    """A swarm all over the effect's box, around one model."""
    box = built(name).box([record])
    if not box:
        return np.repeat(model, swarm, axis=1)
    points = np.random.default_rng(seed).random((len(box), swarm))
    return np.vstack([np.repeat(model, swarm, axis=1), Space(box).from_unit(points)])


def switched_off(name: str, values: np.ndarray, columns: slice = slice(None)) -> np.ndarray:
    off = values.copy()
    for row, parameter in enumerate(built(name).parameters, start=2):
        if parameter.null is not None:
            off[row, columns] = parameter.null
    return off


def bare(record: Record, model: np.ndarray = MODEL) -> np.ndarray:
    return System(registry.build("models", "polynomial")).simulate(record.signal, model)


with_parameters = [name for name in NAMES if registry.load("effects", name).loaded.parameters]


@pytest.mark.parametrize("name", NAMES)
def test_it_is_listed_with_a_sentence(name):
    plugin = registry.load("effects", name)
    assert not plugin.fault
    assert plugin.summary.endswith(".")


@pytest.mark.parametrize("name", NAMES)
def test_its_rivals_are_effects_and_say_nothing_else(name):
    """A reason stands on one of two rivals, and is the end of a sentence."""
    for rival, reason in registry.effect(name).mistaken_for.items():
        assert not registry.effect(rival).nuisance
        assert name not in registry.effect(rival).mistaken_for
        assert not reason.endswith(".")


@pytest.mark.parametrize("name", NAMES)
def test_one_parameter_at_least_switches_it(name):
    parameters = built(name).parameters
    assert not parameters or any(parameter.null is not None for parameter in parameters)


@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("name", NAMES)
def test_null_reproduces_the_model_bit_for_bit(name, uneven):
    record = measured(uneven=uneven)
    values = drawn(name, record, 8)
    expected = np.broadcast_to(bare(record), (record.time.size, 8))
    assert np.array_equal(around(name).simulate(record.signal, switched_off(name, values)), expected)
    mixed = around(name).simulate(record.signal, switched_off(name, values, slice(0, None, 2)))
    assert np.array_equal(mixed[:, ::2], expected[:, ::2])


@pytest.mark.parametrize(
    "model", [name for name in registry.names("models") if not registry.load("models", name).fault]
)
@pytest.mark.parametrize("name", NAMES)
def test_null_reproduces_every_model_bit_for_bit(name, model):
    record = measured(121)
    alone = System(registry.build("models", model))
    rng = np.random.default_rng(3)
    space = Space(alone.box([record]))
    values = space.from_unit(rng.random((space.dimension, 5)))
    around_it = replace(alone, effects=((name, built(name)),))
    effect_values = drawn(name, record, 5)[2:]
    for row, parameter in enumerate(built(name).parameters):
        effect_values[row] = effect_values[row] if parameter.null is None else parameter.null
    simulated = around_it.simulate(record.signal, np.vstack([values, effect_values]))
    assert np.array_equal(simulated, alone.simulate(record.signal, values))


@pytest.mark.parametrize("name", with_parameters)
def test_off_null_it_changes_something(name):
    """With its switches at the far edge of the box, by a hundredth of the output's range at least."""
    record = measured()
    values = drawn(name, record, 8)
    for row, parameter in enumerate(built(name).box([record]), start=2):
        if parameter.null is not None:
            values[row] = parameter.upper
    change = np.max(np.abs(around(name).simulate(record.signal, values) - bare(record)), axis=0)
    assert np.all(change > 0.01 * np.ptp(record.output))


@pytest.mark.parametrize("name", with_parameters)
def test_it_approaches_its_null_without_a_jump(name):
    record = measured()
    values = np.repeat(drawn(name, record, 1), 30, axis=1)
    for row, parameter in enumerate(built(name).parameters, start=2):
        if parameter.null is not None:
            values[row] = parameter.null + (values[row] - parameter.null) * 0.5 ** np.arange(30)
    change = np.max(np.abs(around(name).simulate(record.signal, values) - bare(record)), axis=0)
    assert change[-1] < 1e-3 * change[0]


@pytest.mark.parametrize("name", NAMES)
def test_it_leaves_its_arguments_alone(name):
    record = measured()
    values = drawn(name, record, 4)
    for array in (record.time, record.input, record.output, values, *record.columns.values()):
        array.setflags(write=False)
    around(name).respond(record, values)


@pytest.mark.parametrize("name", NAMES)
def test_the_columns_of_a_swarm_do_not_know_of_each_other(name):
    record = measured(uneven=True)
    values = drawn(name, record, 9)
    together = around(name).respond(record, values)
    assert together.shape == (record.time.size, 9)
    for j in range(9):
        alone = around(name).respond(record, values[:, j : j + 1])
        np.testing.assert_allclose(together[:, j], alone[:, 0], rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_it_takes_an_input_of_each_column_s_own(name):
    record = measured()
    values = drawn(name, record, 5)
    shared = around(name).simulate(record.signal, values)
    own = around(name).simulate(record.signal.with_input(np.repeat(record.input[:, None], 5, axis=1)), values)
    np.testing.assert_allclose(own, shared, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_it_is_finite_all_over_its_box(name):
    record = measured(uneven=True)
    box = built(name).box([record])
    corners = list(product(*((parameter.lower, parameter.upper) for parameter in box)))
    values = drawn(name, record, 64 + len(corners))
    values[2:, : len(corners)] = np.transpose(corners)
    assert np.all(np.isfinite(around(name).respond(record, values)))


@pytest.mark.parametrize("name", NAMES)
def test_its_box_is_sound(name):
    records = [measured(), measured(uneven=True)]
    effect = built(name)
    box = effect.box(records)
    assert [parameter.name for parameter in box] == [parameter.name for parameter in effect.parameters]
    assert [fault for parameter in (*box, *effect.parameters) for fault in parameter.faults()] == []
    for parameter in box:
        if parameter.null is not None:
            margin = 0.01 * (parameter.upper - parameter.lower) if parameter.scaling == "log" else 0.0
            assert parameter.lower - margin <= parameter.null <= parameter.upper


@pytest.mark.parametrize("name", NAMES)
def test_it_applies_to_a_good_record(name):
    assert built(name).inapplicable([measured()]) == ""


@pytest.mark.parametrize("name", NAMES)
def test_its_answer_does_not_depend_on_the_sampling_of_the_same_signal(name):
    """Exact for a piecewise-linear signal: a line more finely sampled is the same line."""
    record = measured()
    fine = np.linspace(record.time[0], record.time[-1], 4 * (record.time.size - 1) + 1)
    fine[::4] = record.time
    dense = replace(
        record,
        time=fine,
        input=np.interp(fine, record.time, record.input),
        output=np.interp(fine, record.time, record.output),
        columns={key: np.interp(fine, record.time, column) for key, column in record.columns.items()},
    )
    values = drawn(name, record, 12, model=LINEAR)
    coarse = around(name).simulate(record.signal, values)
    np.testing.assert_allclose(around(name).simulate(dense.signal, values)[::4], coarse, atol=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_a_time_that_is_only_an_index_switches_effects_of_rate_off(name):
    record = replace(measured(), units={**QUANTITIES, "time": INDEX})
    values = drawn(name, record, 4)
    if built(name).inapplicable([record]):
        simulated = around(name).simulate(record.signal, values)
        assert np.array_equal(simulated, np.broadcast_to(bare(record), simulated.shape))


def exponents(unit: str) -> dict[str, int]:
    """Powers of input, output and time in a unit."""
    told = unit.format(input="I", output="O", time="T")
    assert "{" not in told
    numerator, _, denominator = told.partition("/")
    powers = dict.fromkeys(QUANTITIES, 0)
    for part, sign in ((numerator, 1), (denominator, -1)):
        for symbol, quantity in (("I", "input"), ("O", "output"), ("T", "time"), ("s", "time")):
            powers[quantity] += sign * sum(int(power or 1) for power in re.findall(rf"\b{symbol}\b(?:\^(\d))?", part))
    return powers


@pytest.mark.parametrize("name", NAMES)
def test_units_are_what_they_say(name):
    """Data in other units give the box, and the response, in other units: nothing else changes."""
    record = measured()
    scale = {"input": 40.0, "output": 1e-3, "time": 250.0}
    other = replace(
        record,
        time=scale["time"] * record.time,
        input=scale["input"] * record.input,
        output=scale["output"] * record.output,
    )
    effect = built(name)
    factors = [np.prod([scale[key] ** power for key, power in exponents(p.unit).items()]) for p in effect.parameters]
    for parameter, rescaled, factor in zip(effect.box([record]), effect.box([other]), factors, strict=True):
        np.testing.assert_allclose(
            [rescaled.lower, rescaled.upper], [factor * parameter.lower, factor * parameter.upper], rtol=1e-9
        )
    values = drawn(name, record, 6)
    model_factors = [scale["output"] / scale["input"], scale["output"] / scale["input"] ** 3]
    simulated = around(name).simulate(record.signal, values)
    again = around(name).simulate(other.signal, values * np.array([*model_factors, *factors])[:, None])
    np.testing.assert_allclose(again, scale["output"] * simulated, rtol=1e-7, atol=1e-10)
