"""A family as it is told where none of its formulas fits: the sentence, and the curve that is drawn."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.free_forms import Curve, FreeForm
from hysteresis_bench.parameters import Parameter

STRAIGHT = 0.9
"""Net change over all movement from which a curve rises, or falls, from end to end."""

LEVELLING, STEEPENING = 0.4, 1.8
"""Slope of the last fifth of a curve over its mean slope, below which it levels off and above which it steepens."""


@dataclass(frozen=True, eq=False)
class FamilyFinding:
    """effect : the free form's name;  curve : with the units of the data"""

    effect: str
    family: str
    curve: Curve

    @property
    def sentence(self) -> str:
        curve = self.curve
        along = np.log(curve.x) if curve.logarithmic else curve.x
        how = course(along, curve.y)
        moves = f"the {curve.of} {how}{',' if ',' in how else ''} with the {curve.along}"
        return f"{self.effect} ({self.family}): {moves}; no formula here fits: the curve is in the model."


def family_findings(model: FittedModel) -> tuple[FamilyFinding, ...]:
    """Of the free forms around a fitted model."""
    values = {**model.fixed, **{name: estimate.value for name, estimate in model.parameters.items()}}
    return tuple(
        FamilyFinding(name, effect.family, _in_units(effect.curve(_own(values, name, effect)), model.units))
        for name, effect in model.system.effects
        if isinstance(effect, FreeForm)
    )


def forms_of(names: tuple[str, ...]) -> dict[str, str]:
    """The free forms among effects, each with its family."""
    found = {name: registry.effect(name) for name in names}
    return {name: effect.family for name, effect in found.items() if issubclass(effect, FreeForm)}


def course(x: Array, y: Array) -> str:
    """How a curve goes, in words."""
    steps = np.diff(y)
    moved, net = float(np.sum(np.abs(steps))), float(y[-1] - y[0])
    if moved == 0.0:
        return "does not change"
    if abs(net) > STRAIGHT * moved:
        last = x >= x[0] + 0.8 * (x[-1] - x[0])
        ratio = float((y[-1] - y[last][0]) / (x[-1] - x[last][0]) / (net / (x[-1] - x[0])))
        ends = " and levels off" if ratio < LEVELLING else ", faster at the end" if ratio > STEEPENING else ""
        return f"{'rises' if net > 0.0 else 'falls'}{ends}"
    top, bottom = int(np.argmax(y)), int(np.argmin(y))
    peaked = abs(y[top] - y[0]) + abs(y[top] - y[-1]) > STRAIGHT * moved
    dipped = abs(y[bottom] - y[0]) + abs(y[bottom] - y[-1]) > STRAIGHT * moved
    return "rises, then falls" if peaked else "falls, then rises" if dipped else "goes up and down"


def _own(values: Mapping[str, float], name: str, effect: FreeForm) -> Any:
    found = {one.name: values[f"{name}.{one.name}"] for one in effect.parameters}
    return namedtuple("Values", list(found))(**found)


def _in_units(curve: Curve, units: Mapping[str, str]) -> Curve:
    x_unit, y_unit = (Parameter("", 0.0, 1.0, unit).unit_in(units) for unit in (curve.x_unit, curve.y_unit))
    return Curve(curve.x, curve.y, curve.along, curve.of, x_unit, y_unit, curve.logarithmic)
