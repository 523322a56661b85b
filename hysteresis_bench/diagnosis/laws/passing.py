"""Laws of loops that had settled: each is passed as often as its law needs to close it, and scored then."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.laws.law import Law, Laws
from hysteresis_bench.diagnosis.preparation import thinned, with_held_out
from hysteresis_bench.fit.settling import CLOSED, FIRST_REPEATS, passed
from hysteresis_bench.signals import Dataset

MOST = 8
"""Passes of a loop before it is scored; doubled up to there while a law does not close it."""


@dataclass(frozen=True)
class Passing:
    """Fits laws, each by itself, so that they can be fitted side by side.

    seen : as the models see it, before any loop is passed;  settles : loops are passed before they are scored
    split : a part is held out where none is, after that: what is left of a lone loop is none
    effects : known to act around every law
    """

    seen: Dataset
    settles: bool
    split: bool
    effects: tuple[str, ...] = ()
    seed: int = 0

    @cached_property
    def begun(self) -> Laws:
        """As every law begins."""
        return self._after(FIRST_REPEATS if self.settles else 0)

    def law(self, name: str) -> Law:
        """Fitted, or with the reason why not."""
        begun, passes, law = time.process_time(), FIRST_REPEATS, self.begun.law(name)
        while law.gap >= CLOSED and passes < MOST:
            passes *= 2
            law = self._after(passes).law(name, law.found)
        return replace(law, seconds=time.process_time() - begun) if law.seconds else law

    def with_dynamics(self, law: Law) -> Law:
        """As of `Laws.with_dynamics`, after as few passes as every law begins with."""
        return self.begun.with_dynamics(law)

    def with_any(self, law: Law, known: Law, asked: Callable[[Stack], Sequence[str]]) -> Law:
        """As of `Laws.with_any`, after as many."""
        return self.begun.with_any(law, known, asked)

    def _after(self, passes: int) -> Laws:
        ready = self.seen.map(lambda record: passed(record, passes))
        dataset = with_held_out(ready)[0] if self.split else ready
        return Laws(thinned(views_of(dataset.fitted)), dataset, self.effects, self.seed, ready.fitted, passes)
