"""What is left out of the fits of the model and of the black box alike, and what is left out once more inside them.

Records whose input stays within the range of the others are left out whole, at most eight folds of them; of one that
goes further blocks are, as no black box can know what lies beyond, and so are parts of a lone record.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.fit.unseen.left_out import cut
from hysteresis_bench.fit.unseen.whole import left_out
from hysteresis_bench.signals import Record


@dataclass(frozen=True, eq=False)
class Fold:
    """without : parts that its fit does not count;  judged : (any,) samples whose errors are its own
    place : of the outer fold without which the named model is fitted
    """

    without: frozenset[int]
    judged: Array
    place: int


@dataclass(frozen=True, eq=False)
class Folds:
    """blocks : which sample is left out with which, and of which fold
    part : (samples,) the finest that is left out together;  how : what the folds are, in words
    """

    blocks: Blocks
    part: Array
    how: str

    @cached_property
    def outer(self) -> list[Fold]:
        """One after the other, each sample judged once."""
        return [self._of(self.blocks.fold == number, number) for number in range(self.blocks.folds)]

    def inner(self, outer: Fold) -> list[Fold]:
        """Without the outer one, and each of the others in turn; where there is but one other, without a part of it."""
        others = [fold for fold in self.outer if fold.without != outer.without]
        if len(others) == 1:
            # a named model without the other one would know the outer one alone
            others = [self._of(self.part == part, outer.place) for part in sorted(others[0].without)]
        return [Fold(outer.without | fold.without, fold.judged, fold.place) for fold in others]

    def every(self, stride: int) -> Folds:
        """Of every n-th sample;  stride : n"""
        block, fold = self.blocks.block[::stride], self.blocks.fold[::stride]
        return replace(self, blocks=Blocks(block, fold, self.blocks.folds), part=self.part[::stride])

    def _of(self, out: Array, place: int) -> Fold:
        return Fold(frozenset(np.unique(self.part[out]).tolist()), np.flatnonzero(out), place)


def folds_of(records: Sequence[Record], extrapolating: Collection[int] = ()) -> Folds:
    """Of the records' scored samples.  extrapolating : numbers of records that are not left out whole either"""
    blocks, cells = left_out(records, extrapolating).blocks, cut(records)
    part = blocks.fold
    if blocks.folds == 2:
        part = np.unique(np.column_stack([blocks.fold, cells.fold]), axis=0, return_inverse=True)[1].ravel()
    number = np.repeat(np.arange(len(records)), [record.measured.size for record in records])
    torn = [k for k in range(len(records)) if np.unique(blocks.fold[number == k]).size > 1]
    if len(records) == 1:
        return Folds(blocks, part, "parts of the only record")
    if not torn:
        return Folds(blocks, part, "whole records")
    names = ", ".join(records[k].name for k in torn)
    whole = "whole records" if len(torn) < len(records) else "none whole"
    return Folds(blocks, part, f"{whole}, and blocks of what goes beyond the range of the others ({names})")
