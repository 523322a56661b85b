"""One hypothesis, fitted: a set of effects around the model, with its errors fitted and left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.parameters import Parameter

EDGE = 1e-3
"""A parameter within this share of its box from an edge lies at its bound."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """names : the effects;  values : by parameter's name, in units
    residuals, left_out : (scored samples,), measured minus simulated: of the fit, and of samples left out of it
    at_bound : parameters at an edge of their box that does not mean "off"
    """

    names: frozenset[str]
    values: Mapping[str, float]
    residuals: Array
    left_out: Array
    at_bound: tuple[str, ...]

    @property
    def rmse(self) -> float:
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def cv_rmse(self) -> float:
        return float(np.sqrt(np.mean(self.left_out**2)))

    def apart(self, other: Hypothesis) -> float:
        """RMS difference of the two fitted outputs, unit of the output."""
        return float(np.sqrt(np.mean((self.residuals - other.residuals) ** 2)))

    def heard_apart(self, other: Hypothesis, noise: float) -> float:
        """Standard errors by which samples with this noise (RMS, white) tell the two fitted systems apart: by the
        distance of their outputs, or by what one leaves less, the root of the logarithm of the likelihoods' ratio."""
        between = np.linalg.norm(self.residuals - other.residuals) ** 2
        less = abs(np.linalg.norm(self.residuals) ** 2 - np.linalg.norm(other.residuals) ** 2)
        return float(np.sqrt(max(between, less))) / noise if noise > 0.0 else np.inf


@dataclass(frozen=True, eq=False)
class Behind(Hypothesis):
    """Far behind what it was to come up to, and followed no further. In the place of its errors left out stand those of
    the fit: a lower bound, and already too large to be chosen."""


def at_bound(parameter: Parameter, x: float) -> bool:
    """Does it lie at an edge of its box that means neither "off" nor a limiting form?  x : in the unit interval"""
    if EDGE < x < 1.0 - EDGE:
        return False
    edge = parameter.lower if x <= EDGE else parameter.upper
    off = parameter.null is not None and (edge == parameter.null or (parameter.scaling == "log" and x <= EDGE))
    return not (off or edge == parameter.limit)
