"""Hand-made hypotheses on a fitter that looks fits up instead of running them."""

from types import SimpleNamespace

import numpy as np

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.nested_test import NestedTest
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.fit.unseen.blocks import Blocks

FLOOR = 0.1
WAVE = np.sqrt(2.0) * np.sin(2 * np.pi * np.arange(480) / 10)
ASIDE = np.sqrt(2.0) * np.cos(2 * np.pi * np.arange(480) / 10)
BLOCKS = Blocks(np.arange(480) // 10, np.arange(480) // 10 % 4, 4)


def fit(names, rmse, wave=WAVE):
    """Residuals of one shape, of which every block gains alike: any difference is significant."""
    values = dict.fromkeys(names, 1.0)
    return Hypothesis(frozenset(names), values, rmse * wave, rmse * wave, ())


def selection_of(*fits, floor=FLOOR, candidates="abcd"):
    """Every question is answered by the fit of the system that it asks for; the workers keeps what it was asked."""
    book, asked = {hypothesis.names: hypothesis for hypothesis in fits}, []

    def answers(questions):
        asked.extend(questions)
        changed = {
            "extended": lambda t, name, *_: t.names | {name},
            "reduced": lambda t, name: t.names - {name},
            "refitted": lambda t: t.names,
        }
        return [book[frozenset(changed[method](*rest))] for method, *rest in questions]

    fitter = SimpleNamespace(
        blocks=BLOCKS,
        stack=SimpleNamespace(model=SimpleNamespace(offers={}), effect=lambda name: SimpleNamespace(estimates=False)),
        test=lambda smaller, larger: NestedTest(1e3, 1e-12, 1),
        refitted=lambda hypothesis: hypothesis,
        drowned=lambda hypothesis, name: False,
    )
    return Selection(fitter, SimpleNamespace(map=answers, asked=asked), floor, tuple(candidates))


def leaving(excess, floor=FLOOR):
    """The RMSE with this mean square over the noise."""
    return float(np.sqrt(floor**2 + excess))
