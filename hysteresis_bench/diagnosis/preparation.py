"""From a data set to what diagnosis works on: what is fitted, what is held out, and thinned records to search on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.evidence import covariates
from hysteresis_bench.diagnosis.evidence.noise import fast_noise
from hysteresis_bench.diagnosis.search.hypotheses import Bench
from hysteresis_bench.diagnosis.search.systems import Stack
from hysteresis_bench.fit.settling import CLOSED, FIRST_REPEATS, MOST_REPEATS, gap_after
from hysteresis_bench.registry import RECORD_OFFSET
from hysteresis_bench.signals import Dataset, Record

MOST = 4000
"""Samples that the search for effects works on; the final fits use all."""

RESOLVED = 0.04
"""Share of its range by which a thinned input may move in a typical step."""

FEWEST = 60
"""Scored samples of a record from which a third is worth holding out."""


def passes_to_close(
    model: Model,
    dataset: Dataset,
    effects: Sequence[str],
    bounds: Mapping[str, tuple[float, float]] | None,
    fixed: Mapping[str, float] | None,
    seed: int,
) -> int:
    """How often a closed loop is repeated before it is scored: until the bare model, fitted, closes it."""
    passes = FIRST_REPEATS
    while True:
        records = tuple(record.settled(passes) for record in dataset.fitted)
        bench = Bench(Stack(model, thinned(records), tuple(effects), bounds, fixed), seed)
        bare = bench.bare(frozenset({RECORD_OFFSET}))
        system, values = bench.fitted(bare)
        if passes >= MOST_REPEATS or gap_after(system, records, values, passes) < CLOSED:
            return passes
        passes *= 2


def with_held_out(dataset: Dataset) -> tuple[Dataset, str]:
    """The data set with a part held out, and how it was chosen, in words."""
    if dataset.held_out:
        return dataset, "held out as asked"
    count = len(dataset.records)
    if count > 1:
        names = dataset.names[-max(1, round(count / 3)) :]
        return dataset.split(names), "held out: the last third of the records"
    record = dataset.records[0]
    if record.measured.size < FEWEST:
        return dataset, f"nothing held out: {record.measured.size} samples are too few to split"
    border = record.history + 2 * record.measured.size // 3
    head = record.take(slice(0, border))
    tail = replace(record, history=border, name=f"{record.name}, last third")
    words = "held out: the last third of the time of the only record, simulated on from the first two"
    return Dataset((head, tail), (tail.name,), dataset.hidden), words


def thinned(records: Sequence[Record]) -> tuple[Record, ...]:
    """Every so manieth sample and all turning points, where there are more samples than a search needs."""
    stride = sum(record.measured.size for record in records) // MOST
    if stride < 2:
        return tuple(records)
    return tuple(_thinned(record, stride) for record in records)


def _thinned(record: Record, stride: int) -> Record:
    u = record.input
    typical = float(np.median(np.abs(np.diff(u)))) / (float(np.ptp(u)) or 1.0)
    stride = min(stride, max(1, int(RESOLVED / typical))) if typical > 0.0 else stride
    turns = covariates.turning_points(u, covariates.resolution_of(u, fast_noise(record.time, u)[0]))
    ends = np.array([0, record.history, u.size - 1])
    kept = np.unique(np.concatenate([np.arange(0, u.size, stride), turns, ends]))
    return record.take(kept)
