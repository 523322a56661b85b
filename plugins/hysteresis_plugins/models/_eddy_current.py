"""Eddy currents, as the models offer them: an effect inside the state equation."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import (
    FINEST,
    dominant_frequency,
    finest_step,
    input_span,
    output_span,
    unresolved,
)
from hysteresis_plugins.models._eddy_current_hidden import opposed


@dataclass(frozen=True)
class EddyCurrent(Effect):
    """Eddy currents inside the hysteresis law: the input that acts is opposed by the rate of the output.

    z = u - coefficient dy/dt acts in place of the input u, y = F[z], see [1, 2]; z = u at the first sample. For a law
    of constant slope this is an input lag of coefficient times the slope; the steeper the law, the longer it lags.
    Loops grow with frequency. `kernels.eddy_current` says how it is solved: second order in the sampling step. The
    latent heat of a transformation, where the input is a temperature, is the same term under another name.

    The box is logarithmic and ends above the null 0, at a lag of a fiftieth of a sampling step over the mean slope.

    [1] G. Bertotti, Hysteresis in Magnetism, Academic Press (1998), ch. 12.
    [2] D. C. Jiles, IEEE Trans. Magnetics 30 (1994) 4326.
    """

    acts = "law"
    family = "law"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "creep": "both let a part of the response arrive late",
        "input-lag": (
            "where the slope of the loop changes little, eddy currents are an input lag of the coefficient times the "
            "slope"
        ),
        "output-lag": (
            "where the slope of the loop changes little, eddy currents are a lag, and a small lag before the "
            "hysteresis and one after it differ only at second order"
        ),
        "resonance": (
            "where the slope of the loop changes little, eddy currents are a lag, and so is a damped resonance"
        ),
        "transport-delay": (
            "where the slope of the loop changes little, eddy currents are a lag, which at one frequency is a delay"
        ),
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (opposed,)
    parameters = (
        Parameter(
            "coefficient", 1e-4, 10.0, "{input} {time}/{output}", "log", null=0.0, meaning="drag on the output's rate"
        ),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        return inner(signal)  # the model has applied it

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Where the mean slope lags by a fiftieth of a sampling step to a period of the slowest record's input."""
        slope = (output_span(records) or 1.0) / (input_span(records) or 1.0)
        period = max(1.0 / dominant_frequency(record) for record in records)
        return (self.parameters[0].within(FINEST * finest_step(records) / slope, period / slope),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)


OFFERS = {"eddy-current": EddyCurrent()}


def with_eddy_current(
    plain: Callable[[Array, Any], Array],
    dragged: Callable[[Array, Array, Array, Any], Array],
    signal: Signal,
    p: Any,
) -> Array:
    """A model's output, (samples, swarm), with eddy currents where the signal has a time and p a coefficient.

    plain(u, p) : without; dragged(time, u, coefficient, p) : with, for the particles whose coefficient is not 0.
    The others are plain to the last bit.
    """
    eddy = getattr(p, "eddy_current", None)
    if eddy is None or not signal.timed or not (on := np.flatnonzero(eddy.coefficient)).size:
        return plain(signal.input, p)
    if on.size == eddy.coefficient.size:
        return dragged(signal.time, np.ascontiguousarray(signal.input), eddy.coefficient, p)
    output = plain(signal.input, p)
    u = signal.input if signal.input.shape[1] == 1 else np.ascontiguousarray(signal.input[:, on])
    some = p._make(values[on] if isinstance(values, np.ndarray) else values for values in p)
    output[:, on] = dragged(signal.time, u, eddy.coefficient[on], some)
    return output
