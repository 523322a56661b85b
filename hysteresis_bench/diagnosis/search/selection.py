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

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Behind, Hypothesis
from hysteresis_bench.diagnosis.hypotheses.nested_test import NestedTest
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.fallback import predicting
from hysteresis_bench.diagnosis.search.round import Round
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage

LEVEL = 0.01
"""Of a claim where nothing is hidden, over all candidates of a round."""

MATTERS, REACHED = 1.06, 1.06
"""The RMSE without an effect over that with it: 1.06 is an effect of a third of the noise. And over the noise: up to
which a system has come down to it."""

FAINT, ALL = 1.02, 0.9
"""... or is fainter, where more than so many times the noise is left without it, and it explains so much of the excess.
A delay of a third of a sample beside a clock of its own (1.05 without it) is named so. In 71 clean made cases none is,
nor with half and twice the distance from 1 of either."""

SHARE, NAMED = 0.1, 0.5
"""Of the excess of the mean square over the noise's, which an effect must explain; and in the end, or to be exchanged
for a simpler one, it must explain more than what then remains."""

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
"""Effects that are adopted at most; to exchange and drop them twice as many steps are taken at most."""


@dataclass(eq=False)
class Selection:
    """The search's state and result.

    floor : RMS that a perfect model leaves;  candidates : names that can be tried
    forms : free forms that can stand in the place of an adopted one
    known, behind : fits by their effects;  which were left behind, and what they were to come up to
    """

    fitter: Fitter
    workers: Workers[Hypothesis]
    floor: float
    candidates: tuple[str, ...]
    forms: tuple[str, ...] = ()
    rounds: list[Round] = field(default_factory=list)
    known: dict[frozenset[str], Hypothesis] = field(default_factory=dict)
    behind: set[tuple[Any, ...]] = field(default_factory=set)
    refits: dict[frozenset[str], Hypothesis] = field(default_factory=dict)
    weighed: set[tuple[frozenset[str], str]] = field(default_factory=set)

    def run(self, base: Hypothesis, most: int = MOST) -> Hypothesis:
        """From the bare model to the last effect that passes, `named` or not; `most` at the most."""
        current = base
        visited = {current.names: current.rmse}
        while True:
            found = self.tried_on(current) if len(self.adopted(current)) < most else None
            self.rounds += [found] if found else []
            if found and found.chosen:
                better = self.settled(self.refitted(found.hypotheses[found.chosen]))
            else:
                better = self.exchanged(current) or (found and self._paired(found, most)) or current
            if better.rmse > BETTER * visited.get(better.names, np.inf):
                return current
            current = better
            visited[current.names] = current.rmse

    def adopted(self, hypothesis: Hypothesis) -> tuple[str, ...]:
        return tuple(sorted(hypothesis.names & set(self.candidates)))

    def alternatives(self, current: Hypothesis, name: str) -> dict[str, Hypothesis]:
        """The systems with another effect in the place of an adopted one; of a free form, also another free form."""
        more = [form for form in self.forms if name in self.forms and not self.fitter.stack.effect(form).estimates]
        others = self._extensions(self.without(current, name), current, more)
        return self._sought({key: one for key, one in others.items() if not self.fitter.drowned(one, key)})

    def rivals(self, current: Hypothesis, name: str) -> dict[str, Hypothesis]:
        """What would do as well in the place of an adopted effect, or near the noise better by too little for it."""
        others = self.alternatives(current, name)
        better = current.cv_rmse if current.rmse <= MISFIT * self.floor else 0.0
        return {key: one for key, one in others.items() if one.cv_rmse < better or self.tied(current, one)}

    def without(self, hypothesis: Hypothesis, name: str) -> Hypothesis:
        return self._reduced(hypothesis, [name])[0]

    def with_each(self, hypothesis: Hypothesis, names: Sequence[str]) -> list[Hypothesis]:
        return [*self._extended([(hypothesis, name) for name in names]).values()]

    def compared(self, smaller: Hypothesis, larger: Hypothesis) -> tuple[NestedTest, float]:
        """The nested-model test, and by how many standard errors the larger system wins on blocks left out."""
        return self.fitter.test(smaller, larger), advantage(larger.left_out, smaller.left_out, self.fitter.blocks)

    def needed(self, smaller: Hypothesis, larger: Hypothesis, candidates: int = 1) -> bool:
        """Does the larger system pass the three tests against the smaller?"""
        share = self.share(smaller, larger)
        matters = smaller.rmse > MATTERS * max(larger.rmse, self.floor / MATTERS**2)
        faint = smaller.rmse > FAINT * self.floor and share > ALL
        return (
            (matters or faint)
            and share > SHARE
            and advantage(larger.left_out, smaller.left_out, self.fitter.blocks) > CLEAR
            and self.fitter.test(smaller, larger).p * candidates < LEVEL
        )

    def excess(self, hypothesis: Hypothesis) -> float:
        """The mean square that a system leaves over the noise; below 0 where it leaves less."""
        return hypothesis.rmse**2 - self.floor**2

    def share(self, smaller: Hypothesis, larger: Hypothesis) -> float:
        """Of the mean square that the smaller system leaves over the noise, what the larger one explains."""
        excess = self.excess(smaller)
        return (smaller.rmse**2 - larger.rmse**2) / excess if excess > 0.0 else 1.0

    def tied(self, one: Hypothesis, other: Hypothesis) -> bool:
        """Do the data not tell them apart? Where both leave much more than the noise, the difference of two wrong
        systems is no evidence, however significant: it has to be a good part of what is left."""
        gain = advantage(one.left_out, other.left_out, self.fitter.blocks)
        ratio = other.cv_rmse / one.cv_rmse if one.cv_rmse > 0 else 1.0
        apart = one.apart(other)
        worse, better = (one, other) if one.rmse > other.rmse else (other, one)
        if better.rmse > MISFIT * self.floor and self.share(worse, better) < CLEARLY:
            return apart < better.rmse
        noise = max(self.floor, one.rmse)
        similar = apart < CLOSE * noise and ratio < ALIKE and 1 / ratio < ALIKE
        # that a richer system is a little better is no evidence for it, nor what nobody hears, however significant
        unheard = one.heard_apart(other, noise) < CLEAR
        return similar and (abs(gain) < CLEAR or unheard or len(better.values) > len(worse.values))

    def simplest(self, hypotheses: Sequence[Hypothesis]) -> Hypothesis:
        """Of the best and those tied with it, those with fewest parameters (what is estimated anew on every record, or
        offered by a model inside its state equation, only where nothing else does as well); of these, of the best and
        those tied with it, the alphabetically first. Where the model is wrong, none that predicts records left out
        much worse."""
        for key in (self._plainness, lambda hypothesis: sorted(hypothesis.names)):
            best = min(hypotheses, key=lambda hypothesis: hypothesis.cv_rmse)
            alike = [one for one in hypotheses if one is best or self.tied(best, one)]
            if alike[0].rmse > MISFIT * self.floor:
                alike = predicting(self.fitter, alike, NAMED)
            least = min(map(key, alike))
            hypotheses = [hypothesis for hypothesis in alike if key(hypothesis) == least]
        return hypotheses[0]

    def _plainness(self, hypothesis: Hypothesis) -> list[int]:
        return [
            sum(self.fitter.stack.effect(form).estimates for form in self.forms if form in hypothesis.names),
            any("." in name for name in hypothesis.at_bound),  # an effect's own, not the law's
            len(hypothesis.values),
            len(hypothesis.names & set(self.fitter.stack.model.offers)),
        ]

    def tried_on(self, current: Hypothesis) -> Round:
        """Every candidate on top of a system, and which should join."""
        hypotheses = self._extensions(current)
        if min((one.rmse for one in hypotheses.values()), default=0.0) > REACHED * self.floor:
            hypotheses = self._sought(hypotheses)
        tests = {name: self.fitter.test(current, hypothesis) for name, hypothesis in hypotheses.items()}
        passed = {name: t for name, t in hypotheses.items() if self.needed(current, t, len(self.candidates))}
        winner = self.simplest(list(passed.values())) if passed else None
        chosen = next((name for name, hypothesis in passed.items() if hypothesis is winner), "")
        return Round(current, hypotheses, tests, chosen)

    def _paired(self, found: Round, most: int) -> Hypothesis | None:
        """Two effects at once, where the model is wrong and no single one passes: what one of them leaves may hide
        the other."""
        current, count = found.current, len(self.candidates)
        if current.rmse < MISFIT * self.floor or len(self.adopted(current)) + 2 > most:
            return None
        leaders = sorted(found.hypotheses.values(), key=lambda hypothesis: hypothesis.cv_rmse)[:LEADERS]
        pairs = [pair for leader in leaders for pair in self._extensions(leader).values()]
        best = min(pairs, key=lambda hypothesis: hypothesis.cv_rmse, default=current)
        if not self.needed(current, best, count * (count - 1) // 2) or self.share(current, best) < NAMED:
            return None
        return self.settled(self.refitted(best))

    def settled(self, current: Hypothesis) -> Hypothesis:
        """Exchange adopted effects for better ones, and drop those that are not needed, until neither helps."""
        for _ in range(2 * MOST):
            better = self._dropped(current)
            if better is None and current.rmse > REACHED * self.floor:
                better = self.exchanged(current)
            if better is None:
                return current
            current = better
        return current

    def named(self, current: Hypothesis) -> Hypothesis:
        """Without the effects that explain less than what is left beside them, the least telling first."""
        while names := self.adopted(current):
            least = min(self._reduced(current, names), key=lambda hypothesis: self.share(hypothesis, current))
            if self.share(least, current) > NAMED:
                break
            current = self.exchanged(least) or least
        return current

    def _dropped(self, current: Hypothesis) -> Hypothesis | None:
        smaller = self._reduced(current, self.adopted(current))
        spare = [hypothesis for hypothesis in smaller if not self.needed(hypothesis, current)]
        return min(spare, key=lambda hypothesis: hypothesis.cv_rmse) if spare else None

    def exchanged(self, current: Hypothesis) -> Hypothesis | None:
        for name in self.adopted(current):
            best = self.simplest([current, *self.alternatives(current, name).values()])
            if best is not current and best.cv_rmse < ALIKE * current.cv_rmse:
                clear = advantage(best.left_out, current.left_out, self.fitter.blocks) > CLEAR
                more = len(best.values) - len(current.values)
                better = (clear or more < 0) and self.share(current, best) > (NAMED if more > 0 else 0.0)
                if better or self.tied(current, best):
                    return self.refitted(best)
        return None

    def _extensions(
        self, hypothesis: Hypothesis, instead_of: Hypothesis | None = None, more: Sequence[str] = ()
    ) -> dict[str, Hypothesis]:
        """instead_of : a system with one effect more, in the place of which others are tried;  more : candidates"""
        taken = hypothesis.names | (instead_of.names if instead_of else frozenset())
        names = [name for name in dict.fromkeys((*self.candidates, *more)) if name not in taken]
        other = (instead_of.values, instead_of.rmse) if instead_of else ()
        return self._extended([(hypothesis, name, *other) for name in names])

    def _sought(self, hypotheses: dict[str, Hypothesis]) -> dict[str, Hypothesis]:
        """Contenders are fitted again from other starts: a system is as good as its best fit, however come upon."""
        least = min((hypothesis.rmse for hypothesis in hypotheses.values()), default=0.0)
        ranked = sorted(hypotheses, key=lambda name: hypotheses[name].rmse)
        best = [name for name in ranked[:CONTENDERS] if hypotheses[name].rmse < WITHIN * least]
        close = [name for name in best if hypotheses[name].names not in self.refits]
        again = self.workers.map([("refitted", hypotheses[name]) for name in close])
        found = {hypothesis.names: hypothesis for hypothesis in again}
        self.known |= found
        self.refits |= found
        return {**hypotheses, **dict(zip(close, again, strict=True))}

    def refitted(self, hypothesis: Hypothesis) -> Hypothesis:
        """Fitted again from other starts, unless these led to it already."""
        if self.refits.get(hypothesis.names) is not hypothesis:
            (self.refits[hypothesis.names],) = self.workers.map([("refitted", hypothesis)])
        return self.refits[hypothesis.names]

    def _reduced(self, current: Hypothesis, names: Sequence[str]) -> list[Hypothesis]:
        """Without one effect each, fitted from here even where it is known: from here it may fit better."""
        weighed = {name for name in names if (current.names, name) in self.weighed}
        new = [name for name in names if name not in weighed or current.names - {name} not in self.known]
        for name, hypothesis in zip(new, self.workers.map([("reduced", current, name) for name in new]), strict=True):
            self.weighed.add((current.names, name))
            self._learn(hypothesis)
        return [self.known[current.names - {name}] for name in names]

    def _learn(self, hypothesis: Hypothesis) -> None:
        """Keep the better fit of a system, and forget what was built on a worse one."""
        if hypothesis.names in self.known and self.known[hypothesis.names].rmse * BETTER < hypothesis.rmse:
            return
        self.known[hypothesis.names] = hypothesis
        larger = [names for names in self.known if names > hypothesis.names]
        for names in [names for names in larger if self.known[names].rmse * BETTER > hypothesis.rmse]:
            del self.known[names]

    def _extended(self, questions: Sequence[tuple[Any, ...]]) -> dict[str, Hypothesis]:
        """By the name that joins, those that were not left behind. Asked is what is not known yet."""
        keys = [(smaller.names | {name}, *of[1:]) for smaller, name, *of in questions]
        new = [place for place, key in enumerate(keys) if key[0] not in self.known and key not in self.behind]
        for place, found in zip(new, self.workers.map([("extended", *questions[one]) for one in new]), strict=True):
            if isinstance(found, Behind):
                self.behind.add(keys[place])
            else:
                self.known[found.names] = found
        return {name: self.known[s.names | {name}] for s, name, *_ in questions if s.names | {name} in self.known}
