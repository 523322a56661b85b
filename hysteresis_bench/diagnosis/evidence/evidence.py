"""What the data say before any effect is added: how loud the noise is, and whether memory is needed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.memory import Memory, memory
from hysteresis_bench.diagnosis.evidence.noise import Noise, pooled_noise, unresolved
from hysteresis_bench.diagnosis.evidence.noise_floor import floor_of
from hysteresis_bench.diagnosis.evidence.view import View, views_of
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class Evidence:
    """views : of the fitted records;  noise : pooled over them;  floor : RMS below which nothing is judged."""

    views: tuple[View, ...]
    noise: Noise
    floor: float
    memory: Memory

    @cached_property
    def unknown(self) -> float:
        """What the samples do not tell of the input, as an error of the output (RMS)."""
        return unresolved([view.record for view in self.views])

    @property
    def told(self) -> str:
        """The noise, and the floor where what is not known of the input is the larger part of it."""
        known = f"the noise is {self.noise.floor:.3g}"
        more = f", with what the samples do not tell of the input {self.floor:.3g}"
        return known + (more if self.unknown > self.noise.floor else "")

    def heard_anew(self, quieter: Sequence[Record]) -> Evidence:
        """With the noise of the same records without a disturbance that had passed for noise."""
        loud = pooled_noise([view.noise for view in views_of(quieter)])
        return replace(self, noise=loud, floor=floor_of(self.views, loud))

    def heard_beside(self, simulated: Sequence[Array]) -> Evidence:
        """With the noise of what a model leaves: what moves fast and is explained is none, such as what a controller
        feeds back.  simulated : every record, (scored samples,)"""
        views = tuple(view.heard_in(view.y - own) for view, own in zip(self.views, simulated, strict=True))
        loud = pooled_noise([view.noise for view in views])
        return replace(self, views=views, noise=loud, floor=floor_of(views, loud))


def gather(views: tuple[View, ...]) -> Evidence:
    """What the fitted records say before any model: noise, floor, memory."""
    loud = pooled_noise([view.noise for view in views])
    return Evidence(views, loud, floor_of(views, loud), memory(views))
