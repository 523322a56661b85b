"""A controller on a plant, sample by sample: sensor read, voltage bounded and held until the next sample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, cast

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Plant
from hysteresis_bench.control.compensation import Compensation, Forward, Series, along
from hysteresis_bench.control.feed_forward import FeedForward
from hysteresis_bench.control.references import Reference
from hysteresis_bench.kernels.root_mean_square import rms


class Target(NamedTuple):
    """What the output should be, without the model's offset, with its two derivatives: now, or (samples,) of each."""

    position: Any
    velocity: Any
    acceleration: Any


class Controller(Protocol):
    """A feedback law that commands v, the input of the linear section; what it remembers goes in and out."""

    def nominal(self, wanted: Target) -> Any:
        """v where the output is what it should be: one number, or (samples,) of it."""

    def start(self) -> Any: ...

    def command(self, state: Any, target: Target, measured: float) -> tuple[float, Any]: ...

    def applied(self, state: Any, v: float, cut: bool) -> Any:
        """What is remembered once v went out; cut : the voltage limit changed it."""


@dataclass(frozen=True, eq=False)
class Run:
    """One closed loop; all arrays (samples,), the leading `reference.history` samples are not scored.

    voltage : applied from each sample on;  cut : where the limit changed it
    """

    reference: Reference
    displacement: Array
    measured: Array
    voltage: Array
    cut: Array

    @property
    def error(self) -> Array:
        """Reference minus true displacement, scored samples."""
        return (self.reference.position - self.displacement)[self.reference.history :]

    def scores(self) -> dict[str, float]:
        """t_error, t_rmse : largest and RMS tracking error, of the true displacement;  measured_rmse : as the
        sensor sees it;  total_variation : summed |change| of the voltage, and per second;  saturated_share :
        share of samples at the limit."""
        scored = slice(self.reference.history, None)
        variation = float(np.sum(np.abs(np.diff(self.voltage[scored]))))
        seen = (self.reference.position - self.measured)[scored]
        time = self.reference.time[scored]
        return {
            "t_error": float(np.max(np.abs(self.error))),
            "t_rmse": rms(self.error),
            "measured_rmse": rms(seen),
            "total_variation": variation,
            "variation_per_second": variation / float(time[-1] - time[0]),
            "saturated_share": float(np.mean(self.cut)),
        }


def track(
    plant: Plant,
    controller: Controller,
    forward: Forward,
    *,
    reference: Reference,
    limit: float,
    rng: Generator,
    series: bool = False,
) -> Run:
    """Follow a reference from rest; the reference's samples are the plant's intervals.

    limit : of the voltage, to either side
    series : the inverse, a FeedForward, runs on every commanded v, not along the reference; see `compensation`
    """
    samples = reference.time.size
    wanted = Target(reference.position - forward.offset, reference.velocity, reference.acceleration)
    compensation: Compensation = (
        Series(cast(FeedForward, forward)) if series else along(forward, controller.nominal(wanted), reference.time)
    )
    displacement, measured, voltage = np.empty(samples), np.empty(samples), np.empty(samples)
    cut = np.zeros(samples, dtype=bool)
    state, memory, carried = plant.rest(), controller.start(), compensation.start()
    for i, target in enumerate(np.column_stack(wanted).tolist()):
        displacement[i] = plant.displacement(state)
        measured[i] = plant.read(state, rng)
        v, memory = controller.command(memory, Target(*target), measured[i] - forward.offset)
        carried, sent = compensation.apply(carried, i, v, limit)
        voltage[i], cut[i] = sent.voltage, sent.cut
        memory = controller.applied(memory, sent.v, sent.cut)
        state = plant.step(state, sent.voltage)
    return Run(reference, displacement, measured, voltage, cut)
