"""What every model promises: shapes, finite answers in its box, arguments untouched, what it declares of itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.inspection.memory import Plays
from hysteresis_bench.signals import INDEX, Record, Signal
from hysteresis_bench.testing.contract import expect
from hysteresis_bench.testing.contracts.properties import ALIKE, missed, turned
from hysteresis_bench.testing.examples import locked, measured
from hysteresis_bench.testing.parameters import expect_described, expect_sound
from hysteresis_bench.testing.plugin import PluginContract
from hysteresis_bench.testing.swarms import (
    corners,
    drawn,
    expect_finite,
    expect_shape,
    expect_strangers,
    expect_untouched,
)


class ModelContract(PluginContract):
    """Subclass it in a test file and name the plugin: `plugin = "my-model"`."""

    kind = "models"

    def use(self, built: Any) -> Sequence[Array]:
        record = measured()
        values = drawn(built.box([record]), 5)
        return [System(built).simulate(record.signal, values)]

    def test_its_parameters_are_described(self, plugin: str) -> None:
        """Its parameters have names, units, meanings and a sound box of their own."""
        parameters = self.build(plugin).parameters
        expect_described(parameters)
        expect_sound(parameters, parameters, "its own box")

    def test_its_box_follows_the_data(self, plugin: str) -> None:
        """The box that it gives to records is sound, also where the input or the output never moves."""
        built = self.build(plugin)
        record = measured()
        still = np.full(record.time.size, 0.7)
        for what, some in (
            ("its box of ordinary records", [record, measured(uneven=True)]),
            ("its box of a record whose input never moves", [locked(replace(record, input=still))]),
            ("its box of a record whose output never moves", [locked(replace(record, output=still))]),
        ):
            expect_sound(built.box(some), built.parameters, what)

    def test_it_answers_a_swarm(self, plugin: str) -> None:
        """It answers float64[samples, swarm], an array of its own, from one sample on, also without a clock."""
        system = System(self.build(plugin))
        record = measured()
        values = drawn(system.box([record]), 7)
        for part in (record, record.take(slice(0, 2)), record.take(slice(0, 1)), _untimed(record)):
            signal = part.signal
            simulated = system.simulate(signal, values)
            expect_shape(simulated, part.time.size, 7)
            expect_finite(simulated, values, _names(system), f"of {part.time.size} samples")
            expect(
                simulated.flags.writeable and not np.shares_memory(simulated, signal.input),
                "its answer is a view of the input; effects write into the answer, so make an array of its own.",
            )

    def test_its_density_is_one_of_thresholds(self, plugin: str) -> None:
        """Where it tells a density, thresholds rise from above 0, each with finite weights, one or one a place."""
        system = System(self.build(plugin))
        values = drawn(system.box([measured()]), 1)
        places = np.linspace(-1.0, 1.0, 5)
        if not isinstance(system.model, Plays):
            return
        radii, weights, _ = system.model.density(system.model_values(values), places)
        expect(
            radii.ndim == 1 and bool(np.all(np.diff(radii, prepend=0.0) > 0.0)),
            "the thresholds of its density must rise, the first of them from above 0.",
        )
        expect(
            weights.shape in {(radii.size, 1), (radii.size, places.size)} and bool(np.all(np.isfinite(weights))),
            "the weights of its density must be finite, of shape (thresholds, 1) or (thresholds, places).",
        )

    def test_it_is_finite_in_its_box(self, plugin: str) -> None:
        """It is finite all over the box that it gives to records, and at its corners; so in its own box."""
        system = System(self.build(plugin))
        for record in (measured(), measured(uneven=True)):
            for box, which in ((system.box([record]), "the box of the data"), (system.parameters, "its own box")):
                for values, where in ((drawn(box, 64), "in"), (corners(box), "at a corner of")):
                    simulated = system.simulate(record.signal, values)
                    expect_finite(simulated, values, _names(system), f"{where} {which}")

    def test_its_particles_are_strangers(self, plugin: str) -> None:
        """A particle's answer does not depend on the others; an input a particle is as good as a shared one."""
        system = System(self.build(plugin))
        record = measured(121, uneven=True)
        expect_strangers(system, record, drawn(system.box([record]), 9))

    def test_it_leaves_its_arguments_alone(self, plugin: str) -> None:
        """It changes neither the signal nor the parameters."""
        system = System(self.build(plugin))
        record = measured()
        expect_untouched(system, record, drawn(system.box([record]), 4))

    def test_it_is_affine_in_what_it_calls_linear(self, plugin: str) -> None:
        """The output is jointly affine in the parameters that it declares as `linear`."""
        system = System(self.build(plugin))
        named = [name for name in system.model.linear if name in _names(system)]
        record = measured(121)
        one = drawn(system.box([record]), 6)
        other, between = one.copy(), one.copy()
        rows = [_names(system).index(name) for name in named]
        other[rows] = drawn(system.box([record]), 6, seed=1)[rows]
        between[rows] = 0.3 * one[rows] + 0.7 * other[rows]
        low, high, middle = (system.simulate(record.signal, values) for values in (one, other, between))
        error = np.max(np.abs(0.3 * low + 0.7 * high - middle))
        scale = max(float(np.max(np.abs(low))), float(np.max(np.abs(high))))
        expect(error <= 1e-9 * scale, f"it is not affine in {', '.join(named)}: off by {error:.2g} of {scale:.2g}.")

    def test_its_effects_are_neutral_at_null(self, plugin: str) -> None:
        """What it offers changes nothing at its null value, to the last bit, and something elsewhere."""
        built = self.build(plugin)
        record = measured(121)
        alone = System(built)
        values = drawn(alone.box([record]), 6)
        bare = alone.simulate(record.signal, values)
        for name, effect in built.offers.items():
            expect_described(effect.parameters)
            expect(any(q.null is not None for q in effect.parameters), f"no parameter of {name} has a null.")
            around = System(built, ((name, effect),))
            inner = drawn(effect.box([record]), 6).copy()
            for on in (False, True):
                for row, parameter in enumerate(effect.box([record])):
                    if parameter.null is not None:
                        inner[row] = parameter.upper if on else parameter.null
                same = np.array_equal(around.simulate(record.signal, np.vstack([values, inner])), bare)
                told = "nothing at the edge of its box" if on else "the output at its null"
                expect(same != on, f"{name} changes {told}.")

    def test_it_does_what_it_declares(self, plugin: str) -> None:
        """It has the properties that it declares, and its loops run in the senses that it declares."""
        built = self.build(plugin)
        system, record = System(built), measured()
        values = drawn(system.box([record]), 24)

        def run(signal: Signal) -> Array:
            return system.simulate(signal, values)

        for name in built.properties:
            most = float(np.max(missed(run, name)))
            expect(most <= ALIKE, f"it declares {name}, and misses that by {most:.2g} of its output's range.")
        other = {*turned(run)} - {0, *built.senses}
        expect(not other, f"a loop runs {'anticlockwise' if 1 in other else 'clockwise'}, which it does not declare.")

    def test_it_advises_in_sentences(self, plugin: str) -> None:
        """What it says of records are sentences."""
        record = measured()
        for some in (record, locked(replace(record, output=5.0 - record.measured))):
            for told in self.build(plugin).advice([some]):
                expect(isinstance(told, str) and told.endswith((".", "?")), f"its advice is no sentence: {told!r}")

    def test_its_example_makes_data(self, plugin: str) -> None:
        """The example that it may declare names its parameters, and has random numbers of its own."""
        built = self.build(plugin)
        if built.example is None:
            return
        named, parameters = set(built.example.parameters), {q.name for q in built.parameters}
        expect(named == parameters, f"its example tells {sorted(named)}, its parameters are {sorted(parameters)}.")
        others = {
            name: getattr(registry.load("models", name).loaded, "example", None)
            for name in registry.names("models")
            if name != plugin
        }
        alike = [name for name, one in others.items() if one is not None and one.stream == built.example.stream]
        expect(not alike, f"the stream {built.example.stream} of its example is also that of {', '.join(alike)}.")
        expect(built.example.amplitude > 0.0, "the amplitude of its example must be above 0.")


def _names(system: System) -> list[str]:
    return [parameter.name for parameter in system.parameters]


def _untimed(record: Record) -> Record:
    return replace(record, units={**record.units, "time": INDEX})
