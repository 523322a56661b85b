"""The input that makes a fitted model follow a trajectory, and what the model then answers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.compensation import Forward
from hysteresis_bench.control.feed_forward import INVERTIBLE, feed_forward
from hysteresis_bench.control.iterated_inverse import iterated_inverse
from hysteresis_bench.control.linear_dynamics import is_even
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class Driven:
    """input, reached : (samples,) the actuator's input, and the whole model's answer to it
    cut : (samples,) where the limit changed the input
    undone : linear dynamics that the input makes up for;  ignored : effects that it does not
    """

    input: Array
    reached: Array
    cut: Array
    undone: tuple[str, ...]
    ignored: tuple[str, ...]


def forward_of(fitted: FittedModel) -> Forward:
    """The exact inverse where there is one and nothing static stands around it, else the iterated one.

    Raises ValueError saying why there is none.
    """
    if fitted.model in INVERTIBLE:
        exact = feed_forward(fitted)
        if exact.linear or not set(exact.ignored) & _static(fitted):
            return exact
    return iterated_inverse(fitted)


def drive(fitted: FittedModel, forward: Forward, time: Array, wanted: Array, limit: float = np.inf) -> Driven:
    """time, wanted : (samples,), in the model's units;  limit : of the input, to either side.

    Raises ValueError where no input is found.
    """
    ahead, section, even = forward.dynamics, forward.linear, is_even(time)
    law = ahead.output_for(time, wanted) if ahead and even else wanted
    if section and even:
        law = forward.offset + section.undone(time, law - forward.offset)
    needed, cut = forward.input_for(law, limit)
    seen = forward.preparation.seen_input(needed)
    if ahead and even:
        seen = ahead.input_for(time, seen)
        needed = np.clip(forward.preparation.measured_input(seen), -limit, limit)
        cut = cut | (np.abs(needed) >= limit)
    record = Record(time, forward.preparation.seen_input(needed), None, units=fitted.units)
    reached = fitted.system.respond(record, fitted.values[:, None])[:, 0]
    own = (*(ahead.names if ahead else ()), *(("the linear section",) if section else ()))
    ignored = forward.ignored if even else (*forward.ignored, *own)
    return Driven(needed, reached, cut, own if even else (), ignored)


def _static(fitted: FittedModel) -> set[str]:
    """Effects that the iterated inverse undoes with the law."""
    known = iterated_inverse(fitted)
    return {name for name, _ in known.system.effects}
