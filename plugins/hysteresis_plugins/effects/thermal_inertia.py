"""Thermal inertia: the response scales, and its zero moves, with a temperature that follows the measured one late."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._hidden import euler_lag, tustin_lag
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import FINEST, finest_step, longest, without_time
from hysteresis_plugins.effects.temperature_sensitivity import TemperatureSensitivity


def _warming(inner: Response, u: Array, hiding: Hiding) -> Array:
    inside = euler_lag(hiding.temperature, 0.1 * hiding.duration, hiding.step)
    return inner(u) * (1.0 + 0.04 * hiding.strength * (inside - 20.0))


def _two_walls(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Through a case, and then through the device."""
    case = tustin_lag(hiding.temperature, 0.06 * hiding.duration, hiding.step)
    inside = tustin_lag(case, 0.06 * hiding.duration, hiding.step)
    return inner(u) * (1.0 + 0.03 * hiding.strength * (inside - 20.0))


@dataclass(frozen=True)
class ThermalInertia(Effect):
    """Gain and zero of the output change linearly with the device's temperature, which follows the measured one with a
    first-order lag: a body of one temperature throughout, in surroundings whose temperature a column of the data tells.

    tau dT_i/dt + T_i = T, T_i = T at the first sample [1]; y = x (1 + gain (T_i - T_ref)) + expansion (T_i - T_ref),
    x the response. With tau = 0 it is `temperature-sensitivity`; `reference` is T_ref, as there.

    [1] F. P. Incropera, D. P. DeWitt, T. L. Bergman, A. S. Lavine, Fundamentals of Heat and Mass Transfer, 6th ed.,
    Wiley (2007), section 5.1, the lumped capacitance method.
    """

    acts = "output"
    family = "change with time, path or temperature"
    wants = TemperatureSensitivity.wants
    affine = True
    linear = ("expansion",)
    mistaken_for: ClassVar[Mapping[str, str]] = MappingProxyType(
        {"temperature-sensitivity": "where the temperature changes slowly the device has the measured one"}
    )
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_warming, _two_walls)
    parameters = (
        *TemperatureSensitivity.parameters,
        Parameter("time_constant", 1e-3, 1e3, "{time}", "log", null=0.0, meaning="tau of the device's temperature"),
    )

    reference: float = 20.0

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if "temperature" not in signal.columns:
            raise ValueError("thermal-inertia needs a column temperature; these data have none")
        from hysteresis_bench.kernels.lag import lag

        output = own(inner(signal), signal)
        if not signal.timed:
            return output
        inside = lag(signal.time, signal.columns["temperature"][:, None] - self.reference, p.time_constant)
        output *= 1.0 + p.gain * inside
        output += p.expansion * inside
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The coefficients as of `temperature-sensitivity`; a lag from a fiftieth of a sampling step to the duration of
        the longest record."""
        known = TemperatureSensitivity(self.reference).box(records)
        return *known, self.parameters[-1].within(FINEST * finest_step(records), longest(records))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return without_time(records) or TemperatureSensitivity().inapplicable(records)
