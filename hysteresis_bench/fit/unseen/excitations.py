"""Which of the fitted samples are an excitation of their own, so that leaving them out tests what was fitted to others?

Of several records each is one. Of a lone record a part that holds a cycle is one, where its input stays in the range of
the other parts; one that goes further says how a law extrapolates. One loop holds none: whatever is left out of it lies
on the very path that was fitted, so that blocks of it are no evidence for other excitations. Blocks of a short record
whose amplitude or frequency changes are some: each has its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.excited import excited, unlike
from hysteresis_bench.fit.unseen.interval import BEYOND
from hysteresis_bench.fit.unseen.whole import cycles, staying
from hysteresis_bench.signals import Record

PARTS = (6, 4, 3, 2)
"""Of a lone record: as many as leave out most of it, and of these numbers the largest."""
FEWEST = 2
"""Parts from which they can be left out in turn."""


@dataclass(frozen=True, eq=False)
class Excitations:
    """number : (scored samples,) of the record, or of the part of a lone one, from 0
    apart : numbers of those that can be left out to test a fit to the others; empty where there are none
    inner : of the records in `apart`, those no slower, faster, smaller or larger than all others: to predict them is
        to interpolate; empty of a lone one
    varied : are there several records, or do the half cycles of the lone one differ in amplitude or in frequency?
    """

    number: Array
    apart: tuple[int, ...]
    inner: tuple[int, ...]
    varied: bool

    @property
    def only_one(self) -> bool:
        """Is there one loop, of one amplitude and frequency, of which nothing can be left out?"""
        return not (self.apart or self.varied)


def excitations(records: Sequence[Record]) -> Excitations:
    """Of the records' scored samples."""
    sizes = [record.measured.size for record in records]
    if len(records) > 1:
        number, every = np.repeat(np.arange(len(sizes)), sizes), tuple(range(len(sizes)))
        return Excitations(number, every, tuple(k for k in every if _between(records, k)), True)
    varied = any(high > BEYOND * low for low, high in excited(records).values())
    u = records[0].input[records[0].scored]
    most, found = 0, Excitations(np.zeros(u.size, dtype=int), (), (), varied)
    for count in PARTS:
        number = np.arange(u.size) * count // u.size
        parts = [u[number == k] for k in range(count)]
        apart = tuple(k for k, within in enumerate(staying(parts)) if within and cycles(parts[k]))
        samples = int(np.isin(number, apart).sum())
        if len(apart) >= FEWEST and samples > most:
            most, found = samples, Excitations(number, apart, (), varied)
    return found


def _between(records: Sequence[Record], place: int) -> bool:
    """Is it neither slower nor faster, smaller nor larger, than all others?"""
    others = [record for k, record in enumerate(records) if k != place]
    return not unlike(excited(others), excited([records[place]]))
