"""Excitations left out of the fitted records: a system that predicts them worse than the bare model is given up."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.search.fallback import fall_back, unseen_rmse
from hysteresis_bench.signals import Record

TRUE = {"alpha": 0.3, "beta": 0.6, "gamma": 0.2, "d": 1.0}
TIME = np.linspace(0.0, 2.0, 300)


@pytest.fixture(scope="module")
def records():
    """Bouc-Wen; each record with a drift of its own, up in one and down in the other: what fits one misleads on the
    other."""
    model, rng = registry.build("models", "bouc-wen"), np.random.default_rng(2)
    names = type("Values", (), {name: np.array([value]) for name, value in TRUE.items()})()
    made = []
    for name, slope in (("up", 0.4), ("down", -0.4), ("level", 0.0)):
        drive = 4.0 * np.sin(2 * np.pi * TIME) * (1.0 - 0.2 * TIME)
        bare = Record(TIME, drive, None, name)
        output = model.simulate(bare.signal, names)[:, 0] + slope * TIME + 0.01 * rng.standard_normal(TIME.size)
        made.append(replace(bare, output=output))
    return made


def grown(fitter, *names):
    base = fitter.bare(frozenset({"record-offset"}))
    order, current = [], base
    for name in names:
        current = fitter.extended(current, name)
        order.append((name, current))
    return base, order


def test_what_misleads_on_a_record_left_out_is_dropped(records):
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), tuple(records[:2])))
    base, order = grown(fitter, "drift")
    found = fall_back(fitter, base, order)
    assert found is not None
    assert found.dropped == ("drift",)
    assert found.kept == found.bare < found.selected


def test_what_helps_stays(records):
    """Two records drift alike."""
    both = (records[0], replace(records[2], output=records[2].output + 0.4 * TIME))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), both))
    base, order = grown(fitter, "drift")
    assert unseen_rmse(fitter, order[-1][1]) < unseen_rmse(fitter, base)
    assert fall_back(fitter, base, order) is None


def test_with_one_record_nothing_can_be_left_out(records):
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), (records[0],)))
    base, order = grown(fitter, "drift")
    assert fall_back(fitter, base, order) is None
