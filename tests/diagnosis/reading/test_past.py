"""What came before a record is estimated from what the device remembers of it."""

import importlib
from itertools import pairwise
from types import SimpleNamespace as Of

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.reading.past import begun, pasts, with_past, with_pasts
from hysteresis_bench.signals import Dataset, Record

diagnosing = importlib.import_module("hysteresis_bench.diagnosis.around")

PLAYS = np.array([0.3, 0.8, 1.5, 2.5])
"""Half-widths; the device is the sum of its input and of these plays, by their definition."""

LEG = 60
"""Samples from one turning point to the next."""


class SumOfPlays:
    """A model: every simulation begins at rest."""

    parameters, offers = (), ()

    def simulate(self, signal, p):
        y, states = np.empty_like(signal.input), np.zeros((PLAYS.size, signal.input.shape[1]))
        for k, now in enumerate(signal.input):
            states = np.minimum(np.maximum(states, now - PLAYS[:, None]), now + PLAYS[:, None])
            y[k] = now + states.sum(axis=0)
        return y


DEVICE, VALUES = System(SumOfPlays()), np.empty(0)


def way(*stops):
    return np.concatenate([np.linspace(a, b, LEG, endpoint=False) for a, b in pairwise(stops)])


def measured(name, before, after):
    """Of the whole, from rest, what begins a third of a way after the last turning point `before`."""
    u = way(0.0, *before, *after)
    whole = Record(0.01 * np.arange(u.size), u, np.zeros(u.size), name)
    output = DEVICE.respond(whole, VALUES[:, None])[:, 0]
    begin = LEG * len(before) + LEG // 3
    return Record(whole.time[begin:], u[begin:], output[begin:], name)


def left(record):
    error = record.measured - DEVICE.respond(record, VALUES[:, None])[record.scored, 0]
    return float(np.sqrt(np.mean(error**2)))


@pytest.mark.parametrize("before", [(4.0,), (-4.0, 3.0), (2.0, -3.5, 1.0), (3.0, -2.5, 2.0, -1.0)])
def test_two_turning_points_stand_for_any_past(before):
    """The record swings less than what came before: no part of it can be simulated from rest."""
    record = measured("cut", before, (0.5, -0.5, 1.0, -1.0, 0.8))
    wide = measured("wide", (1.0,), (5.0, -5.0, 0.0))
    dataset = Dataset((record, wide), ())
    ready, _ = with_pasts(dataset, pasts(DEVICE, VALUES, dataset.records))
    assert left(record) > 0.3
    assert left(ready) < 0.05
    assert np.array_equal(ready.input[ready.scored], record.input)


def test_a_held_out_record_tells_its_past_by_its_beginning_which_is_not_scored():
    wide = measured("wide", (1.0,), (5.0, -5.0, 0.0))
    held = measured("held", (3.0, -2.0), (1.5, -2.5, 2.5, 1.0, 2.0))
    later = np.where(np.arange(held.time.size) < held.time.size // 2, held.output, 1e3)
    spoiled = Record(held.time, held.input, later, "held")
    estimated = [pasts(DEVICE, VALUES, begun([one]))["held"] for one in (held, spoiled)]
    assert estimated[0] == estimated[1]  # what is scored is not looked at
    _, ready = with_pasts(Dataset((wide, held), ("held",)), {"held": estimated[0]})
    assert ready.measured.size <= held.time.size - held.time.size // 4
    assert left(ready) < 0.05


def test_the_past_of_a_record_is_as_fast_as_the_record_and_not_scored():
    record = measured("cut", (4.0,), (-3.0, 3.0))
    ready = with_past(record, (2.0, -1.0))
    assert ready.history == ready.time.size - record.time.size
    assert np.all(np.diff(ready.time) > 0.0)
    steps = np.abs(np.diff(ready.input[: ready.history + 1]))
    assert np.max(steps) <= 1.001 * np.median(np.abs(np.diff(record.input)))
    assert np.array_equal(ready.measured, record.measured)
    assert (ready.input[: ready.history].max(), ready.input[: ready.history].min()) == (2.0, -1.0)


def test_the_pasts_that_are_kept_are_those_the_system_was_found_with(monkeypatch):
    """The second estimate leaves no less: what is told has to be of the first."""
    left, estimates = iter([1.1, 1.0, 1.0]), iter([{"a": 1.0}, {"a": 2.0}])

    def anew(ready, question):
        rmse, names = next(left), {object()}  # never the same names: it is not settled by them
        best = Of(rmse=rmse, names=names)
        return ready, Of(best=best, final=best, selection=Of(floor=1.0), thin=Of(fitted=lambda _: ((), ())))

    monkeypatch.setattr(diagnosing, "_anew", anew)
    monkeypatch.setattr(diagnosing, "settled", lambda *_: (Of(rmse=1.0, names=set()), next(estimates)))
    monkeypatch.setattr(diagnosing, "pasts", lambda *_: {"h": 9.0})
    monkeypatch.setattr(diagnosing, "with_pasts", lambda _, known: known)
    monkeypatch.setattr(diagnosing, "without_beginnings", lambda _: "cut")
    monkeypatch.setattr(diagnosing, "begun", lambda _: [])
    prepared = Of(dataset=Dataset((measured("a", (1.0,), (0.5, -0.5, 1.0)),), ()), read_as=lambda records, _: records)
    kept, found = diagnosing._in_mid_loop(prepared, None, (), None)
    assert kept == {"a": 1.0, "h": 9.0}
    assert found.best.rmse == 1.0


def test_the_records_stay_whole_where_the_law_is_wrong_with_any_past(monkeypatch):
    def anew(ready, question):
        return ready, Of(best=Of(rmse=2.1), selection=Of(floor=1.0))

    monkeypatch.setattr(diagnosing, "_anew", anew)
    monkeypatch.setattr(diagnosing, "settled", lambda *_: (Of(rmse=2.1), {}))
    monkeypatch.setattr(diagnosing, "without_beginnings", lambda _: "cut")
    prepared = Of(dataset=Dataset((measured("a", (1.0,), (0.5, -0.5, 1.0)),), ()), read_as=lambda records, _: records)
    assert diagnosing._in_mid_loop(prepared, None, (), None) == (prepared, None)


@pytest.mark.parametrize(("left", "told"), [(2.0, True), (2.9, False)])
def test_pasts_explain_what_is_left_where_they_leave_clearly_less(monkeypatch, left, told):
    pasts = importlib.import_module("hysteresis_bench.diagnosis.reading.past")
    monkeypatch.setattr(pasts, "_together", lambda *_: (Of(rmse=left), {}))
    found = Of(follows=True, best=Of(rmse=3.0), selection=Of(floor=1.0))
    assert pasts.explain(found, None) is told
    assert not pasts.explain(Of(follows=True, best=Of(rmse=1.1), selection=Of(floor=1.0)), None)
