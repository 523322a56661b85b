"""An effect beside which the law has no loop is no effect around it; one that adds to the law's loop is."""

from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.carrying import carrying
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis_study.hidden_effects import HiddenEffects
from hysteresis_bench.signals import joined


def fitted(law, hidden, name, draw):
    """Bouc-Wen with one effect, fitted to what a law and an effect made."""
    rig = HiddenEffects(model=law, effects=hidden, draw=draw)
    seen = joined(*(rig.measure(record, np.random.default_rng(k)) for k, record in enumerate(("slow", "nested"))))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), seen.records))
    found = fitter.bare(frozenset({registry.RECORD_OFFSET, name}))
    adopted = SimpleNamespace(adopted=lambda hypothesis: (name,))
    return SimpleNamespace(thin=fitter, final=found, selection=adopted)


@pytest.mark.parametrize(("name", "draw"), [("rayleigh-hysteresis", 33041), ("play-bank", 33042)])
def test_loops_of_another_law_are_carried_by_what_is_a_law_by_itself(name, draw):
    assert carrying(fitted("preisach", (), name, draw)) == (name,)


@pytest.mark.parametrize(
    ("hidden", "name"), [("rayleigh-hysteresis", "rayleigh-hysteresis"), ("backlash", "play-bank")]
)
def test_an_effect_leaves_the_law_its_loop(hidden, name):
    assert carrying(fitted("bouc-wen", (hidden,), name, 61)) == ()


def test_a_dead_band_alone_is_no_law():
    assert carrying(fitted("preisach", (), "backlash", 33042)) == ()


def test_what_carries_the_loop_is_not_held():
    doubt = Doubt(carrying=("play-bank",))
    assert doubt.holding(("creep", "play-bank")) == {"creep": ()}
    assert (doubt.raised, doubt.of_the_law) == (True, False)
    untested = Doubt(untested=True)
    assert (untested.raised, untested.of_the_law) == (True, True)
    assert not Doubt().raised


def test_beside_it_what_has_no_dynamics_may_be_the_shape_of_the_law():
    """As the one-sided dead zones of a modified Prandtl-Ishlinskii law were, which passed for a stop."""
    doubt = Doubt(carrying=("rayleigh-hysteresis",))
    assert doubt.holding(("creep", "rayleigh-hysteresis", "stop-above")) == {"creep": ()}
    assert Doubt().holding(("creep", "stop-above")) == {"creep": (), "stop-above": ()}
