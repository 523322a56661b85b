"""Which effects does the data ask for? Forward selection, exchange, backward elimination.

An effect is adopted when it passes three tests: the nested-model test at LEVEL over the number of candidates;
blocks left out, on which it must win by `CLEAR` standard errors; and it must matter: a claim is made about an
effect that the noise does not hide, not about every trace. Of those that pass, the one with the best
cross-validated error joins; then every adopted effect is weighed against each alternative in its place, given
the others, because the first to join may have been a stand-in for two; then what is no longer needed leaves. In
the end, an effect that explains less than what is left beside it is not named: where a model is wrong by itself,
every effect takes a little of its error.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from hysteresis_bench.diagnosis.search.cross_validation import CLEAR, advantage
from hysteresis_bench.diagnosis.search.hypotheses import Bench, Trial
from hysteresis_bench.diagnosis.search.nested_test import NestedTest
from hysteresis_bench.diagnosis.search.workers import Crew
from hysteresis_bench.registry import COMMON_OFFSET, RECORD_OFFSET

LEVEL = 0.01
"""Of a claim where nothing is hidden, over all candidates of a round."""

MATTERS = 1.06
"""The RMSE without an effect over that with it: 1.06 is an effect of a third of the noise."""

SHARE = 0.1
"""Of the excess of the mean square over the noise's, which an effect must explain."""

NAMED = 0.5
"""... and must explain in the end, or to be exchanged for a simpler one: more than what then remains."""

CLOSE = 0.5
"""Two systems whose outputs differ by less than this many times what they leave, or the noise (RMS), are alike."""

ALIKE = 1.02
"""... and whose cross-validated errors are within this ratio."""

MISFIT, CLEARLY = 1.2, 0.1
"""RMSE over noise from which the model itself is wrong, and the share of the excess that tells two systems apart
there."""

LEADERS = 2
"""Of the effects that do not pass alone, so many are tried with each other one."""

CONTENDERS, WITHIN = 4, 1.6
"""So many of the best, within this ratio of the least RMSE, are fitted again from other starts."""

BETTER = 0.999
"""Ratio of the RMSE from which another fit of the same system is a better one."""

MOST = 5


@dataclass(frozen=True, eq=False)
class Round:
    """What was tried on top of `current`: trials and tests by candidate; `chosen` is empty where none passed."""

    current: Trial
    trials: Mapping[str, Trial]
    tests: Mapping[str, NestedTest]
    advantages: Mapping[str, float]
    chosen: str


