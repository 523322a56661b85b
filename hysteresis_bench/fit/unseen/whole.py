"""What is left out of a law's fit to judge it: excitations within the range of those that it is fitted to.

A record is left out whole where its input stays in the range of the others, and so is a sixth of a lone one that holds
cycles of its own. One that goes further says how a law extrapolates, which nobody is promised, and whose large errors
would drown all others: blocks are left out of it instead.

So is one on which a curve of the time, the path or the temperature would be extrapolated, for whom that is asked: of
several records one always lasts longest, or goes the longest way, and without it such a curve may end anywhere.

What is left out of a lone record lies between what is fitted, while what is predicted follows on it, often further. Its
last part, predicted from what came before, is therefore judged as well, as far as it stays near.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, Family
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.left_out import cut
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.signals import Record

COURSE: Family = "change with time, path or temperature"
"""Of effects along which a record may go further than all others, whatever its input does."""

SMOOTHER = 1.5
"""Blocks left out of one excitation have its own amplitude, so that a rougher density wins them and may yet fail at
another one. There a smoother one is taken whose error is at most so many times the best one's: its shape suffers before
its error does; on generated loops there is little between 1 and 2."""
FEWEST = 2
"""Whole parts left out from which they can judge."""
PARTS = 6
"""Into which a lone record is cut, each to be left out in its turn."""
BEYOND = 0.05
"""Share of the range of all by which a part may exceed the others and still be said to stay within."""
SMALLER = 0.8
"""Share of the range of all below which a part has an amplitude of its own."""
REACH = 1.5
"""Times the range of the input before it, up to which that part goes: further on it tells how a law extrapolates."""
CROSSINGS = 3
"""Of the middle of its own range, from which a part holds a cycle."""
GROUPS = 8
"""Folds of whole parts at most."""
LAST = 3
"""What part of a lone record is predicted from what came before, like that which is held out of one."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """blocks : which sample is left out with which, and of which fold
    telling : whether enough whole records, or other amplitudes, are predicted; else it is blocks of like excitation
    whole : numbers of the records that are left out whole; none of a lone one
    like : what is asked is like it, so that its error is what to expect there
    """

    blocks: Blocks
    telling: bool
    whole: tuple[int, ...] = ()
    like: bool = False

    def as_good(self, best: Array, other: Array) -> bool:
        """Does a smoother density do as well, so that it is taken? By the paired test over blocks where they can judge;
        else where its error is at most `SMOOTHER` times the best one's. None does where the least error is to be
        expected of what is asked as well: of 16 made densities it was the least one that erred less there in 13, by a
        tenth in the geometric mean."""
        if self.like:
            return False
        if self.telling:
            return advantage(best, other, self.blocks) < CLEAR
        return float(np.mean(other**2)) <= SMOOTHER**2 * float(np.mean(best**2))


def left_out(records: Sequence[Record], extrapolating: Collection[int] = ()) -> LeftOut:
    """Of the records' scored samples.  extrapolating : numbers of records that are not left out whole either"""
    cells = cut(records)
    sizes = [record.measured.size for record in records]
    number = np.repeat(np.arange(len(records)), sizes)
    part = number if len(records) > 1 else np.arange(sizes[0]) * PARTS // sizes[0]
    u = np.concatenate([record.input[record.scored] for record in records])
    span = float(np.ptp(u)) or 1.0
    inputs = [u[part == k] for k in range(int(part.max()) + 1)]
    low, high = (np.array([of(values) for values in inputs]) for of in (np.min, np.max))
    within = staying(inputs)
    if len(records) == 1:
        within = [one and cycles(values) for one, values in zip(within, inputs, strict=True)]
    within = [one and k not in extrapolating for k, one in enumerate(within)]
    whole = np.flatnonzero(within) if low.size > 1 else np.empty(0, dtype=int)
    groups = min(GROUPS, whole.size)
    fold = cells.fold + groups
    for place, k in enumerate(whole):
        fold[part == k] = place % groups
    block = np.unique(np.column_stack([part, cells.block]), axis=0, return_inverse=True)[1].ravel()
    present, dense = np.unique(fold, return_inverse=True)
    small = [k for k in whole if high[k] - low[k] < SMALLER * span]
    telling = len(records if len(records) > 1 else small) >= FEWEST and whole.size >= FEWEST
    records_out = tuple(whole.tolist()) if len(records) > 1 else ()
    return LeftOut(Blocks(block, dense.ravel(), present.size), telling, records_out)


def staying(inputs: Sequence[Array]) -> list[bool]:
    """Of each of two or more inputs: does it stay in the range of the others, to within `BEYOND` of that of all?"""
    low, high = (np.array([of(values) for values in inputs]) for of in (np.min, np.max))
    slack = BEYOND * float(high.max() - low.min() or 1.0)
    return [
        bool(low[k] >= np.delete(low, k).min() - slack and high[k] <= np.delete(high, k).max() + slack)
        for k in range(low.size)
    ]


def extrapolated(effects: Iterable[Effect], records: Sequence[Record]) -> frozenset[int]:
    """Numbers of the records that go further than all others, by `BEYOND` of the range of all, along the time, the path
    or the temperature that a curve among the effects runs along."""
    curves = [effect for effect in effects if isinstance(effect, FreeForm) and effect.family == COURSE]
    if len(records) < 2:
        return frozenset()
    every = [_ends(curve, records) for curve in curves]
    return frozenset(
        k
        for k in range(len(records))
        for curve, ends in zip(curves, every, strict=True)
        if np.max(np.abs(ends - _ends(curve, [*records[:k], *records[k + 1 :]]))) > BEYOND * np.ptp(ends)
    )


def _ends(curve: FreeForm, records: Sequence[Record]) -> Array:
    """Where a curve of these records begins and ends; one that is told by its length begins at 0."""
    box = {parameter.name: parameter for parameter in curve.box(records)}
    ends = [0.5 * (box[name].lower + box[name].upper) for name in curve.ranges]
    return np.array([0.0, *ends] if len(ends) == 1 else ends)


def last_part(records: Sequence[Record]) -> Array:
    """Which scored samples follow on those that they are to be predicted from, (scored samples,): none of several
    records, which are judged whole."""
    u = np.concatenate([record.input[record.scored] for record in records])
    if len(records) > 1:
        return np.zeros(u.size, dtype=bool)
    reached = np.maximum.accumulate(u) - np.minimum.accumulate(u) >= np.ptp(u) / REACH
    found: Array = np.arange(u.size) >= max(u.size - u.size // LAST, int(np.argmax(reached)))
    return found


def open_way(records: Sequence[Record]) -> bool:
    """Is it a lone record whose input never closes a loop, so that nothing tells how a law comes back?

    What is passed before it is scored comes back: one settled period closes its loop.
    """
    if len(records) > 1:
        return False
    record = records[0]
    return not cycles(record.input if record.history >= record.measured.size else record.input[record.scored])


def cycles(u: Array) -> bool:
    """Does the input go to and fro: through its middle at least so often?"""
    above = u > 0.5 * (u.min() + u.max())
    return int(np.count_nonzero(above[1:] != above[:-1])) >= CROSSINGS
