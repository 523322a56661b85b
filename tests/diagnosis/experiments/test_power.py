"""The power in closed form against that of repeated records, for two laws in which everything is linear."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.experiments.power import Fitted, Left, told_apart
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.unseen.advantage import CLEAR
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record

NOISE = 0.5
U = np.linspace(-1.0, 1.0, 60)
OLD, NEW = (Record(np.arange(60.0), u, np.zeros(60)) for u in (0.3 * U, U))


@dataclass(frozen=True)
class Powers(Model):
    """A gain times the input, or its third power, and a slope that both have."""

    power: int = 1
    parameters: ClassVar[tuple[Parameter, ...]] = (
        Parameter("gain", -50.0, 50.0, unit="1", meaning="of the power"),
        Parameter("level", -50.0, 50.0, unit="1", meaning="of a constant"),
    )

    def simulate(self, signal, p):
        return p.gain * signal.input**self.power + p.level


def fitted(power, gain):
    system = System(Powers(power))
    return Fitted(Problem(system, (OLD,), Space(system.parameters), LOSSES["rmse"]), np.array([gain, 0.0]))


def test_alike_systems_cannot_be_told_apart_and_unlike_ones_can():
    linear = fitted(1, 1.0)
    assert told_apart(linear, linear, NEW, Left(NOISE)) == 0.0
    assert told_apart(linear, fitted(3, 8.0), NEW, Left(1e-3)) > 0.99


def test_the_power_is_that_of_repeated_records():
    """Parameters are drawn from what the old record leaves open, records are made, and the test is made on each."""
    one, other = fitted(1, 0.7), fitted(3, 7.0)
    rng, counts = np.random.default_rng(0), []
    designs = [[np.column_stack([record.input**n, np.ones(60)]) for record in (OLD, NEW)] for n in (1, 3)]
    box = 12.0 * np.eye(2) / 100.0**2  # in units: the box is 100 wide
    spread = [np.linalg.inv(old.T @ old / NOISE**2 + box) for old, _ in designs]
    covariances = [NOISE**2 * np.eye(60) + new @ c @ new.T for (_, new), c in zip(designs, spread, strict=True)]
    means = [new @ np.array([gain, 0.0]) for (_, new), gain in zip(designs, (0.7, 7.0), strict=True)]
    for true, wrong in ((0, 1), (1, 0)):
        w = np.linalg.solve(covariances[wrong], means[true] - means[wrong])
        made = rng.multivariate_normal(means[true], covariances[true], size=20_000)
        counts.append(np.mean((made - means[wrong]) @ w / np.sqrt(w @ covariances[wrong] @ w) > CLEAR))
    assert 0.05 < np.mean(counts) < 0.95
    assert told_apart(one, other, NEW, Left(NOISE)) == pytest.approx(np.mean(counts), abs=0.01)


def test_correlated_noise_and_a_richer_rival_make_it_less_probable():
    one, other = fitted(1, 0.7), fitted(3, 7.0)
    known = told_apart(one, other, NEW, Left(NOISE))
    assert told_apart(one, other, NEW, Left(NOISE, share=0.2)) < known
    many = replace(one, weight=1000.0), replace(other, weight=1000.0)
    richer = System(Powers(3), (("bias", registry.build("effects", "bias")),))
    space = Space(richer.box((OLD,)))
    beside = Fitted(Problem(richer, (OLD,), space, LOSSES["rmse"]), np.array([7.0, 0.0, 0.0]), 1000.0)
    assert told_apart(many[0], beside, NEW, Left(NOISE)) < told_apart(*many, NEW, Left(NOISE)) - 0.2
