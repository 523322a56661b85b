"""Where no law of few parameters follows the data, a density takes its place, with the effects that it needs too."""

from types import SimpleNamespace as Of

import numpy as np
import pytest

from hysteresis_bench import DiagnosisOptions
from hysteresis_bench.diagnosis.around import concluded, searched
from hysteresis_bench.diagnosis.doubt.density import _better
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.whole import LeftOut
from hysteresis_bench.signals import Dataset, Record

NOISE, LAG = 0.002, 0.02
THRESHOLDS = np.linspace(-1.0, 1.0, 241)
UP, DOWN = (grid.ravel() for grid in np.meshgrid(THRESHOLDS, THRESHOLDS, indexing="ij"))
RELAYS = UP >= DOWN
UP, DOWN = UP[RELAYS], DOWN[RELAYS]


def density(half_width: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Two populations, one soft and one hard, shifted against each other: no law here has such a one."""
    soft = np.exp(-(((half_width - 0.12) / 0.06) ** 2) - ((centre + 0.15) / 0.15) ** 2)
    hard = 0.7 * np.exp(-(((half_width - 0.5) / 0.12) ** 2) - ((centre - 0.1) / 0.2) ** 2)
    return soft + hard


def relays(u: np.ndarray) -> np.ndarray:
    """Mayergoyz's sum of relays, each of which switches up at its upper threshold and down at its lower one."""
    weights = density((UP - DOWN) / 2, (UP + DOWN) / 2)
    weights, states, found = weights / weights.sum(), np.ones(UP.size), np.empty(u.size)
    for i, one in enumerate(u):
        states = np.where(one >= UP, 1.0, np.where(one <= DOWN, -1.0, states))
        found[i] = weights @ states
    return found


def curves() -> Dataset:
    """Reversal curves from saturation behind a lag, every third one held out."""
    records = []
    for k, reversal in enumerate(np.linspace(-0.9, 0.6, 16)):
        u = np.concatenate([np.linspace(1.0, reversal, 70), np.linspace(reversal, 1.0, 70)])
        time = 0.01 * np.arange(u.size)
        y = relays(u)
        for i in range(1, y.size):
            y[i] = y[i - 1] + (y[i] - y[i - 1]) * (1.0 - np.exp(-0.01 / LAG))
        y += NOISE * np.random.default_rng(k).standard_normal(u.size)
        records.append(Record(time, u, y, f"curve {k}", units={"time": "s", "input": "V", "output": "1"}))
    return Dataset(tuple(records), tuple(record.name for record in records[1::3]))


@pytest.mark.long
def test_a_density_takes_the_place_of_a_law_that_does_not_follow(names_only):
    with names_only():
        asked = Question("ferroelectric", among=("output-lag", "drift"), options=DiagnosisOptions(jobs=1))
        found = concluded(searched(curves(), asked), [], ["preisach-hats"])
    assert found.model_name == found.model.model == "preisach-hats"
    assert found.effects == ("output-lag",)
    assert found.after.held_out.rmse < 4.0 * NOISE  # the asked law leaves 9 times
    assert found.unseen < 6.0 * NOISE
    assert found.floor < found.ceiling.named < 6.0 * NOISE
    assert found.model.interval.half_widths[50] < 8.0 * NOISE


@pytest.mark.parametrize(
    ("own", "parameters", "like", "takes"),
    [
        (0.5, 80, True, True),
        (0.5, 80, False, False),  # so many parameters are not expected to do so elsewhere
        (0.5, 8, False, True),
        (0.9, 80, True, False),  # more than half of the excess remains
        (1.1, 80, True, False),
    ],
)
def test_a_density_has_to_do_clearly_better(own, parameters, like, takes):
    sign = (-1.0) ** np.arange(40) * (1.0 + 0.1 * np.sin(np.arange(40)))
    dense, law = Contender("preisach-hats", (), own * sign, parameters), Contender("dahl", (), sign, 5)
    blocks = Blocks(np.arange(40) // 2, np.zeros(40, dtype=int), 1)
    found = Of(thin=Of(blocks=blocks), selection=Of(floor=0.1))
    assert _better(dense, law, found, LeftOut(blocks, telling=True, like=like)) is takes
