"""Temperature sensitivity: the response scales, and its zero moves, with a measured temperature."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import output_span


def _scaled(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) * (1.0 + 0.04 * hiding.strength * (hiding.temperature - 20.0))


def _steeper(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) * (1.0 + (0.01 + 0.005 * hiding.strength) * (hiding.temperature - 20.0))


def _arrhenius(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Thermally activated: exponential in the inverse absolute temperature."""
    inverse = 1.0 / 293.15 - 1.0 / (273.15 + hiding.temperature)
    return inner(u) * np.exp(4000.0 * hiding.strength * inverse)


def _parabolic(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Compensated at one temperature: what is left is a parabola about another one."""
    return inner(u) * (1.0 + 0.004 * hiding.strength * (hiding.temperature - 16.0) ** 2)


@dataclass(frozen=True)
class TemperatureSensitivity(Effect):
    """Gain and zero of the output change linearly with the temperature, which a column of the data tells.

    y = x (1 + gain (T - T_ref)) + expansion (T - T_ref), x the response: the two temperature coefficients of
    a transducer's data sheet [1]. Both are 0 where there is no sensitivity.

    `reference` is T_ref, the same for all records, in degC, into which the column is converted. Another reference is
    the same law with other values of the model's gain and offset.

    [1] IEC 61298-3:2008, Process measurement and control devices, tests for the effects of influence
    quantities, ambient temperature.
    """

    acts = "output"
    family = "change with time, path or temperature"
    wants = MappingProxyType({"temperature": "degC"})
    affine = True
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_scaled, _steeper)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_arrhenius, _parabolic)
    parameters = (
        Parameter("gain", -0.05, 0.05, "1/K", null=0.0, meaning="relative change of the response"),
        Parameter("expansion", -1.0, 1.0, "{output}/K", null=0.0, meaning="change of the output's zero"),
    )

    reference: float = 20.0

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if "temperature" not in signal.columns:
            raise ValueError("temperature-sensitivity needs a column temperature; these data have none")
        from hysteresis_bench.kernels.effects.curve_in_time import scale_and_add

        output = own(inner(signal), signal)
        scale_and_add(output, signal.columns["temperature"] - self.reference, p.gain, p.expansion)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """A gain that stays above a tenth at every temperature; a zero that moves by up to the output's range."""
        gain, expansion = self.parameters
        temperature = np.concatenate([record.columns["temperature"] for record in records])
        steepest = 0.9 / (float(np.max(np.abs(temperature - self.reference))) or 1.0)
        fastest = (output_span(records) or 1.0) / (float(np.ptp(temperature)) or 1.0)
        return gain.within(-steepest, steepest), expansion.within(-fastest, fastest)

    def inapplicable(self, records: Sequence[Record]) -> str:
        lacking = [record.name for record in records if "temperature" not in record.columns]
        if lacking:
            return f"record {lacking[0]} has no column temperature with a number in every row"
        temperature = np.concatenate([record.columns["temperature"] for record in records])
        if not np.all(np.isfinite(temperature)):
            return "the temperature is not known at every sample"
        if np.ptp(temperature) <= 1e-9 * np.max(np.abs(temperature)):
            return "the temperature never changes"
        return ""
