"""From a data set to what diagnosis works on: what is fitted, what is held out, and thinned records to search on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.evidence.view import View, views_of
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import fitter_of
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.fit.checks.settled_periods import SAID, settled_periods, unsettled
from hysteresis_bench.fit.settling import CLOSED, FIRST_REPEATS, MOST_REPEATS, gap_after, passed
from hysteresis_bench.signals import Dataset, Record

SEARCHED = 4000
"""Samples that the search for effects works on; the final fits use all."""

RESOLVED = 0.04
"""Share of its range by which a thinned input may move in a typical step."""

FEWEST = 60
"""Scored samples of a record from which a third is worth holding out."""


@dataclass(frozen=True, eq=False)
class Prepared:
    """What diagnosis works on.

    dataset : as the model sees it, with its split;  how : the split was chosen, in words
    views : of the fitted records;  passes : how often a closed loop is repeated before it is scored, 0 where it is not
    notes : what a user must know of it
    """

    model: Model
    dataset: Dataset
    how: str
    views: tuple[View, ...]
    passes: int
    notes: tuple[str, ...] = ()

    @property
    def steps(self) -> int:
        """Simulated from one sample to the next; all records have the same."""
        return self.dataset.records[0].steps

    def read_as(self, records: tuple[Record, ...], note: str) -> Prepared:
        """With records that are scored or read otherwise.  records : what all of them become, in their order"""
        dataset = replace(self.dataset, records=records)
        return replace(self, dataset=dataset, views=views_of(dataset.fitted), notes=(*self.notes, note))


def prepare(dataset: Dataset, question: Question) -> Prepared:
    """Prepare the input, let closed loops settle, hold a part out. Raises UserError telling every fault at once."""
    question.check(dataset)
    model, seen = question.built, dataset.map(question.preparation)
    asked = question.options.settle
    passes = passes_to_close(model, seen, question) if settled_periods(seen.fitted, asked) else 0
    ready, how = with_held_out(seen.map(lambda record: passed(record, passes)))
    told = (SAID,) if passes and asked is None else unsettled(seen.fitted, asked)
    return Prepared(model, ready, how, views_of(ready.fitted), passes, told)


def passes_to_close(model: Model, dataset: Dataset, question: Question) -> int:
    """How often a closed loop is repeated before it is scored: until the bare model, fitted, closes it."""
    passes = FIRST_REPEATS
    while True:
        records = tuple(passed(record, passes) for record in dataset.fitted)
        stack = Stack(model, thinned(views_of(records)), tuple(question.effects), question.bounds, question.fixed)
        fitter = fitter_of(stack, question.options.seed)
        system, values = fitter.fitted(fitter.bare(frozenset({registry.RECORD_OFFSET})))
        if passes >= MOST_REPEATS or gap_after(system, records, values, repeats=passes) < CLOSED:
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


def thinned(views: Sequence[View], samples: int = SEARCHED) -> tuple[Record, ...]:
    """Every n-th sample and all turning points, where there are more samples than a search needs."""
    stride = sum(view.y.size for view in views) // samples
    if stride < 2:
        return tuple(view.record for view in views)
    return tuple(_thinned(view, stride) for view in views)


def _thinned(view: View, stride: int) -> Record:
    u = view.record.input
    typical = float(np.median(np.abs(np.diff(u)))) / (float(np.ptp(u)) or 1.0)
    stride = min(stride, max(1, int(RESOLVED / typical))) if typical > 0.0 else stride
    ends = np.array([0, view.record.history, u.size - 1])
    kept = np.unique(np.concatenate([np.arange(0, u.size, stride), view.turns, ends]))
    return view.record.take(kept)
