"""A fitted model as a controller sees it: the inverse of its hysteresis, its linear section, its offset.

The compound structure of the PEA paper's Figure 12, as we read it: the inverse hysteresis stands in series before
the actuator, so that what is left between v (the output of the Bouc-Wen section) and the displacement is the linear
section; a feedback law commands v, and the inverse turns v into a voltage.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.control.inverse import BoucWenInverse, Point
from hysteresis_bench.control.linear_dynamics import Dynamics, dynamics_of, undone
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.preparation import AS_IT_IS, Preparation
from hysteresis_bench.registry import BOUC_WEN, HAMMERSTEIN
from hysteresis_bench.signals import Record

Part = TypeVar("Part")
INVERTIBLE = (BOUC_WEN, HAMMERSTEIN)


@dataclass(frozen=True)
class LinearSection:
    """G(s) = b / (s² + (c/m) s + k/m), from v to displacement. Raises ValueError where it is not stable.

    b, stiffness : 1/s²;  damping : 1/s
    """

    b: float
    damping: float
    stiffness: float

    def __post_init__(self) -> None:
        named = {"b": self.b, "c/m": self.damping, "k/m": self.stiffness}
        wrong = [f"{name} = {value:g}" for name, value in named.items() if not 0.0 < value < np.inf]
        if wrong:
            raise ValueError(f"The linear section is no stable stage: {', '.join(wrong)}; all must be above 0.")

    @property
    def gain(self) -> float:
        """Displacement at rest over v."""
        return self.b / self.stiffness

    def undone(self, time: Array, wanted: Array) -> Array:
        """The v, times the gain at rest, that makes the section follow, (samples,); time : even"""
        from hysteresis_bench.kernels.second_order import second_order

        damping, stiffness = np.array([self.damping]), np.array([self.stiffness])
        return undone(lambda x: second_order(time, x[:, None], damping, stiffness)[:, 0], wanted)

    def driven(self, position: Any, velocity: Any, acceleration: Any) -> Any:
        """The v that makes the section move so; numbers or arrays."""
        return (acceleration + self.damping * velocity + self.stiffness * position) / self.b


@dataclass(frozen=True)
class FeedForward:
    """The static inverse of a fitted model.

    offset : of the displacement, subtracted before anything else
    ignored : effects of the model that no inverse exists for; feedback has to deal with them
    dynamics : linear effects, which a trajectory's input undoes
    """

    hysteresis: BoucWenInverse
    linear: LinearSection | None = None
    offset: float = 0.0
    preparation: Preparation = AS_IT_IS
    ignored: tuple[str, ...] = ()
    dynamics: Dynamics | None = None

    @property
    def gain(self) -> float:
        """Displacement at rest over v."""
        return self.linear.gain if self.linear else 1.0

    def rest(self) -> Point:
        """Where the model is before anything happens: no input, no hysteresis."""
        return Point(self.preparation.seen_input(0.0), 0.0)

    def limited(self, point: Point, v: float, limit: float) -> tuple[Point, float, bool]:
        """One sample: the next point towards v, the actuator's input, and whether the limit cut it."""
        reached = self.hysteresis.towards(point, v)
        wanted = self.preparation.measured_input(reached.u)
        if abs(wanted) <= limit:
            return reached, wanted, False
        voltage = float(np.clip(wanted, -limit, limit))
        return self.hysteresis.moved(point, self.preparation.seen_input(voltage)), voltage, True

    def along(self, v: Array) -> tuple[Array, float]:
        """The model's input, (samples,), where its hysteresis makes v, and the slope of v over it at h = 0."""
        return self.hysteresis.input_for(v), self.hysteresis.d * (1.0 - self.hysteresis.alpha)

    def input_for(self, position: Array, limit: float = np.inf) -> tuple[Array, Array]:
        """The actuator's input that makes the static model follow a displacement, and where the limit cut it.

        position : (samples,) in the model's output unit -> two (samples,): input, and True where it is cut.
        The model begins with h = 0 at the first sample.
        """
        v = (np.asarray(position, dtype=float) - self.offset) / self.gain
        point = Point(v[0] / self.hysteresis.d, 0.0)
        voltage, cut = np.empty(v.size), np.zeros(v.size, dtype=bool)
        for i, wanted in enumerate(v):
            point, voltage[i], cut[i] = self.limited(point, wanted, limit)
        return voltage, cut


def feed_forward(fitted: FittedModel) -> FeedForward:
    """The inverse of a fitted model. Raises ValueError saying why there is none."""
    if fitted.model not in INVERTIBLE:
        raise ValueError(f"no inverse of the model {fitted.model} is known; only of {' and '.join(INVERTIBLE)}.")
    p = {**fitted.fixed, **{name: estimate.value for name, estimate in fitted.parameters.items()}}
    faults: list[str] = []
    hysteresis = _or_fault(
        faults, BoucWenInverse, p["alpha"], p["beta"], p["gamma"], p["d"], float(fitted.settings.get("n", 1.0))
    )
    linear = None
    if fitted.model == HAMMERSTEIN:
        linear = _or_fault(faults, LinearSection, p["b"], p["c_over_m"], p["k_over_m"])
    if hysteresis is None or faults:
        raise ValueError(" ".join(faults))
    system, still = fitted.system, Record(np.arange(2.0), np.zeros(2), None, units=fitted.units)
    offset = float(sum(np.ravel(each)[0] for each in system.offsets(still, fitted.values[:, None])))
    dynamics = dynamics_of(fitted)
    known = dynamics.names if dynamics else ()
    ignored = tuple(
        name for name, effect in system.effects if type(effect).offset is Effect.offset and name not in known
    )
    return FeedForward(hysteresis, linear, offset, fitted.preparation, ignored, dynamics)


def _or_fault(faults: list[str], build: Callable[..., Part], *arguments: float) -> Part | None:
    """What is built, or None with its fault noted."""
    try:
        return build(*arguments)
    except ValueError as error:
        faults.append(str(error))
        return None
