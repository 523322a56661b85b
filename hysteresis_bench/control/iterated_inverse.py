"""The inverse of any law whose output rises with its input: a trajectory's input by successive correction.

    u <- u + (wanted - y(u)) / M,    M the steepest slope that the law has been seen to have

Where every branch rises, with slopes from m to M, the error of a sample falls at least by 1 - m/M an iteration once the
samples before it are right: the map is a contraction of causal operators [1]. Ours: M is measured on a ramp that spans
the wanted range, and doubled wherever the error grows, or does not fall any more.

[1] C. A. Desoer, M. Vidyasagar, Feedback Systems: Input-Output Properties, Academic Press (1975), chapter 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Effect
from hysteresis_bench.control.linear_dynamics import Dynamics, dynamics_of, part_of
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.signals import Record

EXACT = 1e-10
"""Largest error that is left, as a share of the wanted range."""
CLOSE = 1e-3
"""What is left after all iterations that is still an inverse: where the output hardly moves, as within a clearance."""
ITERATIONS = 20_000
"""At most; then `CLOSE` decides."""
IDLE = 100
"""Iterations without a smaller error after which the slope is taken to be too small: they go round in a circle."""
RAMP = 400
"""Samples of the ramp on which the slope is measured."""
STEEPER = 1.5
"""Minor loops may be steeper than the ramp."""
DECADES = range(-12, 13)
"""Of the input, in which the ramp is sought that spans the wanted range."""
STATIC = ("law", "curve beside the law", "curve of the input", "curve of the output")
"""Families of effects that know no time: they are inverted with the law."""


@dataclass(frozen=True, eq=False)
class IteratedInverse:
    """What `follow` asks of a feed-forward.

    system : the law with the effects that know no time;  values : (dimension,) of it
    ignored : effects that are left to feedback;  dynamics : linear ones, which a trajectory's input undoes
    """

    system: System
    values: Array
    preparation: Preparation
    ignored: tuple[str, ...] = ()
    dynamics: Dynamics | None = None
    linear: ClassVar[None] = None
    gain: ClassVar[float] = 1.0
    offset: ClassVar[float] = 0.0

    def input_for(self, position: Array, limit: float = np.inf) -> tuple[Array, Array]:
        """The actuator's input that makes the law follow a displacement, and where the limit cut it.

        position : (samples,) in the model's output unit -> two (samples,): input, and True where it is cut.
        Raises ValueError where no input is found: the law saturates below what is wanted, or its output does not rise
        with the input everywhere.
        """
        wanted = np.asarray(position, dtype=float)
        span = float(np.ptp(wanted)) or float(np.max(np.abs(wanted))) or 1.0
        steepest = STEEPER * self._steepest(wanted, span)
        u, best, idle = np.zeros(wanted.size), np.inf, 0
        kept = (u, wanted - self._output(u))
        for _ in range(ITERATIONS):
            left = wanted - self._output(u)
            cut = np.abs(self.preparation.measured_input(u)) >= limit
            error = float(np.max(np.abs(left[~cut]), initial=0.0))
            if error <= EXACT * span:
                return self.preparation.measured_input(u), cut
            idle += 1
            if error < best or not np.isfinite(best):
                best, kept, idle = error, (u, left), 0
            elif error > 2.0 * best or idle > IDLE:
                steepest, idle = 2.0 * steepest, 0
                u, left = kept
            u = self._limited(u + left / steepest, limit)
        if best <= CLOSE * span:
            found = self.preparation.measured_input(kept[0])
            return found, np.abs(found) >= limit
        raise ValueError(
            f"no input was found that makes the model follow the reference: {best / span:.2g} of its range is left. "
            "The law may saturate, or its output may fall where the input rises."
        )

    def along(self, v: Array) -> tuple[Array, float]:
        """The model's input, (samples,), where the law makes v, and the mean slope of v over it."""
        u = self.preparation.seen_input(self.input_for(v)[0])
        return u, float(np.ptp(v)) / (float(np.ptp(u)) or 1.0)

    def _limited(self, u: Array, limit: float) -> Array:
        if np.isinf(limit):
            return u
        return self.preparation.seen_input(np.clip(self.preparation.measured_input(u), -limit, limit))

    def _output(self, u: Array, step: float = 1.0) -> Array:
        record = Record(step * np.arange(float(u.size)), u, None)
        return self.system.respond(record, self.values[:, None])[:, 0]

    def _steepest(self, wanted: Array, span: float) -> float:
        """Slope of the law with the largest modulus on a ramp either way, of the decade that spans what is wanted."""
        need = 1.05 * max(float(np.max(np.abs(wanted))), span)
        for decade in DECADES:
            ramps = [np.linspace(0.0, end, RAMP) for end in (10.0**decade, -(10.0**decade))]
            answers = [self._output(ramp) for ramp in ramps]
            slower, least = self._output(ramps[0], 1e-3), 1e-9 * float(np.max(np.abs(answers[0])))
            if not np.allclose(answers[0], slower, rtol=1e-6, atol=least, equal_nan=True):
                raise ValueError("No inverse: the law depends on the rate of its input.")
            reached = max(float(np.max(np.abs(answer - answer[0]))) for answer in answers)
            if np.isfinite(reached) and reached >= need:
                slopes = np.concatenate([np.gradient(y, u) for y, u in zip(answers, ramps, strict=True)])
                steepest = float(slopes[np.argmax(np.abs(slopes))])
                if steepest < 0.0:
                    raise ValueError("No inverse: the output falls where the input rises.")
                return steepest
        raise ValueError(f"No inverse: the model does not reach {need:.4g}, however large its input.")


def iterated_inverse(fitted: FittedModel) -> IteratedInverse:
    """The static part of a fitted model, to be inverted; its offsets stay in it."""
    system, dynamics = fitted.system, dynamics_of(fitted)
    kept = tuple(pair for pair in system.effects if _kept(pair[1]))
    static, values = part_of(fitted, system.model, kept)
    known = {*dict(kept), *(dynamics.names if dynamics else ())}
    ignored = tuple(name for name, _ in system.effects if name not in known)
    return IteratedInverse(static, values[:, 0], fitted.preparation, ignored, dynamics)


def _kept(effect: Effect) -> bool:
    return effect.family in STATIC or type(effect).offset is not Effect.offset
