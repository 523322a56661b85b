"""Is the law itself the cause of what is left? Then effects that were adopted may only stand in for it.

Where the final system predicts excitations left out worse than the noise allows, or needs a curve without a formula,
every other law is fitted to a part of the samples, with the adopted effects. Those that do best there are fitted to
all, and effects that they do not need are taken off again. A law that predicts clearly better, and leaves less than
half of the excess over the noise, is told as the cause; so is one that needs no curve and predicts as well as a system
with one. What was adopted and is not needed around that law is a stand-in: it stays in the model, where it helps to
predict, and is not named.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.families.finding import forms_of
from hysteresis_bench.diagnosis.hypotheses.cross_validation import CLEAR, advantage
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import MATTERS, NAMED, Selection
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.signals import Record

SCREENED = 1000
"""Samples to which every law is fitted first. With half and with twice as many the same laws passed on four made cases,
in 0.9 and in 1.4 times the time."""

PURSUED = 3
"""Laws that are fitted to all samples: those that leave least of the few."""


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

    few : the same with fewer samples;  own : effects that the user put around the model;  adopted : formulas that were
    found;  floor : RMS of the noise
    """

    records: tuple[Record, ...]
    few: tuple[Record, ...]
    own: tuple[str, ...]
    adopted: tuple[str, ...]
    floor: float
    seed: int

    def screened(self, law: str) -> Contender:
        """With all of them, and what it leaves of the few samples that it was fitted to."""
        fitter = self._fitter(law, self.few)
        system = fitter.stack.system(self._offset)
        enough = sum(record.measured.size for record in self.few) > 2 * len(system.parameters)
        if not enough or broken_promises(system, self.few):
            return Contender(law, (), np.empty(0))
        return Contender(law, (), fitter.bare(self._offset | {*self._possible(fitter)}).residuals)

    def fitted(self, law: str) -> Contender:
        """With those of them that it needs."""
        fitter = self._fitter(law, self.records)
        names = self._possible(fitter)
        needs = Selection(fitter, Workers(fitter, 1), self.floor, tuple(names))
        current = fitter.bare(self._offset | {*names})
        while names:
            smaller = {name: fitter.reduced(current, name) for name in names}
            spare = [name for name in names if not needs.needed(smaller[name], current)]
            if not spare:
                break
            least = min(spare, key=lambda name: smaller[name].cv_rmse)
            names.remove(least)
            # with more effects than are needed a search may have ended elsewhere
            current = min(smaller[least], fitter.bare(self._offset | {*names}), key=lambda one: one.rmse)
        return Contender(law, tuple(names), fitter.unseen(current))

    def _possible(self, fitter: Fitter) -> list[str]:
        return [name for name in self.adopted if name in fitter.stack.candidates()[0]]

    @property
    def _offset(self) -> frozenset[str]:
        return frozenset({registry.RECORD_OFFSET})

    def _fitter(self, law: str, records: tuple[Record, ...]) -> Fitter:
        return Fitter(Stack(registry.build("models", law, {}), records, self.own), self.seed)


def law_as_cause(found: Found, others: Sequence[str], options: DiagnosisOptions) -> Cause | None:
    """None where the law is not to blame: little is left, or no other law does clearly better.

    others : names of the laws that may stand in its place
    """
    selection, fitter, floor = found.selection, found.thin, found.selection.floor
    if not (found.follows and others):
        return None
    unseen = fitter.unseen(found.final)
    own = float(np.sqrt(np.mean(unseen**2)))
    stack, adopted = fitter.stack, selection.adopted(found.best)
    curves = forms_of(adopted)
    if own <= MATTERS * floor and not curves:
        return None
    formulas = tuple(name for name in adopted if name not in curves)
    few = thinned(views_of(stack.records), SCREENED)
    laws = OtherLaws(stack.records, few, stack.own, formulas, floor, options.seed)
    left = replace(fitter, stack=replace(stack, records=few)).errors(found.final.names, fitter.fitted(found.final)[1])
    best = _best(laws, others, float(np.sqrt(np.mean(left**2))) * (MATTERS if curves else 1.0), options)
    explains = own > MATTERS * best.rmse and own**2 - best.rmse**2 > NAMED * (own**2 - floor**2)
    clearly = explains and advantage(best.unseen, unseen, fitter.blocks) > CLEAR
    if not clearly and not (curves and best.rmse <= MATTERS * max(own, floor)):
        return None
    spare = tuple(name for name in adopted if name not in best.effects)
    return Cause(best.model, best.effects, spare, best.rmse, own)


def _best(laws: OtherLaws, names: Sequence[str], reach: float, options: DiagnosisOptions) -> Contender:
    """reach : RMSE over the few samples that a law has to beat"""
    jobs = options.jobs or min(4, os.cpu_count() or 1)
    with Workers[Contender](laws, jobs, options.on_step, options.kept) as workers:
        screened = sorted(workers.map([("screened", name) for name in names]), key=lambda one: one.rmse)
        promising = [one.model for one in screened[:PURSUED] if one.rmse < reach]
        fitted = workers.map([("fitted", name) for name in promising])
        return min(fitted, key=lambda one: one.rmse, default=Contender("", (), np.empty(0)))
