"""What came before a record: the two turning points of the input that a device in mid-loop still remembers.

A model begins every record at rest. A device on a bench seldom does, and what it remembers may last to the end of a
record whose input never passes the earlier extremes again: then no beginning that is left out helps. A law with memory
of its extremes [1] remembers of its past the turning points that no later swing has passed, the largest first. The last
two of them stand for all: the input went from rest to one, on to the other, and from there to where the record begins.
They are estimated for every record, by a system that was fitted, and its past is simulated as history. A slow effect,
such as creep, remembers besides how it was reached: what it still settles to passes for another effect, such as
leakage, until the pasts and the values of the system are estimated together.

[1] M. A. Krasnosel'skii, A. V. Pokrovskii, Systems with Hysteresis, Springer (1989): return-point memory.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.reading.beginnings import without_beginnings
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import ALIKE, BETTER, MISFIT
from hysteresis_bench.signals import Dataset, Record

Past: TypeAlias = tuple[float, float]
"""The earlier and the later turning point, unit of the input."""

BEYOND = 0.3
"""Of the range of all inputs, how far beyond it a turning point may lie."""

POINTS, CLOSER = 33, (9, 9)
"""Turning points tried on either axis, and around the best pair between its neighbours, and once more."""

MOST = 30
"""Times that pasts and values are estimated in turn at most. In made cases some ten were needed."""

UNEXPLAINED = 0.8
"""Of the excess over the noise, what pasts may leave: an effect that they hide is still to be found. They left up to
0.75 in made records in mid-loop, around six wrong laws 0.75, 0.92 (twice) and 0.98 or more. Half of it loses three of
five of the former; above 1, every law that does not follow the data is searched again."""

LONGEST = 200
"""Samples of the way from one turning point to the next; fewer where the record's typical step is longer."""


def pasts(system: System, values: Array, records: Sequence[Record]) -> dict[str, Past]:
    """By name of the records, what must have come before them for a fitted system to leave least.

    values : (dimension,) of the fitted system, in units;  records : with outputs
    """
    if not records:
        return {}
    inputs = np.concatenate([record.input for record in records])
    more = BEYOND * float(np.ptp(inputs))
    axis = np.linspace(inputs.min() - more, inputs.max() + more, POINTS)
    return {record.name: _past(system, values, record, axis) for record in thinned(views_of(records))}


def explain(found: Found, measured: Dataset) -> bool:
    """Where the search ended far from the noise: do pasts explain a share of what is left? Around a wrong law they do
    not, whose beginnings may be further off than the rest as well."""
    floor, best = found.selection.floor, found.best
    if not found.follows or best.rmse <= MISFIT * floor:
        return False
    left, _ = _together(found, best, measured)
    return left.rmse**2 - floor**2 <= UNEXPLAINED * (best.rmse**2 - floor**2)


def settled(found: Found, measured: Dataset) -> tuple[Hypothesis, dict[str, Past]]:
    """Pasts of the fitted records, with the system that they are of: what was found, without the effects beside which
    the pasts leave as little.

    Both are estimated anew in turn until neither leaves less, of every system by itself: the pasts of too large a
    system agree with its values and ask for every effect in it."""
    best = _together(found, found.best, measured)
    while names := found.selection.adopted(best[0]):
        fewer = [_together(found, found.selection.without(best[0], name), measured) for name in names]
        least = min(fewer, key=lambda one: one[0].rmse)
        if least[0].rmse > ALIKE * best[0].rmse:
            break
        best = least
    return best


def _together(found: Found, start: Hypothesis, measured: Dataset) -> tuple[Hypothesis, dict[str, Past]]:
    """A system as it is fitted with its own pasts."""
    best, known = start, dict[str, Past]()
    for _ in range(MOST):
        estimated = pasts(*found.thin.fitted(best), measured.fitted)
        records = thinned(views_of(with_pasts(Dataset(measured.fitted), estimated)))
        now = replace(found.thin, stack=replace(found.thin.stack, records=records)).followed(best)
        if known and now.rmse > BETTER * best.rmse:
            break
        best, known = now, estimated
    return best, known


def begun(records: Sequence[Record]) -> list[Record]:
    """Their beginnings alone, by which the past of a record is estimated of which the rest is to be predicted."""
    later = without_beginnings(records)
    return [replace(record.take(slice(record.history)), history=0) for record in later if record.history > 1]


def _past(system: System, values: Array, record: Record, axis: Array) -> Past:
    earlier = later = axis
    for points in (*CLOSER, 0):
        tried = np.stack(np.meshgrid(earlier, later, indexing="ij")).reshape(2, -1)
        best = tried[:, int(np.argmin(_left(system, values, record, tried)))]
        width = (earlier[1] - earlier[0]) * np.linspace(-1.0, 1.0, points)
        earlier, later = best[0] + width, best[1] + width
    return float(best[0]), float(best[1])


def _left(system: System, values: Array, record: Record, tried: Array) -> Array:
    """Sums of squares (tries,) that pasts (2, tries) leave of a record, all simulated as one swarm."""
    before = with_past(record, (float(tried[0, 0]), float(tried[1, 0])))
    signal, every = before.signal, np.repeat(values[:, None], tried.shape[1], axis=1)
    inputs = np.repeat(signal.input, tried.shape[1], axis=1)
    way = _way(record, tried)
    inputs[: before.steps * way.shape[0]] = np.repeat(way, before.steps, axis=0)
    simulated = before.at_samples(system.simulate(signal.with_input(inputs), every))
    error = before.measured[:, None] - system.adjusted(simulated, before, every)[before.scored]
    squares: Array = np.einsum("ij,ij->j", error, error)
    return squares


def _way(record: Record, pasts: Array) -> Array:
    """From rest, where the input passes it, over both turning points to the first sample: (samples, tries)."""
    u = record.input
    typical = float(np.median(np.abs(np.diff(u))))
    samples = int(np.clip(np.ptp(u) / typical, 2, LONGEST)) if typical > 0.0 else LONGEST
    rest = [np.zeros(pasts.shape[1])] if float(u.min()) <= 0.0 <= float(u.max()) else []
    stops = [*rest, *pasts, np.full(pasts.shape[1], u[0])]
    return np.concatenate([np.linspace(begin, end, samples, endpoint=False) for begin, end in pairwise(stops)])


def with_pasts(dataset: Dataset, known: Mapping[str, Past]) -> tuple[Record, ...]:
    """The records with their pasts as history; the beginning of a held-out one is not scored."""
    later = {record.name: record for record in (*dataset.fitted, *without_beginnings(dataset.held_out))}
    return tuple(
        with_past(later[name], known[name]) if name in known else later[name]
        for name in (record.name for record in dataset.records)
    )


def with_past(record: Record, past: Past) -> Record:
    """The record with the way from rest over both turning points as history; every further column begins as it is."""
    before = _way(record, np.array(past)[:, None])[:, 0]
    time = record.time[0] - float(np.median(np.diff(record.time))) * np.arange(before.size, 0, -1)

    def longer(values: Array) -> Array:
        return np.concatenate([np.full(before.size, values[0]), values])

    return replace(
        record,
        time=np.concatenate([time, record.time]),
        input=np.concatenate([before, record.input]),
        output=None if record.output is None else longer(record.output),
        columns={name: longer(column) for name, column in record.columns.items()},
        history=record.history + before.size,
    )
