"""The inverse of linear dynamics along a trajectory that is known ahead: lags, creep, resonances, delays.

Least squares by conjugate gradients, LSQR [1], from the trajectory itself: what the dynamics pass is found first, what
they swallow stays as it was wanted. An exact inverse, sample by sample, has poles at the zeros of the sampled dynamics,
which lie on the negative axis near the unit circle, or beyond: it rings, or grows.

[1] C. C. Paige, M. A. Saunders, ACM Trans. Mathematical Software 8 (1982) 43.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.signals import INDEX, Signal

Response = Callable[[Array], Array]
"""(samples,) -> (samples,): linear, the same at every time, at rest with its first sample, of unit gain at rest."""

BEFORE, AFTER = "dynamics before the law", "dynamics after the law"
EXACT = 1e-11
"""Share of the trajectory's range at which the search ends."""
ITERATIONS = 300
"""At most."""
CONDITION = 100.0
"""Of the equations that are solved: beyond it only what rings is still gained."""
EVEN = 1e-6
"""Largest difference of two steps of time, as a share of a step, of samples that count as even."""


class Through(Model):
    """The input itself."""

    parameters = ()

    def simulate(self, signal: Signal, p: Any) -> Array:
        return signal.input


@dataclass(frozen=True, eq=False)
class Dynamics:
    """Linear dynamics in front of the law and behind it; the times of a trajectory must be even.

    before, after : a system each, of what acts there alone, and its values (dimension, 1);  names : of the effects
    """

    before: tuple[System, Array]
    after: tuple[System, Array]
    names: tuple[str, ...] = ()

    def output_for(self, time: Array, wanted: Array) -> Array:
        """What the law must make, (samples,), so that what stands behind it makes what is wanted."""
        return undone(_response(self.after, time), wanted)

    def input_for(self, time: Array, wanted: Array) -> Array:
        """What must go in, (samples,), so that the law gets what it needs."""
        return undone(_response(self.before, time), wanted)


def dynamics_of(fitted: FittedModel) -> Dynamics | None:
    """What a fitted model's effects do that are linear dynamics; None where there are none, or where it has no time."""
    if fitted.units.get("time") == INDEX:
        return None
    linear = [pair for pair in fitted.system.effects if pair[1].affine]
    kept = {family: tuple(pair for pair in linear if pair[1].family == family) for family in (BEFORE, AFTER)}
    names = tuple(name for pairs in kept.values() for name, _ in pairs)
    before, after = (part_of(fitted, Through(), pairs) for pairs in kept.values())
    return Dynamics(before, after, names) if names else None


def part_of(fitted: FittedModel, model: Model, effects: tuple[tuple[str, Effect], ...]) -> tuple[System, Array]:
    """A model with some of a fitted model's effects, and the values (dimension, 1) of its parameters."""
    whole = fitted.system
    own = {p.name for p in model.parameters}
    fixed = {key: x for key, x in whole.fixed.items() if key.rpartition(".")[0] in dict(effects) or key in own}
    system = replace(whole, model=model, effects=effects, fixed=fixed)
    value_of = dict(zip((p.name for p in whole.parameters), fitted.values, strict=True))
    return system, np.array([value_of[p.name] for p in system.parameters]).reshape(-1, 1)


def _response(part: tuple[System, Array], time: Array) -> Response:
    system, values = part
    return lambda x: system.simulate(Signal(time, np.ascontiguousarray(x[:, None])), values)[:, 0]


def is_even(time: Array) -> bool:
    """Whether all steps of time are alike, which the inverse takes for granted."""
    steps = np.diff(time)
    return bool(np.ptp(steps) <= EVEN * float(np.mean(steps)))


def undone(respond: Response, wanted: Array) -> Array:
    """What the dynamics turn into what is wanted, as nearly as the iterations get; both (samples,)."""
    from scipy.sparse.linalg import LinearOperator, lsqr

    span = float(np.ptp(wanted))
    missing = (wanted - respond(wanted))[1:]
    if wanted.size < 3 or float(np.max(np.abs(missing))) <= EXACT * span:
        return wanted

    def forward(correction: Array) -> Array:
        return respond(np.concatenate([[0.0], np.ravel(correction)]))[1:]

    def adjoint(error: Array) -> Array:
        return forward(np.ravel(error)[::-1])[::-1]

    operator = LinearOperator((missing.size, missing.size), matvec=forward, rmatvec=adjoint, dtype=float)
    near = EXACT * span / float(np.sqrt(np.mean(missing**2)))
    correction = lsqr(operator, missing, atol=0.0, btol=near, conlim=CONDITION, iter_lim=ITERATIONS)[0]
    found: Array = wanted + np.concatenate([[0.0], correction])
    return found
