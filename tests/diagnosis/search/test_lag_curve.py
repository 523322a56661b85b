"""A lag that is slower down than up, which no lag and no spectrum of lags can be, is told as a curve of the rate."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.free_forms import with_free_forms
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.signals import joined
from hysteresis_plugins.effects import input_lag, output_lag

pytestmark = pytest.mark.long

HIDDEN = {"output-lag": output_lag, "input-lag": input_lag}
LAGS = ("input-lag", "output-lag", "transport-delay", "asymmetry")


@pytest.fixture(scope="module", params=HIDDEN)
def asked(request):
    """What hides it, the selection among lags, and what it ends with."""
    rig = HiddenEffects(effects=(request.param,), draw=1, other=True)
    assert rig._form(request.param) is HIDDEN[request.param]._slower_down
    seen = joined(*(rig.measure(name, np.random.default_rng(k)) for k, name in enumerate(("slow", "fast", "nested"))))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), seen.records))
    with Workers(fitter, jobs=1) as workers:
        selection = Selection(fitter, workers, seen.hidden["noise"], LAGS)
        named = selection.named(selection.run(fitter.bare(frozenset({registry.RECORD_OFFSET}))))
        return request.param, selection, with_free_forms(selection, named), named


def test_the_curve_is_told_or_tied(asked):
    hidden, selection, freed, named = asked
    assert named.rmse > 1.3 * selection.floor
    (name,) = selection.adopted(freed)
    told = {name, *selection.rivals(freed, name)}
    assert {"output-lag": "lag-curve-after", "input-lag": "lag-curve-before"}[hidden] in told
    assert told <= {"lag-curve-after", "lag-curve-before"}
    assert freed.rmse < 1.05 * selection.floor


def test_the_curve_has_the_true_time_constants(asked):
    _, selection, freed, _ = asked
    (name,) = selection.adopted(freed)
    falling, rising = (freed.values[f"{name}.{way}"] for way in ("falling", "rising"))
    assert falling / rising == pytest.approx(1.4 / 0.6, rel=0.15)
