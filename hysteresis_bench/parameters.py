"""Parameters and the search space: bounds, scaling and units live here; searches see the unit box."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from hysteresis_bench.arrays import Array

Scaling = Literal["linear", "log"]


@dataclass(frozen=True)
class Parameter:
    """One number that a fit may find.

    name : the symbol or word by which settings, tables and files know it
    lower, upper : the search box, in `unit`
    unit : may name {input}, {output} and {time}, replaced by the units of the data
    scaling : how the unit interval maps to the box: linear, or log where decades matter
    null : the value that switches an effect off; None for a parameter that switches nothing
    positive : whether the model makes sense only above 0, as with a width
    limit : an edge of the box that is a limiting form, such as a clip of a bend: nothing is amiss there
    """

    name: str
    lower: float
    upper: float
    unit: str = "1"
    scaling: Scaling = "linear"
    null: float | None = None
    meaning: str = ""
    positive: bool = False
    limit: float | None = None

    def within(self, lower: float, upper: float, scaling: Scaling | None = None) -> Parameter:
        """The same parameter in another box."""
        return replace(self, lower=float(lower), upper=float(upper), scaling=scaling or self.scaling)

    def bounded(self, lower: float, upper: float, scaling: Scaling | None = None) -> Parameter:
        """The same parameter in a box that somebody asks for: linear where it reaches down to 0, which has no
        logarithm, unless a scaling is asked for as well."""
        return self.within(lower, upper, scaling or ("linear" if lower <= 0 else None))

    def unit_in(self, units: Mapping[str, str]) -> str:
        """The unit with those of the data put in; a quantity without a unit goes by its own name."""
        return self.unit.format(**{name: name if unit == "1" else unit for name, unit in units.items()})

    def faults(self) -> list[str]:
        """What is wrong with the box, a sentence each; empty when nothing is."""
        found = []
        if not (np.isfinite(self.lower) and np.isfinite(self.upper)):
            found.append(f"{self.name}: bounds {self.lower} and {self.upper} must be finite.")
        elif self.lower > self.upper:
            found.append(f"{self.name}: low {self.lower} is above high {self.upper}.")
        elif self.lower == self.upper:
            found.append(f"{self.name}: low and high are both {self.lower}; leave room between them.")
        if self.positive and self.lower <= 0:
            found.append(f"{self.name}: must be above 0; its low bound is {self.lower:g}.")
        elif self.scaling == "log" and self.lower <= 0:
            found.append(f"{self.name}: log scaling needs a low bound above 0, not {self.lower}.")
        return found

    def refuses(self, value: float) -> str:
        """Why the parameter cannot have this value, or an empty string. It may lie outside the box."""
        if not np.isfinite(value):
            return f"{self.name} = {value} must be finite."
        if self.null == 0.0 and self.scaling == "log" and value < 0.0:  # such as a time constant
            return f"{self.name} = {value:g} must be at least 0."
        return f"{self.name} = {value:g} must be above 0." if self.positive and value <= 0 else ""


@dataclass(frozen=True)
class Space:
    """The box of a search, and the map between it and the unit box."""

    parameters: tuple[Parameter, ...]

    @property
    def dimension(self) -> int:
        return len(self.parameters)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def _edges(self) -> tuple[Array, Array, Array]:
        logarithmic = np.array([p.scaling == "log" for p in self.parameters])[:, None]
        lower = np.array([p.lower for p in self.parameters], dtype=float)[:, None]
        upper = np.array([p.upper for p in self.parameters], dtype=float)[:, None]
        low = np.where(logarithmic, np.log(np.where(logarithmic, lower, 1.0)), lower)
        high = np.where(logarithmic, np.log(np.where(logarithmic, upper, 1.0)), upper)
        return low, high - low, logarithmic

    @cached_property
    def _logarithmic(self) -> Array:
        return np.flatnonzero(self._edges[2])

    def from_unit(self, points: Array) -> Array:
        """Unit box to physical values. points : (dimension, swarm) in [0, 1] -> same shape, in units."""
        low, span, _ = self._edges
        values: Array = low + span * points
        if (rows := self._logarithmic).size:
            values[rows] = np.exp(values[rows])
        return values

    def to_unit(self, values: Array) -> Array:
        """Physical values to the unit box, (dimension, swarm); values outside the box land outside it."""
        low, span, logarithmic = self._edges
        scaled = np.where(logarithmic, np.log(np.where(logarithmic, values, 1.0)), values)
        return (scaled - low) / span
