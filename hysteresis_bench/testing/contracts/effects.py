"""What every effect promises: neutral at its null, finite, its units what they say, its declarations kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.signals import INDEX, Record
from hysteresis_bench.testing.contract import expect
from hysteresis_bench.testing.contracts.hiding import changes
from hysteresis_bench.testing.contracts.units import factor
from hysteresis_bench.testing.examples import QUANTITIES, Cubic, locked, measured
from hysteresis_bench.testing.parameters import expect_described, expect_sound
from hysteresis_bench.testing.plugin import PluginContract, shipped
from hysteresis_bench.testing.swarms import (
    corners,
    drawn,
    expect_finite,
    expect_shape,
    expect_strangers,
    expect_untouched,
)

SLOPE, BEND = 1.3, 0.4
"""Of the cubic that effects are put around."""
SEEN = 0.01
"""Share of the output's range by which an effect at the edge of its box changes the output at least."""
SCALES = {"input": 40.0, "output": 1e-3, "time": 250.0}
"""Units of input, output and time in which the same data are told again."""


class EffectContract(PluginContract):
    """Subclass it in a test file and name the plugin: `plugin = "my-effect"`."""

    kind = "effects"

    def use(self, built: Any) -> Sequence[Array]:
        record = measured()
        return [_around(built).respond(record, _values(built, record, 5))]

    def test_its_parameters_are_described(self, plugin: str) -> None:
        """Its parameters have names, units, meanings and sound boxes, and one at least switches it off."""
        effect = self.build(plugin)
        expect_described(effect.parameters)
        expect_sound(effect.parameters, effect.parameters, "its own box")
        expect_sound(effect.box([measured(), measured(uneven=True)]), effect.parameters, "its box of ordinary records")
        switches = [one for one in effect.parameters if one.null is not None]
        expect(switches or not effect.parameters, "no parameter has a null, the value that switches the effect off.")

    def test_it_is_neutral_at_null(self, plugin: str) -> None:
        """At its null value it changes nothing, to the last bit, also beside particles that have it on."""
        effect = self.build(plugin)
        for record in (measured(), measured(uneven=True)):
            bare = np.repeat(_bare(record), 8, axis=1)
            values = _values(effect, record, 8)
            off = _switched_off(effect, values)
            expect(np.array_equal(_around(effect).simulate(record.signal, off), bare), "at its null it changes bits.")
            some = values.copy()
            some[:, ::2] = off[:, ::2]
            mixed = _around(effect).simulate(record.signal, some)
            expect(
                np.array_equal(mixed[:, ::2], bare[:, ::2]),
                "at its null it changes bits where other particles of the swarm have it on.",
            )

    def test_it_is_neutral_at_null_around_every_model(self, plugin: str) -> None:
        """At its null value it changes nothing, to the last bit, around every shipped model either."""
        effect = self.build(plugin)
        record = measured(121)
        for name in shipped("models"):
            alone = System(registry.build("models", name))
            values = drawn(alone.box([record]), 5)
            off = _switched_off(effect, _values(effect, record, 5))[2:]
            around = replace(alone, effects=((plugin, effect),))
            simulated = around.simulate(record.signal, np.vstack([values, off]))
            same = np.array_equal(simulated, alone.simulate(record.signal, values))
            expect(same, f"at its null it changes bits of the model {name}.")

    def test_it_changes_something(self, plugin: str) -> None:
        """At the far edge of its box it changes the output by a hundredth of its range or more."""
        effect = self.build(plugin)
        record = measured()
        values = _values(effect, record, 8).copy()
        for row, parameter in enumerate(effect.box([record]), start=2):
            if parameter.null is not None:
                values[row] = parameter.upper
        change = np.max(np.abs(_around(effect).respond(record, values) - _bare(record)), axis=0)
        least = float(np.min(change)) / float(np.ptp(record.measured))
        expect(
            least > SEEN or not effect.parameters,
            f"at the upper edge of its box it changes the output by {least:.2g} of its range only; widen the box.",
        )

    def test_it_approaches_its_null_without_a_jump(self, plugin: str) -> None:
        """What it changes vanishes as its parameters go to their null."""
        effect = self.build(plugin)
        record = measured()
        values = np.repeat(_values(effect, record, 1), 30, axis=1)
        for row, parameter in enumerate(effect.parameters, start=2):
            if parameter.null is not None:
                values[row] = parameter.null + (values[row] - parameter.null) * 0.5 ** np.arange(30)
        change = np.max(np.abs(_around(effect).simulate(record.signal, values) - _bare(record)), axis=0)
        expect(
            change[-1] <= 1e-3 * change[0],
            f"near its null it still changes the output by {change[-1]:.2g}, of {change[0]:.2g} further away: a jump.",
        )

    def test_it_is_finite_in_its_box(self, plugin: str) -> None:
        """It answers float64[samples, swarm], finite all over its box and at its corners, also of a sample or two."""
        effect = self.build(plugin)
        record = measured(uneven=True)
        system = _around(effect)
        names = [parameter.name for parameter in system.parameters]
        box = effect.box([record])
        for inner, where in ((drawn(box, 64), "in its box"), (corners(box), "at a corner of its box")):
            values = _with_cubic(inner)
            for part in (record, record.take(slice(0, 2)), record.take(slice(0, 1))):
                simulated = system.respond(part, values)
                expect_shape(simulated, part.time.size, values.shape[1])
                expect_finite(simulated, values, names, f"{where}, of {part.time.size} samples,")

    def test_its_particles_are_strangers(self, plugin: str) -> None:
        """A particle's answer does not depend on the others; an input a particle is as good as a shared one."""
        effect = self.build(plugin)
        record = measured(uneven=True)
        expect_strangers(_around(effect), record, _values(effect, record, 9))

    def test_it_leaves_its_arguments_alone(self, plugin: str) -> None:
        """It changes neither the record nor the parameters."""
        effect = self.build(plugin)
        record = measured()
        expect_untouched(_around(effect), record, _values(effect, record, 4))

    def test_it_does_not_depend_on_the_sampling(self, plugin: str) -> None:
        """The same line, more finely sampled, gets the same answer, as accurately as the effect says."""
        effect = self.build(plugin)
        record = measured()
        fine = np.linspace(record.time[0], record.time[-1], 4 * (record.time.size - 1) + 1)
        fine[::4] = record.time

        def between(values: Array) -> Array:
            return np.interp(fine, record.time, values)

        columns = {key: between(column) for key, column in record.columns.items()}
        dense = replace(
            record, time=fine, input=between(record.input), output=between(record.measured), columns=columns
        )
        values = _values(effect, record, 12).copy()
        values[1] = 0.0  # a straight line stays one
        coarse = _around(effect).simulate(record.signal, values)
        error = float(np.max(np.abs(_around(effect).simulate(dense.signal, values)[::4] - coarse)))
        expect(
            error < effect.accuracy, f"four times as many samples of the same line change its answer by {error:.2g}."
        )

    def test_it_knows_a_time_that_is_an_index(self, plugin: str) -> None:
        """Where time is only an index and it says that it does not apply, it changes nothing."""
        effect = self.build(plugin)
        record = replace(measured(), units={**QUANTITIES, "time": INDEX})
        if effect.inapplicable([record]):
            simulated = _around(effect).simulate(record.signal, _values(effect, record, 4))
            same = np.array_equal(simulated, np.repeat(_bare(record), 4, axis=1))
            expect(same, "it does not apply to a time that is an index, and changes the output all the same.")

    def test_its_units_are_what_they_say(self, plugin: str) -> None:
        """Data in other units get the box, and the answer, in other units: nothing else changes."""
        effect = self.build(plugin)
        record = measured()
        other = _told_in(record, SCALES)
        factors = np.array([factor(parameter, SCALES) for parameter in effect.parameters])
        for here, there, one in zip(effect.box([record]), effect.box([other]), factors, strict=True):
            wanted, found = one * np.array([here.lower, here.upper]), np.array([there.lower, there.upper])
            expect(
                np.allclose(found, wanted, rtol=1e-9),
                f"{here.name} in {here.unit}: data in other units give the box {found}, not {wanted}.",
            )
        values = _values(effect, record, 6)
        cubic = [factor(parameter, SCALES) for parameter in Cubic.parameters]
        again = _around(effect).simulate(other.signal, values * np.array([*cubic, *factors])[:, None])
        simulated = SCALES["output"] * _around(effect).simulate(record.signal, values)
        expect(
            np.allclose(again, simulated, rtol=1e-7, atol=1e-10),
            "the same data and parameters in other units give another answer: a unit is not what it says.",
        )

    def test_it_is_affine_where_it_says_so(self, plugin: str) -> None:
        """Where it says `affine`, the output is affine in what is wrapped, jointly with its `linear` parameters."""
        effect = self.build(plugin)
        names = [parameter.name for parameter in effect.parameters]
        strange = sorted({*effect.linear} - {*names})
        expect(not strange, f"it calls {', '.join(strange)} linear and has no such parameter.")
        expect(effect.affine or not effect.linear, "what is linear in it is so beside what is wrapped: say affine too.")
        record = measured()
        one = _values(effect, record, 12)
        other, between = one.copy(), one.copy()
        rows = [0, 1, *(2 + names.index(name) for name in effect.linear)]  # the cubic is linear in both of its own
        other[rows] = one[rows][:, ::-1]
        between[rows] = 0.3 * one[rows] + 0.7 * other[rows]
        low, high, middle = (_around(effect).respond(record, values) for values in (one, other, between))
        error, scale = float(np.max(np.abs(0.3 * low + 0.7 * high - middle))), float(np.max(np.abs([low, high])))
        expect(not effect.affine or error <= 1e-9 * scale, f"it is not affine: off by {error:.2g} of {scale:.2g}.")

    def test_it_relaxes_where_it_says_so(self, plugin: str) -> None:
        """Where it says `relaxes`, the output of a step of the input rises steadily, and to no more than the step."""
        effect = self.build(plugin)
        ordinary = measured()
        record = locked(replace(ordinary, input=np.where(np.arange(ordinary.time.size) < 40, 0.0, 1.0)))
        rising = _around(effect).simulate(record.signal, _values(effect, ordinary, 16)) / (SLOPE + BEND)
        steady = np.min(np.diff(rising, axis=0)) >= -1e-9 and np.max(rising) <= 1.0 + 1e-9
        expect(not effect.relaxes or steady, "of a step its output falls, or rises beyond the step: it does not relax.")

    def test_it_applies_to_a_good_record(self, plugin: str) -> None:
        """It has no reason against an ordinary record."""
        reason = self.build(plugin).inapplicable([measured()])
        expect(reason == "", f"of an ordinary record it says {reason!r}.")

    def test_its_rivals_are_known(self, plugin: str) -> None:
        """What it may be mistaken for are effects that can be claimed; the reason stands on one of the two."""
        for rival, reason in registry.effect(plugin).mistaken_for.items():
            known = {*registry.names("effects"), *registry.offered()}
            expect(rival in known, f'no effect "{rival}", for which it may be mistaken.')
            expect(not registry.effect(rival).nuisance, f"{rival} is a nuisance, never claimed, so nobody mistakes it.")
            expect(plugin not in registry.effect(rival).mistaken_for, f"{rival} already tells why; once is enough.")
            expect(reason and not reason.endswith("."), f"the reason against {rival} ends a sentence: no full stop.")

    def test_its_hidden_forms_change_the_output(self, plugin: str) -> None:
        """Every formula that hides it changes the output, more so the stronger it is."""
        for form in self.build(plugin).hidden_forms:
            name = getattr(form, "__name__", repr(form))
            weak, strong = changes(form)
            expect(1e-4 < weak < strong, f"{name} changes the output by {weak:.2g} and, stronger, by {strong:.2g}.")


def _around(effect: Effect, model: Model | None = None) -> System:
    return System(model or Cubic(), (("effect", effect),))


def _bare(record: Record) -> Array:
    return System(Cubic()).simulate(record.signal, np.array([[SLOPE], [BEND]]))


def _with_cubic(inner: Array) -> Array:
    """Values of the effect below those of the cubic."""
    return np.vstack([np.repeat([[SLOPE], [BEND]], inner.shape[1], axis=1), inner])


def _values(effect: Effect, record: Record, swarm: int) -> Array:
    """A swarm all over the effect's box, around one cubic."""
    return _with_cubic(drawn(effect.box([record]), swarm))


def _switched_off(effect: Effect, values: Array) -> Array:
    off = values.copy()
    for row, parameter in enumerate(effect.parameters, start=2):
        if parameter.null is not None:
            off[row] = parameter.null
    return off


def _told_in(record: Record, scales: dict[str, float]) -> Record:
    return locked(
        replace(
            record,
            time=scales["time"] * record.time,
            input=scales["input"] * record.input,
            output=scales["output"] * record.measured,
        )
    )
