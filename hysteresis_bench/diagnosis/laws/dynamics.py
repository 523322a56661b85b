"""What a law is ranked with where effects will be sought around it: drifts, and linear dynamics on either side."""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.free_forms import FreeForm

SIDES = ("dynamics before the law", "dynamics after the law")
"""Families."""


def drifts(stack: Stack) -> list[str]:
    """What is estimated anew on every record beside its offset, and describes no effect."""
    names = [name for name in sorted(registry.names("effects")) if name not in registry.OFFSETS]
    effects = {name: stack.effect(name) for name in names}
    asked = {name: one for name, one in effects.items() if one.nuisance and one.estimates}
    return [name for name, effect in asked.items() if not effect.inapplicable(stack.records)]


def linear_dynamics(stack: Stack) -> list[str]:
    """For either side of the law the free form, or else, as at one frequency, the formula of fewest parameters."""

    def plainness(name: str) -> tuple[bool, int, str]:
        return not isinstance(stack.effect(name), FreeForm), len(stack.effect(name).parameters), name

    possible = [name for name in (*stack.free_forms(), *stack.candidates()[0]) if stack.effect(name).affine]
    sides = ([name for name in possible if stack.effect(name).family == side] for side in SIDES)
    return [min(names, key=plainness) for names in sides if names]
