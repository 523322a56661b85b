"""Blocks of neighbouring samples, dealt to folds: what is left out of a fit is never a lone sample among its like."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array


@dataclass(frozen=True, eq=False)
class Blocks:
    """block : (samples,) number of every sample's block, over all records;  fold : likewise, from 0 to folds - 1."""

    block: Array
    fold: Array
    folds: int

    def of(self, samples: Array) -> Blocks:
        """Of some of the samples; samples : (samples,), true where one is kept."""
        return Blocks(self.block[samples], self.fold[samples], self.folds)

    @property
    def training(self) -> Array:
        """(samples, folds), 1 where a sample counts for a fold's fit."""
        counts: Array = (self.fold[:, None] != np.arange(self.folds)).astype(float)
        return counts


def blocked(sizes: Sequence[int], counts: Sequence[int], folds: int, *, turn: int = 0, shift: int = 2) -> Blocks:
    """Every record cut into contiguous blocks, which go to the folds in turn.

    sizes : samples of each record;  counts : its blocks
    turn : by how much the dealing moves on after each round of folds, so that a fold is not always the same phase of
    the input's cycle;  shift : by how much from record to record
    """
    own = [np.arange(size) * count // size for size, count in zip(sizes, counts, strict=True)]
    first = np.cumsum([0, *counts[:-1]])
    block = np.concatenate([part + start for part, start in zip(own, first, strict=True)])
    dealt = [(part + turn * (part // folds) + shift * number) % folds for number, part in enumerate(own)]
    return Blocks(block, np.concatenate(dealt), folds)
