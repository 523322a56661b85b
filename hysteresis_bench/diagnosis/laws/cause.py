"""Is the law itself the cause of what is left? Then effects that were adopted may only stand in for it.

Where the final system predicts excitations left out worse than the noise allows, every other law is fitted to a part of
the samples. Those that do better there are fitted to all, as they stand, and the best of them with the adopted effects
too, of which those are taken off again that it does not need. A law that predicts clearly better, and leaves less than
half of the excess over the noise, is told as the cause. What was adopted and is not needed around that law is a
stand-in: it stays in the model, where it helps to predict, and is not named.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.cross_validation import CLEAR, advantage
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import MATTERS, NAMED, Selection
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.signals import Record

SCREENED = 1000
"""Samples to which every law is fitted first. With 2000 the same laws passed on made cases, in twice the time."""

PURSUED = 3
"""Laws that are also fitted with the adopted effects: those that predict best without."""


@dataclass(frozen=True, eq=False)
class Contender:
    """Another law around the same records.

    effects : of the adopted ones, those that it needs;  unseen : errors (scored samples,) of every record by a fit to
    the others, empty where it cannot be fitted
    """

    model: str
    effects: tuple[str, ...]
    unseen: Array

    @property
    def rmse(self) -> float:
        return float(np.sqrt(np.mean(self.unseen**2))) if self.unseen.size else np.inf


@dataclass(frozen=True)
class Cause:
    """A law that predicts clearly better.

    effects, stand_ins : of what was adopted, what this law needs too, and what it does not
    unseen, own : RMSE on excitations left out of the fit (of a lone record, on its blocks), of this law with
    `effects`, and of the law that was asked about with all that was adopted
    """

    model: str
    effects: tuple[str, ...]
    stand_ins: tuple[str, ...]
    unseen: float
    own: float


@dataclass(frozen=True, eq=False)
class OtherLaws:
    """Fits other laws to the records of a diagnosis.

    few : the same with fewer samples;  own : effects that the user put around the model;  adopted : those that were
    found;  floor : RMS of the noise
    """

    records: tuple[Record, ...]
    few: tuple[Record, ...]
    own: tuple[str, ...]
    adopted: tuple[str, ...]
    floor: float
    seed: int

    def screened(self, law: str) -> Contender:
        """With an offset a record and nothing else, and what it leaves of the few samples that it was fitted to."""
        fitter = self._fitter(law, self.few)
        return Contender(law, (), fitter.bare(self._offset).residuals if self._possible(fitter) else np.empty(0))

    def alone(self, law: str) -> Contender:
        """With an offset a record and nothing else."""
        fitter = self._fitter(law, self.records)
        return self._contender(law, fitter, fitter.bare(self._offset))

    def with_adopted(self, law: str) -> Contender:
        """With those of the adopted effects that it needs."""
        fitter = self._fitter(law, self.records)
        names = [name for name in self.adopted if name in fitter.stack.candidates()[0]]
        needs = Selection(fitter, Workers(fitter, 1), self.floor, tuple(names))
        current = fitter.bare(self._offset | {*names})
        while names:
            smaller = {name: fitter.reduced(current, name) for name in names}
            spare = [name for name in names if not needs.needed(smaller[name], current)]
            if not spare:
                break
            least = min(spare, key=lambda name: smaller[name].cv_rmse)
            names.remove(least)
            current = smaller[least]
        return self._contender(law, fitter, current)

    @property
    def _offset(self) -> frozenset[str]:
        return frozenset({registry.RECORD_OFFSET})

    def _fitter(self, law: str, records: tuple[Record, ...]) -> Fitter:
        return Fitter(Stack(registry.build("models", law, {}), records, self.own), self.seed)

    def _possible(self, fitter: Fitter) -> bool:
        system = fitter.stack.system(self._offset)
        enough = sum(record.measured.size for record in self.few) > 2 * len(system.parameters)
        return enough and not broken_promises(system, self.few)

    def _contender(self, law: str, fitter: Fitter, hypothesis: Hypothesis) -> Contender:
        effects = tuple(name for name in self.adopted if name in hypothesis.names)
        return Contender(law, effects, fitter.unseen(hypothesis))


def law_as_cause(found: Found, others: Sequence[str], options: DiagnosisOptions) -> Cause | None:
    """None where the law is not to blame: little is left, or no other law does clearly better.

    others : names of the laws that may stand in its place
    """
    selection, fitter, floor = found.selection, found.thin, found.selection.floor
    unseen = fitter.unseen(found.final)
    own = float(np.sqrt(np.mean(unseen**2)))
    if not (found.follows and others) or own <= MATTERS * floor:
        return None
    stack, adopted = fitter.stack, selection.adopted(found.best)
    few = thinned(views_of(stack.records), SCREENED)
    laws = OtherLaws(stack.records, few, stack.own, adopted, floor, options.seed)
    least = replace(fitter, stack=replace(stack, records=few)).errors(found.final.names, fitter.fitted(found.final)[1])
    best = _best(laws, others, float(np.sqrt(np.mean(least**2))), options)
    if own <= MATTERS * best.rmse or own**2 - best.rmse**2 <= NAMED * (own**2 - floor**2):
        return None
    if advantage(best.unseen, unseen, fitter.blocks) <= CLEAR:
        return None
    spare = tuple(name for name in adopted if name not in best.effects)
    return Cause(best.model, best.effects, spare, best.rmse, own)


def _best(laws: OtherLaws, names: Sequence[str], least: float, options: DiagnosisOptions) -> Contender:
    """least : RMSE of the final system over the few samples, which a law has to beat"""
    jobs = options.jobs or min(4, os.cpu_count() or 1)
    with Workers[Contender](laws, jobs, options.on_step, options.kept) as workers:
        better = [
            one.model for one in workers.map([("screened", name) for name in names]) if MATTERS * one.rmse < least
        ]
        alone = sorted(workers.map([("alone", name) for name in better]), key=lambda one: one.rmse)
        wanting = [one for one in alone[:PURSUED] if one.rmse > MATTERS * laws.floor and laws.adopted]
        around = workers.map([("with_adopted", one.model) for one in wanting])
        return min([*alone, *around], key=lambda one: one.rmse, default=Contender("", (), np.empty(0)))
