"""Other laws around the records of a diagnosis, with those of the effects in question that each of them needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import fitter_of
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.selection import BETTER, Selection
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.fit.checks.wanted_units import unlike_wanted
from hysteresis_bench.signals import Record

OFFSET = frozenset({registry.RECORD_OFFSET})


@dataclass(frozen=True, eq=False)
class Contender:
    """A law around the records.

    effects : those around it;  errors : (scored samples,), empty where it cannot be fitted
    parameters : how many, of the law and of the effects
    """

    model: str
    effects: tuple[str, ...]
    errors: Array
    parameters: int = 0

    @property
    def rmse(self) -> float:
        return float(np.sqrt(np.mean(self.errors**2))) if self.errors.size else np.inf


@dataclass(frozen=True, eq=False)
class OtherLaws:
    """Fits laws to the records of a diagnosis.

    asked : the law that was asked about, as `stack` has it;  few : the records of `stack` with fewer samples
    effects : in question;  floor : RMS of the noise
    values : of parameters around the asked law; those of its effects are begun with
    """

    asked: str
    stack: Stack
    few: tuple[Record, ...]
    effects: tuple[str, ...]
    floor: float
    seed: int
    values: Mapping[str, float]

    def screened(self, law: str) -> Contender:
        """With all effects in question, and what it leaves of the few samples that it was fitted to."""
        fitter = self._fitter(law, self.few)
        system = fitter.stack.system(OFFSET)
        enough = sum(record.measured.size for record in self.few) > 2 * len(system.parameters)
        if not enough or unlike_wanted(system.model, self.few) or broken_promises(system, self.few):
            return Contender(law, (), np.empty(0))
        names = self._possible(fitter)
        return Contender(law, tuple(names), self._fitted(fitter, names).residuals)

    def needy(self, law: str) -> Contender:
        """With those of them that it needs around the few samples, and what it then leaves of them."""
        system, names = self._thinned(fitter := self._fitter(law, self.few), self._possible(fitter))
        return Contender(law, names, system.residuals)

    def predicting(self, law: str) -> Contender:
        """With those of them that it needs around all samples, and its errors on records left out of the fit."""
        system, names = self._thinned(fitter := self._fitter(law, self.stack.records), self._possible(fitter))
        return Contender(law, names, fitter.unseen(system), len(system.values))

    def _thinned(self, fitter: Fitter, effects: Sequence[str]) -> tuple[Hypothesis, tuple[str, ...]]:
        """Without those that are not needed: all at once where none of them is missed then, or else one by one."""
        names = list(effects)
        needed = Selection(fitter, Workers(fitter, 1), self.floor, tuple(names)).needed
        current = self._fitted(fitter, names)
        while names:
            smaller = {name: fitter.reduced(current, name) for name in names}
            spare = [name for name in names if not needed(smaller[name], current)]
            if not spare:
                break
            least = min(spare, key=lambda name: smaller[name].cv_rmse)
            rest = fitter.followed(replace(smaller[least], names=current.names - {*spare}))
            # where a smaller system leaves less, the search had ended elsewhere, and nothing is known of the others
            elsewhere = min(one.rmse for one in smaller.values()) < BETTER * current.rmse
            if elsewhere or needed(rest, current):
                spare, rest = [least], smaller[least]
            names, current = [name for name in names if name not in spare], rest
        # with more effects than are needed a search may have ended elsewhere
        if len(names) < len(effects):
            current = min(current, self._fitted(fitter, names), key=lambda one: one.rmse)
        return current, tuple(names)

    def _fitted(self, fitter: Fitter, effects: Sequence[str]) -> Hypothesis:
        """From anywhere, and from there with the effects as they were around the asked law: no search from anywhere
        meets a narrow line of the spectrum."""
        found = fitter.bare(OFFSET | {*effects})
        # a law's own have no dot, and mean something else in another law
        known = {name: value for name, value in self.values.items() if "." in name and name in found.values}
        if not known:
            return found
        again = fitter.followed(replace(found, values={**found.values, **known}))
        return min(found, again, key=lambda one: one.rmse)

    def _possible(self, fitter: Fitter) -> list[str]:
        known = {*fitter.stack.candidates()[0], *fitter.stack.free_forms()}
        return [name for name in self.effects if name in known]

    def _fitter(self, law: str, records: tuple[Record, ...]) -> Fitter:
        if law == self.asked:
            stack = Stack(self.stack.model, records, self.stack.own, self.stack.bounds, self.stack.fixed)
        else:
            stack = Stack(registry.build("models", law, {}), records, self.stack.own)
        return fitter_of(stack, self.seed)