@dataclass(eq=False)
class Selection:
    """The search's state and result.

    floor : RMS that a perfect model leaves;  candidates : names that can be tried
    """

    bench: Bench
    crew: Crew
    floor: float
    candidates: tuple[str, ...]
    rounds: list[Round] = field(default_factory=list)
    known: dict[frozenset[str], Trial] = field(default_factory=dict)
    sought: set[frozenset[str]] = field(default_factory=set)
    weighed: set[tuple[frozenset[str], str]] = field(default_factory=set)

    def run(self, base: Trial) -> Trial:
        """From the bare model to the last adopted effect."""
        current = base
        visited = {current.names: current.rmse}
        while True:
            found = self._round(current)
            self.rounds.append(found)
            if found.chosen and len(self.adopted(current)) < MOST:
                better = self._settle(self.bench.refitted(found.trials[found.chosen]))
            else:
                better = self._exchanged(current) or self._paired(found) or current
            if better.rmse > BETTER * visited.get(better.names, np.inf):
                return self._named(current)
            current = better
            visited[current.names] = current.rmse

    def adopted(self, trial: Trial) -> tuple[str, ...]:
        return tuple(sorted(trial.names & set(self.candidates)))

    def alternatives(self, current: Trial, name: str) -> dict[str, Trial]:
        """The systems with another effect in the place of an adopted one."""
        return self._sought(self._extensions(self.without(current, name), current))

    def without(self, trial: Trial, name: str) -> Trial:
        return self._reduced(trial, [name])[0]

    def with_each(self, trial: Trial, names: Sequence[str]) -> list[Trial]:
        return self._ask([("extended", trial, name) for name in names], [trial.names | {name} for name in names])

    def compared(self, smaller: Trial, larger: Trial) -> tuple[NestedTest, float]:
        """The nested-model test, and by how many standard errors the larger system wins on blocks left out."""
        return self.bench.test(smaller, larger), advantage(larger.left_out, smaller.left_out, self.bench.blocks)

    def needed(self, smaller: Trial, larger: Trial, candidates: int = 1) -> bool:
        """Does the larger system pass the three tests against the smaller?"""
        return (
            smaller.rmse > MATTERS * max(larger.rmse, self.floor / MATTERS**2)
            and self.share(smaller, larger) > SHARE
            and advantage(larger.left_out, smaller.left_out, self.bench.blocks) > CLEAR
            and self.bench.test(smaller, larger).p * candidates < LEVEL
        )

    def share(self, smaller: Trial, larger: Trial) -> float:
        """Of the mean square that the smaller system leaves over the noise, what the larger one explains."""
        excess = smaller.rmse**2 - self.floor**2
        return (smaller.rmse**2 - larger.rmse**2) / excess if excess > 0.0 else 1.0

    def tied(self, one: Trial, other: Trial) -> bool:
        """Do the data not tell them apart?

        Where both leave much more than the noise, the difference of two wrong systems is no evidence, however
        significant: it has to be a good part of what is left.
        """
        gain = advantage(one.left_out, other.left_out, self.bench.blocks)
        ratio = other.cv_rmse / one.cv_rmse if one.cv_rmse > 0 else 1.0
        apart = one.apart(other)
        worse, better = (one, other) if one.rmse > other.rmse else (other, one)
        if better.rmse > MISFIT * self.floor and self.share(worse, better) < CLEARLY:
            return apart < better.rmse
        similar = apart < CLOSE * max(self.floor, one.rmse) and ratio < ALIKE and 1 / ratio < ALIKE
        # that a richer system is a little better is no evidence for it, however significant
        return similar and (abs(gain) < CLEAR or len(better.values) > len(worse.values))

    def simplest(self, trials: Sequence[Trial]) -> Trial:
        """Of the best and those tied with it, those with fewest parameters (what a model offers inside its state
        equation only where nothing around it does as well); of these, of the best and those tied with it, the
        alphabetically first."""
        for key in (self._plainness, lambda trial: sorted(trial.names)):
            best = min(trials, key=lambda trial: trial.cv_rmse)
            alike = [trial for trial in trials if trial is best or self.tied(best, trial)]
            least = min(map(key, alike))
            trials = [trial for trial in alike if key(trial) == least]
        return trials[0]

    def _plainness(self, trial: Trial) -> list:
        return [len(trial.at_bound) > 0, len(trial.values), len(trial.names & set(self.bench.stack.model.offers))]

    def _round(self, current: Trial) -> Round:
        trials = self._extensions(current)
        if min((trial.rmse for trial in trials.values()), default=0.0) > MATTERS * self.floor:
            trials = self._sought(trials)
        tests = {name: self.bench.test(current, trial) for name, trial in trials.items()}
        gains = {name: advantage(t.left_out, current.left_out, self.bench.blocks) for name, t in trials.items()}
        passed = {name: t for name, t in trials.items() if self.needed(current, t, len(self.candidates))}
        chosen = ""
        if passed:
            winner = self.simplest(list(passed.values()))
            chosen = next(name for name, trial in passed.items() if trial is winner)
        return Round(current, trials, tests, gains, chosen)

    def _paired(self, found: Round) -> Trial | None:
        """Two effects at once, where the model is wrong and no single one passes: what one of them leaves may hide
        the other."""
        current, count = found.current, len(self.candidates)
        if current.rmse < MISFIT * self.floor or len(self.adopted(current)) + 2 > MOST:
            return None
        leaders = sorted(found.trials.values(), key=lambda trial: trial.cv_rmse)[:LEADERS]
        pairs = [pair for leader in leaders for pair in self._extensions(leader).values()]
        best = min(pairs, key=lambda trial: trial.cv_rmse, default=current)
        if not self.needed(current, best, count * (count - 1) // 2) or self.share(current, best) < NAMED:
            return None
        return self._settle(self.bench.refitted(best))

    def _settle(self, current: Trial) -> Trial:
        """Exchange adopted effects for better ones, and drop those that are not needed, until neither helps."""
        for _ in range(2 * MOST):
            better = self._dropped(current)
            if better is None and current.rmse > MATTERS * self.floor:
                better = self._exchanged(current)
            if better is None:
                return current
            current = better
        return current

    def _named(self, current: Trial) -> Trial:
        """Without the effects that explain less than what is left beside them, the least telling first."""
        while names := self.adopted(current):
            smaller = self._reduced(current, names)
            least = min(smaller, key=lambda trial: self.share(trial, current))
            if self.share(least, current) > NAMED:
                break
            current = self._exchanged(least) or least
        return current

    def _dropped(self, current: Trial) -> Trial | None:
        names = self.adopted(current)
        if len(names) < 2:
            return None
        smaller = self._reduced(current, names)
        spare = [trial for trial in smaller if not self.needed(trial, current)]
        return min(spare, key=lambda trial: trial.cv_rmse) if spare else None

    def _exchanged(self, current: Trial) -> Trial | None:
        for name in self.adopted(current):
            rivals = list(self.alternatives(current, name).values())
            if not rivals:
                continue
            best = self.simplest([current, *rivals])
            if best is not current and best.cv_rmse < ALIKE * current.cv_rmse:
                clear = advantage(best.left_out, current.left_out, self.bench.blocks) > CLEAR
                more = len(best.values) - len(current.values)
                least = NAMED if more > 0 else 0.0
                better = (clear or more < 0) and self.share(current, best) > least
                if better or self.tied(current, best):
                    return self.bench.refitted(best)
        return None

    def _extensions(self, trial: Trial, instead_of: Trial | None = None) -> dict[str, Trial]:
        """instead_of : a system with one effect more, in the place of which others are tried"""
        names = [n for n in self.candidates if n not in trial.names and (not instead_of or n not in instead_of.names)]
        other = instead_of.values if instead_of else None
        keys = [trial.names | {name} for name in names]
        return dict(zip(names, self._ask([("extended", trial, name, other) for name in names], keys), strict=True))

    def _sought(self, trials: dict[str, Trial]) -> dict[str, Trial]:
        """The contenders are fitted again from other starts, where there is more than one effect to be bent."""
        least = min((trial.rmse for trial in trials.values()), default=0.0)
        ranked = sorted(trials, key=lambda name: trials[name].rmse)
        close = [
            name
            for name in ranked[:CONTENDERS]
            if trials[name].rmse < WITHIN * least
            and len(self.adopted(trials[name])) > 1
            and trials[name].names not in self.sought
        ]
        again = self.crew.map([("refitted", trials[name]) for name in close])
        for name, trial in zip(close, again, strict=True):
            self.known[trial.names] = trial
            self.sought.add(trial.names)
            trials = {**trials, name: trial}
        return trials

    def _reduced(self, current: Trial, names: Sequence[str]) -> list[Trial]:
        """Without one effect each. Fitted from here even where it is known: from here it may fit better than from
        where it was first fitted."""
        weighed = {name for name in names if (current.names, name) in self.weighed}
        new = [name for name in names if name not in weighed or current.names - {name} not in self.known]
        for name, trial in zip(new, self.crew.map([("reduced", current, name) for name in new]), strict=True):
            self.weighed.add((current.names, name))
            self._learn(trial)
        return [self.known[current.names - {name}] for name in names]

    def _learn(self, trial: Trial) -> None:
        """Keep the better fit of a system, and forget what was built on a worse one."""
        if trial.names in self.known and self.known[trial.names].rmse * BETTER < trial.rmse:
            return
        self.known[trial.names] = trial
        for names in [names for names in self.known if names > trial.names]:
            if self.known[names].rmse * BETTER > trial.rmse:
                del self.known[names]

    def _ask(self, questions: Sequence[tuple], names: Sequence[frozenset[str]]) -> list[Trial]:
        """Only what is not known yet."""
        new = [place for place, key in enumerate(names) if key not in self.known]
        for place, trial in zip(new, self.crew.map([questions[place] for place in new]), strict=True):
            self.known[names[place]] = trial
        return [self.known[key] for key in names]


def with_simplest_offset(selection: Selection, trial: Trial) -> Trial:
    """The same effects with the simplest offset that the data accept: none, one for all records, one a record."""
    bench = selection.bench
    none = bench.refitted(bench.reduced(trial, RECORD_OFFSET))
    count = len(selection.candidates)
    if not selection.needed(none, trial, count):
        return none
    common = bench.extended(none, COMMON_OFFSET)
    if len(bench.stack.records) == 1 or not selection.needed(common, trial, count):
        return common
    return trial
