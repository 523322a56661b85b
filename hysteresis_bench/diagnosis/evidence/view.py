"""A record prepared once: its noise, its turning points, what is scored. Every test and every search looks at this."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.noise import Noise, fast_noise, noise
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class View:
    """A record and its noise; all else follows and is computed when it is first asked for.

    time, u, y : (scored samples,);  turns : samples of the whole record, history included, at which the input turns
    """

    record: Record
    noise: Noise

    @classmethod
    def of(cls, record: Record) -> View:
        """Raises ValueError where the record has no output."""
        return cls(record, noise(record))

    @property
    def time(self) -> Array:
        return self.record.time[self.record.scored]

    @property
    def u(self) -> Array:
        return self.record.input[self.record.scored]

    @property
    def y(self) -> Array:
        return self.record.measured

    @cached_property
    def turns(self) -> Array:
        u = self.record.input
        rms = fast_noise(self.record.time, u)[0] if self.record.history else self.noise.input_rms
        return covariates.turning_points(u, covariates.resolution_of(u, rms))

    @cached_property
    def rate(self) -> Array:
        """Of the input, (scored samples,)."""
        return np.gradient(self.u, self.time)

    @property
    def step(self) -> float:
        return float(np.mean(np.diff(self.time)))

    @property
    def even(self) -> bool:
        """Evenly sampled?"""
        return bool(np.ptp(np.diff(self.time)) < 0.01 * self.step)


def views_of(records: Sequence[Record]) -> tuple[View, ...]:
    """Raises ValueError where a record has no output."""
    return tuple(View.of(record) for record in records)
