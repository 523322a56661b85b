"""Do the selected effects help where they were not fitted? Those that do not are given up.

Held-out records have no part in this; only fitted excitations are left out in turn (fit/unseen/excitations.py).

1. The bare model, and the systems that grow from it by one adopted effect after the other, predict what was left out.
   Where the last one does worse than the bare model, the one that does it best is kept. Every excitation counts alike:
   on one that goes beyond all others what is undetermined without it runs wild, with whatever effect. Those count on
   which a curve of the time, the path or the temperature would be extrapolated only where all are such.
2. An effect with which any excitation between the others is predicted clearly worse than without it leaves.
3. Of one loop nothing can be left out. What follows such a path better may be any curve, and a law that does not come
   down to the noise asks for one. Effects stay there only if with them the noise is nearly reached.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage
from hysteresis_bench.kernels.root_mean_square import rms

WORSE = 1.06
"""Times the error without an effect, or the noise, from which it makes a prediction worse: where a system no longer
counts as down to the noise (`selection.REACHED`)."""


@dataclass(frozen=True)
class Fallback:
    """What was given up. dropped : names, in the order in which they had been adopted
    selected, kept, bare : RMSE of what had been selected, of what is kept, of the bare model, on excitations left out
    (geometric mean over them); on what was fitted where nothing could be
    tested : whether an excitation could be left out
    worse_on : of effects that made an excitation worse: its record's name
    """

    dropped: tuple[str, ...]
    selected: float
    kept: float
    bare: float
    tested: bool = True
    worse_on: tuple[str, ...] = ()

    def and_then(self, later: Fallback) -> Fallback:
        """With what was given up of what was kept."""
        return replace(
            self,
            dropped=(*self.dropped, *later.dropped),
            kept=later.kept,
            worse_on=tuple(dict.fromkeys((*self.worse_on, *later.worse_on))),
        )

    def told(self, floor: float) -> str:
        """A sentence;  floor : RMS of the noise"""
        were, them = was_or_were(self.dropped)
        they = "it" if them == "it" else "they"
        said = f"{listed(self.dropped)} had been selected and {were} given up:"
        if not self.tested:
            with_them, without = (f"{rounded(left / floor)} times the noise" for left in (self.selected, self.kept))
            return (
                f"{said} no part of what was fitted is an excitation of its own that could be left out to test {them}, "
                f"and {they} may make up for the law, which leaves {with_them} with {them} and {without} without. Fit "
                "a second record, of another amplitude or speed."
            )
        worse = f" {listed(self.worse_on)} was predicted clearly worse with than without." if self.worse_on else ""
        return (
            f"{said} on what was left out of the fits in turn the RMSE (geometric mean) was {self.selected:.3g} with "
            f"{them} and {self.kept:.3g} without (bare: {self.bare:.3g}).{worse}"
        )


def was_or_were(names: Sequence[str]) -> tuple[str, str]:
    """The verb, and the pronoun, of so many."""
    return ("was", "it") if len(names) == 1 else ("were", "them")


Grown = Sequence[tuple[str, Hypothesis]]


def fall_back(fitter: Fitter, base: Hypothesis, order: Grown, floor: float) -> Fallback | None:
    """None where the last system predicts no worse than the bare model, or where nothing can be left out, unless of one
    loop it leaves much more than the noise.

    order : the adopted effects, each with the system that it completes, the last one the selected system
    floor : RMS that a perfect model leaves
    """
    if not order:
        return None
    last = order[-1][1]
    if fitter.excitations.only_one:
        names = tuple(name for name, _ in order)
        return Fallback(names, last.rmse, base.rmse, base.rmse, tested=False) if last.rmse > WRONG * floor else None
    if not fitter.excitations.apart:
        return None
    judged = _judged(fitter, last)
    selected, bare = _predicted(fitter, last, floor, judged), _predicted(fitter, base, floor, judged)
    if selected <= bare:
        return None
    errors = [bare, *(_predicted(fitter, system, floor, judged) for _, system in order[:-1])]
    kept = int(np.argmin(errors))
    return Fallback(tuple(name for name, _ in order[kept:]), selected, errors[kept], bare)


def misleading(
    fitter: Fitter, base: Hypothesis, best: Hypothesis, without: Mapping[str, Hypothesis], floor: float
) -> Fallback | None:
    """Of the effects with which some excitation between the others is predicted clearly worse, the one that does worst.

    without : for each adopted effect, the selected system without it
    """
    judged = _judged(fitter, best)
    inner = [k for k in fitter.excitations.inner if k in judged]
    if not inner or not without:
        return None
    records = fitter.stack.records
    ours, number, blocks = fitter.unseen(best), fitter.excitations.number, fitter.blocks
    found = []
    for name, smaller in without.items():
        theirs = fitter.unseen(smaller)
        for k in inner:
            own = number == k
            more, less = rms(ours[own]), rms(theirs[own])
            if more > WORSE * max(less, floor) and advantage(theirs[own], ours[own], blocks.of(own)) > CLEAR:
                found.append((more / less, name, records[k].name))
    if not found:
        return None
    _, worst, record = max(found, key=lambda one: one[0])
    selected, kept, bare = (_predicted(fitter, one, floor, judged) for one in (best, without[worst], base))
    return Fallback((worst,), selected, kept, bare, worse_on=(record,))


def unseen_rmse(fitter: Fitter, hypothesis: Hypothesis) -> float:
    """RMSE over all fitted records, each predicted by a fit to the others; of a lone record, over its blocks."""
    return rms(fitter.unseen(hypothesis))


def predicts_better(fitter: Fitter, one: Hypothesis, other: Hypothesis, floor: float) -> bool:
    """Does it predict what can be left out better?"""
    every = fitter.excitations.apart
    return _predicted(fitter, one, floor, every) < _predicted(fitter, other, floor, every)


def predicting(fitter: Fitter, hypotheses: list[Hypothesis], worse: float) -> list[Hypothesis]:
    """Without those that predict records left out worse than the best of them, by this share of their mean square."""
    if len(hypotheses) < 2 or len(fitter.stack.records) < 2:
        return hypotheses
    squares = [unseen_rmse(fitter, hypothesis) ** 2 for hypothesis in hypotheses]
    return [one for one, square in zip(hypotheses, squares, strict=True) if (1.0 - worse) * square <= min(squares)]


def _judged(fitter: Fitter, hypothesis: Hypothesis) -> tuple[int, ...]:
    """Of the excitations that can be left out those on which none of its curves is extrapolated, or all."""
    every, beyond = fitter.excitations.apart, fitter.extrapolated(hypothesis)
    return tuple(k for k in every if k not in beyond) or every


def _predicted(fitter: Fitter, hypothesis: Hypothesis, floor: float, judged: Sequence[int]) -> float:
    """Of whole records left out, or parts of a lone one, by number: geometric mean of the RMSE of each, of which none
    counts as less than the floor."""
    left, number = fitter.apart(hypothesis), fitter.excitations.number
    each = [max(rms(left[number == k]), floor) for k in judged]
    return float(np.exp(np.mean(np.log(each))))
