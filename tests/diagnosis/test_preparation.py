"""How often a closed loop is repeated before it is scored, against the transient in closed form."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.preparation import passes_to_close
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.fit.settling import CLOSED
from hysteresis_bench.signals import Dataset, Record

TIME = np.arange(200) / 200.0
SINE = np.sin(2 * np.pi * TIME)


def test_a_bouc_wen_loop_closes_at_once():
    model = registry.build("models", "bouc-wen")
    twice = Record(np.arange(400) / 200.0, 4.0 * np.tile(SINE, 2), None)
    values = np.array([[0.3], [0.6], [0.2], [1.0]])
    output = System(model).simulate(twice.signal, values)[200:, 0]
    dataset = Dataset((Record(TIME, 4.0 * SINE, output),))
    assert passes_to_close(model, dataset, Question("bouc-wen")) == 2


def needed(share, constant):
    """Passes of the sine until y = (1 - share) x + share z, constant z' + z = x, z(0) = x(0), repeats itself.

    z = a sine behind x, and C exp(-t / constant): two passes differ most at their first sample.
    """
    turn = 2 * np.pi * constant
    start = turn / (1.0 + turn**2)  # of the sine behind x, below 0
    height = 2.0 * abs(1.0 - share + share / (1.0 + 1j * turn))
    passes = 2
    while share * start * np.exp(-(passes - 1) / constant) * (1.0 - np.exp(-1.0 / constant)) / height > CLOSED:
        passes *= 2
    return passes


@pytest.mark.parametrize(("share", "constant", "passes"), [(0.4, 0.1, 2), (0.4, 0.6, 4), (0.4, 1.3, 8), (0.6, 4.0, 16)])
def test_what_settles_slowly_is_repeated_until_it_does(share, constant, passes):
    assert needed(share, constant) == passes
    fixed = {"alpha": 0.0, "beta": 1.0, "gamma": 0.0}
    fixed |= {"creep.share": share, "creep.time_constant": constant, "creep.decades": 0.0}
    dataset = Dataset((Record(TIME, SINE, 2.0 * SINE),))
    model = registry.build("models", "bouc-wen")
    assert passes_to_close(model, dataset, Question("bouc-wen", ("creep",), fixed=fixed)) == passes
