"""What the data say before any effect is added: how loud the noise is, and whether memory is needed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.diagnosis.evidence.memory import Memory, memory
from hysteresis_bench.diagnosis.evidence.noise import Noise, pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import floor_of
from hysteresis_bench.diagnosis.evidence.view import View, views_of
from hysteresis_bench.signals import Record

TELLING = 0.2
"""Of the floor, from where the error of a law's steps from sample to sample raises it, by 2 % or more, and is told."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """views : of the fitted records;  noise : pooled over them;  floor : RMS below which nothing is judged
    steps : the part of the floor that is the law's own, which is integrated from sample to sample; 0 where it is small
    """

    views: tuple[View, ...]
    noise: Noise
    floor: float
    memory: Memory
    steps: float = 0.0

    def heard_anew(self, quieter: Sequence[Record]) -> Evidence:
        """With the noise of the same records without a disturbance that had passed for noise."""
        loud = pooled_noise([view.noise for view in views_of(quieter)])
        return replace(self, noise=loud, floor=float(np.hypot(floor_of(self.views, loud), self.steps)))

    def stepped(self, error: float) -> Evidence:
        """With the floor raised by the error of a law's steps from sample to sample (RMS)."""
        if error <= TELLING * self.floor:
            return self
        return replace(self, floor=float(np.hypot(self.floor, error)), steps=error)


def gather(views: tuple[View, ...]) -> Evidence:
    """Of the fitted records."""
    loud = pooled_noise([view.noise for view in views])
    return Evidence(views, loud, floor_of(views, loud), memory(views))
