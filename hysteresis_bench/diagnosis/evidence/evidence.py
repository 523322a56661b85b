"""What the data say before any effect is added: how loud the noise is, and whether memory is needed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from hysteresis_bench.diagnosis.evidence.memory import Memory, memory
from hysteresis_bench.diagnosis.evidence.noise import Noise, pooled_noise
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

    def heard_anew(self, quieter: Sequence[Record]) -> Evidence:
        """With the noise of the same records without a disturbance that had passed for noise."""
        loud = pooled_noise([view.noise for view in views_of(quieter)])
        return replace(self, noise=loud, floor=floor_of(self.views, loud))

    def at_most(self, rmse: float) -> Evidence:
        """With a floor no higher than what a fitted model leaves: what it explains is no noise, and something fast that
        it does not explain, such as a hum, may still have passed for some."""
        silent = replace(self.noise, rms=0.0, through_input=0.0)
        return replace(self, floor=min(self.floor, max(rmse, floor_of(self.views, silent))))


def gather(views: tuple[View, ...]) -> Evidence:
    """Of the fitted records."""
    loud = pooled_noise([view.noise for view in views])
    return Evidence(views, loud, floor_of(views, loud), memory(views))
