"""Why two effects can look the same: the physics of a tie, in words."""

from __future__ import annotations

from dataclasses import dataclass

from hysteresis_bench import registry

GENERIC = "on these records both change the output in the same way, within the noise"


@dataclass(frozen=True)
class Tie:
    """An adopted effect, one that would do as well in its place, and why.

    apart : RMS difference of the two fitted outputs, unit of the output
    """

    effect: str
    rival: str
    reason: str
    apart: float


def tie(effect: str, rival: str, apart: float) -> Tie:
    """With the physical reason where one of the two declares it."""
    one, other = registry.effect(effect).mistaken_for, registry.effect(rival).mistaken_for
    return Tie(effect, rival, one.get(rival) or other.get(effect) or GENERIC, apart)
