"""Excitations left out of the fitted records: what predicts them worse is given up, and what nothing can test."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.fallback import Fallback, fall_back, misleading, unseen_rmse
from hysteresis_bench.diagnosis.search.search import Found, with_fewer
from hysteresis_bench.diagnosis.search.selection import Selection
from hysteresis_bench.signals import Record

TRUE = {"alpha": 0.3, "beta": 0.6, "gamma": 0.2, "d": 1.0}
TIME = np.linspace(0.0, 2.0, 300)
NOISE = 0.01


@pytest.fixture(scope="module")
def records():
    """Bouc-Wen; each record with a drift of its own, up in one and down in the other: what fits one misleads on the
    other."""
    rng, made = np.random.default_rng(2), []
    for name, slope in (("up", 0.4), ("down", -0.4), ("level", 0.0)):
        drive = 4.0 * np.sin(2 * np.pi * TIME) * (1.0 - 0.2 * TIME)
        bare = Record(TIME, drive, None, name)
        output = bare_output(bare) + slope * TIME + NOISE * rng.standard_normal(TIME.size)
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
    found = fall_back(fitter, base, order, NOISE)
    assert found is not None
    assert found.dropped == ("drift",)
    assert found.kept == found.bare < found.selected


def test_what_helps_stays(records):
    """Two records drift alike."""
    both = (records[0], replace(records[2], output=records[2].output + 0.4 * TIME))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), both))
    base, order = grown(fitter, "drift")
    assert unseen_rmse(fitter, order[-1][1]) < unseen_rmse(fitter, base)
    assert fall_back(fitter, base, order, NOISE) is None


@pytest.mark.parametrize(("beyond", "gives_up"), [(3.0, False), (8.1, True)])
def test_an_excitation_on_which_any_law_runs_wild_counts_as_one(beyond, gives_up):
    """Three records are predicted twice as well with the effect, the one that goes beyond them worse."""
    number = np.repeat(np.arange(4), 50)

    def leaving(*errors):
        return Hypothesis(frozenset(), {}, np.zeros(200), np.repeat(errors, 50), ())

    together = SimpleNamespace(apart=(0, 1, 2, 3), number=number, only_one=False)
    fitter = SimpleNamespace(
        excitations=together, apart=lambda hypothesis: hypothesis.left_out, extrapolated=lambda hypothesis: frozenset()
    )
    bare, more = leaving(2.0, 2.0, 2.0, 5.0), leaving(1.0, 1.0, 1.0, 5.0 * beyond)
    assert unseen_rms(more) > unseen_rms(bare)
    assert (fall_back(fitter, bare, [("fatigue", more)], NOISE) is not None) == gives_up


def fading(name, cycles, amplitude):
    """Bouc-Wen; the output becomes smaller by a power of the cycles that have gone."""
    bare = Record(TIME, amplitude * np.sin(2 * np.pi * cycles * TIME / TIME[-1]), None, name)
    gone = cycles * TIME / TIME[-1]
    noise = NOISE * np.random.default_rng(cycles).standard_normal(TIME.size)
    return replace(bare, output=bare_output(bare) * (1.0 + gone) ** -0.1 + noise)


def test_the_record_with_the_longest_path_does_not_judge_the_curve_that_it_alone_determines():
    """Without it the curve ends anywhere: the other records are predicted at the noise."""
    records = (fading("short", 3, 4.0), fading("small", 3, 2.5), fading("long", 12, 4.0))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), records))
    base, order = grown(fitter, "gain-with-path")
    curve = order[-1][1]
    assert fitter.extrapolated(curve) == {2}
    assert not fitter.extrapolated(base)
    own = [np.sqrt(np.mean(fitter.apart(curve)[fitter.excitations.number == k] ** 2)) for k in range(3)]
    assert own[2] > 5.0 * max(own[:2])
    assert fall_back(fitter, base, order, NOISE) is None
    assert unseen_rmse(fitter, curve) < 0.3 * unseen_rmse(fitter, base)


def unseen_rms(hypothesis):
    return np.sqrt(np.mean(hypothesis.left_out**2))


def test_parts_of_a_lone_record_are_left_out(records):
    """Six cycles of one amplitude: every part of two holds one, and drifts as the others do."""
    time = np.linspace(0.0, 6.0, 900)
    bare = Record(time, 4.0 * np.sin(2 * np.pi * time), None, "six")
    fitter = lone(bare, bare_output(bare) + 0.1 * time)
    assert fitter.excitations.apart == (0, 1, 2)
    assert not fitter.excitations.varied
    base, order = grown(fitter, "drift")
    assert fall_back(fitter, base, order, NOISE) is None
    found = fall_back(fitter, order[-1][1], [("drift", base)], NOISE)
    assert found is not None
    assert found.tested
    assert found.kept < 0.5 * found.selected


def test_one_loop_leaves_nothing_out_and_names_nothing_far_from_the_noise():
    """A loop of a law with a bend, to which another law is fitted: an effect makes up for half of that."""
    loop = one_loop()
    fitter = lone(loop, np.tanh(0.8 * bare_output(loop)) + 0.15 * loop.input**3 / 64.0, "dahl")
    assert fitter.excitations.apart == ()
    base, order = grown(fitter, "saturation")
    left = order[-1][1].rmse
    assert left < 0.8 * base.rmse
    assert fall_back(fitter, base, order, left) is None
    assert fall_back(fitter, base, order, left / 1.9) is None
    found = fall_back(fitter, base, order, left / 2.1)
    assert found == Fallback(("saturation",), left, base.rmse, base.rmse, tested=False)


def test_what_may_stand_in_for_the_law_leaves_where_one_loop_cannot_tell():
    """Also where the noise is reached with it."""
    loop = one_loop()
    fitter = lone(loop, np.tanh(0.8 * bare_output(loop)) + 0.15 * loop.input**3 / 64.0, "dahl")
    base, order = grown(fitter, "saturation")
    best = order[-1][1]
    selection = Selection(fitter, Workers(fitter, 1), best.rmse, ("saturation",))
    found = Found(
        full=fitter,
        thin=fitter,
        evidence=None,
        selection=selection,
        base=base,
        best=best,
        final=best,
        follows=True,
        order=tuple(order),
        given_up=None,
        rivals={"saturation": {}},
        without={},
        beyond=selection.tried_on(best),
        impossible={},
    )
    fewer = with_fewer(found, ["saturation"])
    assert selection.adopted(fewer.best) == ()
    assert fewer.order == ()
    assert fewer.beyond.current is fewer.best  # what the table of candidates stands on
    assert fewer.given_up == Fallback(("saturation",), best.rmse, fewer.best.rmse, base.rmse, tested=False)


def test_what_makes_one_excitation_worse_leaves_though_it_helps_on_the_whole():
    """Two records drift much, the third, whose input is like theirs, as much the other way: for all three a drift makes
    it worse, and the sum better."""
    time = np.linspace(0.0, 2.0, 300)
    rng, made = np.random.default_rng(4), []
    for name, slope in (("first", 0.4), ("second", 0.4), ("third", 0.4), ("odd", -0.1)):
        bare = Record(time, 4.0 * np.sin(2 * np.pi * time), None, name)
        made.append(replace(bare, output=bare_output(bare) + slope * time + NOISE * rng.standard_normal(time.size)))
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), tuple(made)))
    base, order = grown(fitter, "drift")
    best = order[-1][1]
    assert fall_back(fitter, base, order, NOISE) is None
    found = misleading(fitter, base, best, {"drift": base}, NOISE)
    assert found is not None
    assert (found.dropped, found.worse_on) == (("drift",), ("odd",))
    assert found.selected < found.bare
    sound = Fitter(Stack(registry.build("models", "bouc-wen"), tuple(made[:3])))
    base, order = grown(sound, "drift")
    assert misleading(sound, base, order[-1][1], {"drift": base}, NOISE) is None


def test_an_excitation_beyond_all_others_accuses_nobody(records):
    """The odd one is half as large again: to predict it is to extrapolate."""
    drives = [
        replace(record, input=scale * record.input) for record, scale in zip(records, (1.0, 1.0, 1.5), strict=True)
    ]
    fitter = Fitter(Stack(registry.build("models", "bouc-wen"), tuple(drives)))
    assert fitter.excitations.inner == (0, 1)
    assert fitter.excitations.apart == (0, 1, 2)


def lone(record, output, model="bouc-wen"):
    rng = np.random.default_rng(3)
    measured = replace(record, output=output + NOISE * rng.standard_normal(output.size))
    return Fitter(Stack(registry.build("models", model), (measured,)))


def one_loop():
    """One period that had settled: the way there is simulated and not scored."""
    time = np.linspace(0.0, 2.0, 600)
    return Record(time, 4.0 * np.sin(2 * np.pi * time), None, "loop", history=300)


def bare_output(record):
    names = type("Values", (), {name: np.array([value]) for name, value in TRUE.items()})()
    return registry.build("models", "bouc-wen").simulate(record.signal, names)[:, 0]
