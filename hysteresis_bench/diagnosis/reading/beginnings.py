"""Do records begin in mid-loop? A model begins every record at rest, which a device on a bench seldom does.

What it remembers from before a record is in its output until the input has passed the extremes that came before. An
effect that makes up for that, such as a dead band, is needed there and nowhere else: once the beginnings no longer
count, the system without it leaves little more than the noise, and the nested-model test does not ask for it. Where
nothing makes up for it, a fit to the rest alone leaves less by an F test. Then the beginnings become history, simulated
and not scored, and the search begins anew; where it comes down to about the noise, that is what is told.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import autocorrelated
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import LEVEL, REACHED
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.signals import Record

NEAR = 0.05
"""Share of its range by which the input may miss its extremes. With half and with twice of it four made cases had the
same answer."""


MOST = 0.9
"""Of what is scored, which a beginning may be at most: a drive that grows, or of many tones, passes its ends late. In
two made sets of records with such drives, begun in mid-loop, the right law was blamed with half of it (10 times the
noise held out, 1.4 now); in one of them 0.8 leaves something unexplained (1.4), and 0.95 is as this."""

LEFT = 0.2
"""Of the excess over the noise, what may be left without the beginnings: an effect that they hide may be in it."""


def only_in_beginnings(found: Found) -> tuple[str, ...] | None:
    """Names of the adopted effects that the records need in their beginnings only; empty where nothing is named but
    only the beginnings are off; None where the beginnings make no difference."""
    thin, best, floor = found.thin, found.best, found.selection.floor
    records = without_beginnings(thin.stack.records)
    if not found.follows or all(now is before for now, before in zip(records, thin.stack.records, strict=True)):
        return None
    later = replace(thin, stack=replace(thin.stack, records=records))

    def gone(rmse: float, with_beginnings: float) -> bool:
        """Is most of what was more than the noise left out with them?"""
        excess = [x**2 - floor**2 for x in (rmse, with_beginnings)]
        return with_beginnings > REACHED * max(rmse, floor) and excess[0] <= LEFT * excess[1]

    left, current, spare = list(found.without), best, list[str]()
    while left:
        smaller = {name: later.reduced(current, name) for name in left}
        least = min(left, key=lambda name: smaller[name].rmse)
        if not gone(smaller[least].rmse, found.without[least].rmse):
            break
        larger = later.extended(smaller[least], least, current.values)
        if later.test(smaller[least], larger).p < LEVEL:
            break
        left.remove(least)
        spare.append(least)
        current = smaller[least]
    if spare:
        return tuple(spare)
    values = later.polished(best)
    rest = split(later.errors(best.names, values), records)
    off = gone(float(np.sqrt(np.mean(np.concatenate(rest) ** 2))), best.rmse)
    return () if off and _larger(split(best.residuals, thin.stack.records), rest, values.size) < LEVEL else None


def _larger(errors: Sequence[Array], rest: Sequence[Array], free: int) -> float:
    """p of the errors of all being no larger than what a fit to the rest alone leaves there: an F test of mean squares,
    both made white by the autoregression of the latter. free : parameters of the fit"""
    filter_ = autocorrelated.autoregression(rest)
    all_, after = (np.concatenate(autocorrelated.whitened(parts, filter_)) for parts in (errors, rest))
    freedom = max(after.size - free, 1)
    return autocorrelated.f_tail(float(np.mean(all_**2) * freedom / (after @ after)), all_.size, freedom)


def without_beginnings(records: Sequence[Record]) -> tuple[Record, ...]:
    """What comes before the input has passed both ends of its range becomes history, at most `MOST` of what is scored.

    A record is returned as it is where its history has passed them."""
    borders = [_border(record) for record in records]
    return tuple(
        replace(record, history=border) if border > record.history else record
        for record, border in zip(records, borders, strict=True)
    )


def _border(record: Record) -> int:
    u = record.input
    low, high = np.min(u), np.max(u)
    margin = NEAR * (high - low)
    passed = max(int(np.argmax(u >= high - margin)), int(np.argmax(u <= low + margin)))
    return min(passed, record.history + int(MOST * record.measured.size))
