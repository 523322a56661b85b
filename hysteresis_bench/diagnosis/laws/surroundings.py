"""What a law is ranked with where effects will be sought around it.

In rounds, while all laws stay far from the noise: drifts and relaxations; curves of the input, of the output and beside
the law, plays, and linear dynamics that overshoot; the other free forms.
"""

from __future__ import annotations

from collections.abc import Iterator

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.free_forms import FreeForm

SIDES = ("dynamics before the law", "dynamics after the law")
SHAPES = ("curve of the input", "curve of the output", "curve beside the law", "damping beside the law", "law")
"""Families of free forms that are put around a law: its linear dynamics on either side, and what bends it."""


def drifts(stack: Stack) -> list[str]:
    """What is estimated anew on every record beside its offset, and describes no effect."""
    names = [name for name in registry.usable("effects") if name not in registry.OFFSETS]
    effects = {name: stack.effect(name) for name in names}
    asked = {name: one for name, one in effects.items() if one.nuisance and one.estimates}
    return [name for name, effect in asked.items() if not effect.inapplicable(stack.records)]


def linear_dynamics(stack: Stack) -> list[str]:
    """For either side of the law the free form that has coefficients alone, as many laws are asked; or else, as at one
    frequency, the formulas of what it is made of."""
    found = []
    for side in SIDES:
        names = [name for name in _linear(stack) if stack.effect(name).family == side]
        free = [name for name in names if isinstance(form := stack.effect(name), FreeForm) and _quick(form)]
        found += free or [name for name in names if stack.effect(name).relaxes]
    return found


def curves(stack: Stack) -> list[str]:
    """Free curves of input and output, free plays, and formulas of linear dynamics that no relaxations make up."""
    free = [name for name in stack.free_forms() if stack.effect(name).family in SHAPES]
    known = {*stack.free_forms(), *linear_dynamics(stack)}
    return [*free, *(name for name in _linear(stack) if name not in known and not stack.effect(name).relaxes)]


def changes(stack: Stack) -> list[str]:
    """The free forms of all other families."""
    known = {*SIDES, *SHAPES}
    return [name for name in stack.free_forms() if stack.effect(name).family not in known]


def _quick(form: FreeForm) -> bool:
    """Has it coefficients alone, but for the range of the data? Then one start will do."""
    return all(one.null is not None or one.name in form.ranges for one in form.parameters)


def _linear(stack: Stack) -> Iterator[str]:
    names = (*stack.free_forms(), *stack.candidates()[0])
    return (name for name in names if stack.effect(name).affine and stack.effect(name).family in SIDES)
