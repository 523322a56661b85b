"""Output lag: what is measured follows the response with a first-order lag."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import euler_lag, level_lag, longest_lag, middling_lag, tustin_lag, unequal_lag
from hysteresis_plugins.effects._ranges import FINEST, finest_step, longest, unresolved


def _euler(inner: Response, u: Array, hiding: Hiding) -> Array:
    return euler_lag(inner(u), longest_lag(hiding), hiding.step)


def _tustin(inner: Response, u: Array, hiding: Hiding) -> Array:
    return tustin_lag(inner(u), middling_lag(hiding), hiding.step)


def _slower_far_out(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Slower the further out, as of a sensor that softens."""
    return level_lag(inner(u), longest_lag(hiding), hiding.top, hiding.step)


def _slower_down(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Faster up than down, as of a valve or a clamp."""
    return unequal_lag(inner(u), 0.6 * longest_lag(hiding), 1.4 * longest_lag(hiding), hiding.step)


@dataclass(frozen=True)
class OutputLag(Effect):
    """A first-order lag after the hysteresis, such as a sensor's lag or an overdamped mechanism's.

    tau dy/dt + y = x, x the response, y = x at the first sample. Exact for a response that is linear between
    its samples [1].

    The box is logarithmic and ends above the null 0, at a lag of a fiftieth of a sampling step, which no
    longer differs from none.

    [1] K. Ogata, Modern Control Engineering, 5th ed., Prentice Hall (2010), first-order systems.
    """

    acts = "output"
    family = "dynamics after the law"
    affine = True
    relaxes = True
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "creep": "creep with one relaxation and nearly the whole response late is a lag",
        "resonance": "an overdamped resonance is a lag",
        "transport-delay": (
            "a lag that is short against the fastest movement is a delay to first order; it differs in the damping of "
            "what is fast"
        ),
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_euler, _tustin)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_slower_far_out, _slower_down)
    parameters = (Parameter("time_constant", 1e-4, 10.0, "{time}", "log", null=0.0, meaning="tau of the lag"),)

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.lag import lag

        output = inner(signal)
        return lag(signal.time, output, p.time_constant) if signal.timed else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """From a fiftieth of a sampling step to the duration of the longest record."""
        return (self.parameters[0].within(FINEST * finest_step(records), longest(records)),)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return unresolved(records)
