"""A record prepared once: its noise, its turning points, what is scored. Every test and every search looks at this."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.noise import Noise, input_noise, noise, noise_left
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

    def heard_in(self, residuals: Array) -> View:
        """With the noise that is left beside a model.  residuals : (scored samples,)"""
        return replace(self, noise=noise_left(self.noise, self.record, residuals))

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
        return covariates.turning_points(self.record.input, self._resolution)

    @cached_property
    def noticed(self) -> Array:
        """The first sample, of each of `turns`, at which the input is seen to have turned there; int64[reversals]."""
        u, ends = self.record.input, [*self.turns[1:], self.record.input.size - 1]
        moved = (np.abs(u[turn : end + 1] - u[turn]) for turn, end in zip(self.turns, ends, strict=False))
        return self.turns + np.array([int(np.argmax(one > self._resolution)) for one in moved], dtype=np.int64)

    @cached_property
    def _resolution(self) -> float:
        u = self.record.input
        rms = input_noise(self.record.time, u) if self.record.history else self.noise.input_rms
        return covariates.resolution_of(u, rms)

    @cached_property
    def rates(self) -> tuple[Array, Array]:
        """Of the input, (scored samples,): around every sample, and up to it. In the first the noise of the output
        comes back, where a controller answers to it with the next sample; in the second lies the input's own noise."""
        before = np.diff(self.u) / np.diff(self.time)
        return np.gradient(self.u, self.time), np.concatenate([before[:1], before])

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
