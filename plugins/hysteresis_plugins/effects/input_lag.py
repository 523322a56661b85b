"""Input lag: what drives the hysteresis follows the measured input with a first-order lag."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import euler_lag, level_lag, longest_lag, middling_lag, tustin_lag, unequal_lag
from hysteresis_plugins.effects._ranges import FINEST, finest_step, longest, unresolved


def _euler(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(euler_lag(u, longest_lag(hiding), hiding.step))


def _tustin(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(tustin_lag(u, middling_lag(hiding), hiding.step))


def _slower_far_out(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Slower the further out, as where a heat capacity grows."""
    return inner(level_lag(u, longest_lag(hiding), hiding.amplitude, hiding.step))


def _slower_down(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Faster up than down, as heating is than cooling."""
    return inner(unequal_lag(u, 0.6 * longest_lag(hiding), 1.4 * longest_lag(hiding), hiding.step))


@dataclass(frozen=True)
class InputLag(Effect):
    """A first-order lag before the hysteresis, such as a thermal or an amplifier's lag.

    tau dv/dt + v = u, v = u at the first sample; the model sees v. Exact for an input that is linear between
    its samples [1].

    The box is logarithmic and ends above the null 0, at a lag of a fiftieth of a sampling step, which no
    longer differs from none.

    [1] K. Ogata, Modern Control Engineering, 5th ed., Prentice Hall (2010), first-order systems.
    """

    acts = "input"
    family = "dynamics before the law"
    affine = True
    relaxes = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "transport-delay": (
            "after the transient a lag before a rate-independent hysteresis and a delay both only shift the loop in "
            "time; they differ in how the shift depends on the frequency"
        ),
        "output-lag": (
            "a small lag before the hysteresis and one after it differ only at second order in frequency times lag, "
            "where the loop is not a straight line"
        ),
        "resonance": "an overdamped resonance is a lag, here on the other side of the hysteresis",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_euler, _tustin)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_slower_far_out, _slower_down)
    parameters = (Parameter("time_constant", 1e-4, 10.0, "{time}", "log", null=0.0, meaning="tau of the lag"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.lag import lag

        if not signal.timed or not np.any(p.time_constant):  # the model sees the very input, still shared
            return inner(signal)
        return inner(signal.with_input(lag(signal.time, signal.input, p.time_constant)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From a fiftieth of a sampling step to the duration of the longest record."""
        return (self.parameters[0].within(FINEST * finest_step(records), longest(records)),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)
