"""The input that makes a fitted model follow a user's own trajectory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.compensation import Forward
from hysteresis_bench.control.trajectories.driven import Driven, drive
from hysteresis_bench.data.units import frequency_in
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.settling import is_closed
from hysteresis_bench.fit.unseen.excited import FREQUENCY, excited, unlike
from hysteresis_bench.signals import Dataset, Record


@dataclass(frozen=True, eq=False)
class Followed:
    """time, input, output : (samples,) in the model's units;  cut : where the limit changed the input
    reached : (samples,) what the whole model answers;  notes : what was done to the trajectory, a sentence each"""

    time: Array
    input: Array
    output: Array
    cut: Array
    reached: Array
    notes: tuple[str, ...]

    @property
    def left(self) -> float:
        """The largest error that the model leaves where nothing is cut, as a share of the trajectory's range."""
        return self._largest(~self.cut)

    @property
    def missed(self) -> float:
        """The same of all samples."""
        return self._largest(np.ones_like(self.cut))

    def _largest(self, of: Array) -> float:
        error = np.abs(self.reached - self.output)[of]
        return float(np.max(error, initial=0.0)) / (float(np.ptp(self.output)) or 1.0)


def follow(fitted: FittedModel, forward: Forward, trajectory: Dataset, *, limit: float = np.inf) -> Followed:
    """The input for a trajectory, prepared as the fit's records were.

    trajectory : one record, of which the wanted output stands in `input` as in `output`, in the model's units
    limit : of the input, to either side
    Raises ValueError where no input is found.
    """
    (record,) = trajectory.records
    passes = fitted.preparation.settle if is_closed(record) else 0
    settled = record.settled(passes) if passes else record
    assert settled.output is not None
    driven = drive(fitted, forward, settled.time, settled.output, limit)
    needed, reached, cut = (each[-record.time.size :] for each in (driven.input, driven.reached, driven.cut))
    notes = (*trajectory.notes, *fitted.preparation.words([record], fitted.units["time"]))
    return Followed(
        record.time, needed, record.measured, cut, reached, (*notes, *_told(driven), *_beyond(fitted, record, needed))
    )


def _beyond(fitted: FittedModel, record: Record, needed: Array) -> Iterator[str]:
    """What the fit cannot vouch for; needed : (samples,) input for the record's output"""
    low, high = fitted.data.get("ranges", {}).get("input", (-np.inf, np.inf))
    room = 1e-6 * (high - low) if np.isfinite(high - low) else 0.0
    share = float(np.mean((needed < low - room) | (needed > high + room)))
    if share > 0.0:
        yield (
            f"{100.0 * share:.2g} % of the samples need an input beyond the fitted ones ({low:.4g} to {high:.4g}): "
            "there the model guesses."
        )
    known, own = fitted.data.get("excited") or {}, excited([replace(record, input=needed)])
    if rate := [word for word in unlike(known, own) if word in ("slower", "faster")]:
        (low, high), (least, most) = known[FREQUENCY], own[FREQUENCY]
        yield (
            f"The input turns {' and '.join(rate)} than the fitted ones: {least:.3g} to "
            f"{frequency_in(fitted.units['time'], most)}, fitted {low:.3g} to {high:.3g}. Where the device knows "
            "a rate, the model guesses."
        )


def _told(driven: Driven) -> Iterator[str]:
    if driven.undone:
        yield f"undone ahead: {', '.join(driven.undone)}; the trajectory must be known before it begins."
    if driven.ignored:
        yield f"not inverted: {', '.join(driven.ignored)}."
