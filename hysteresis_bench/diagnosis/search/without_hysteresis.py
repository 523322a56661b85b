"""A model whose hysteresis is switched off, for data that need none."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.search.systems import Stack
from hysteresis_bench.fit.least_squares import jacobian, values_of
from hysteresis_bench.signals import Record


def without_hysteresis(model: Model, records: Sequence[Record]) -> dict[str, float]:
    """Values at which the model has no hysteresis, by name: of the parameters with a null, and of those that
    change nothing then. Empty where the model's hysteresis cannot be switched off."""
    off = {parameter.name: parameter.null for parameter in model.parameters if parameter.null is not None}
    if not off:
        return {}
    problem = Stack(model, tuple(records), fixed=off).problem(())
    middle = np.full((problem.space.dimension, 1), 0.5)
    idle = ~np.any(jacobian(problem, middle)[1][:, 0, :], axis=0)
    values = values_of(problem, middle[:, 0])
    return {**off, **{name: values[name] for name, still in zip(problem.space.names, idle, strict=True) if still}}
