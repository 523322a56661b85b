"""What the laws of play operators share: their thresholds, and the box of these."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record
from hysteresis_plugins.models._data import input_span

RADIUS = Parameter(
    "radius",
    0.05,
    0.5,
    "{input}",
    "log",
    meaning="what the thresholds divide, at most the half range",
    positive=True,
)
SLOPE = "slope of each play's part of the output, once it moves"
"""What a weight in a density is."""
OWN_SHAPES = dict.fromkeys(("rayleigh-hysteresis", "play-bank"), "it is a sum of plays, as this law is but for a slope")
"""What more plays, or other weights, would do."""
NARROWEST = 0.05
"""Least radius in half ranges of the input."""


def radius_box(radius: Parameter, records: Sequence[Record], narrowest: float = NARROWEST) -> Parameter:
    """From a share of the half range of the input to all of it: a play that is wider never moved in the data to and
    fro, and what it does beyond them would be anybody's guess."""
    half = 0.5 * input_span(records)
    return radius.within(narrowest * half, half)


def thresholds(radius: Array, plays: int) -> Array:
    """0 and radius k / (plays + 1), (1 + plays, swarm): the largest is below the radius."""
    return np.arange(plays + 1)[:, None] * (radius / (plays + 1))


def named(prefix: str, count: int) -> tuple[str, ...]:
    return tuple(f"{prefix}{k}" for k in range(1, count + 1))


def at_least(name: str, value: int, least: int, most: int) -> None:
    """Raises ValueError for a number of operators that is out of reason."""
    if not least <= value <= most:
        raise ValueError(f"{name} = {value} must be from {least} to {most}.")
