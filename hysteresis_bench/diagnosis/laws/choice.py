"""Which of the fitted laws is taken, and why, in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.hypotheses.cross_validation import CLEAR, advantage
from hysteresis_bench.diagnosis.laws.law import Law
from hysteresis_bench.fit.unseen.left_out import cut
from hysteresis_bench.signals import Record

ALONE = 2.0
"""Blocks left out of a lone record have its own amplitude, so that a richer law wins them and may yet fail at another
one. There the law of the fewest parameters is taken whose error is at most so many times the best one's. With 1 it is
the richest of the measured devices' laws, and its error at another amplitude two to three times as large (piezo stack,
friction damper, electrical steel); with 4 laws are taken that miss the shape of the loop."""


def choose(laws: Sequence[Law], without: Array, records: Sequence[Record]) -> tuple[str, str]:
    """The law's name, and a sentence; the name is "" where no law beats the polynomial.

    laws : the best first;  without : errors of the polynomial without memory, as `Law.unseen`;  records : fitted ones
    """
    fitted = [law for law in laws if law.unseen.size]
    plain = float(np.sqrt(np.mean(without**2)))
    if not fitted or fitted[0].rmse >= plain:
        return "", "No law predicts what it did not see better than a cubic polynomial of the input, without memory."
    best = fitted[0]
    told = f"{best.model} predicts best what it did not see: {best.rmse / plain:.3g} of the polynomial's error"
    if len(records) == 1:
        chosen = min((law for law in fitted if law.rmse <= ALONE * best.rmse), key=_simplest)
        why = "one record cannot show how a law predicts another excitation, so that the simplest is taken that is near"
    else:
        blocks = cut(records)
        as_good = [law for law in fitted if law is best or advantage(best.unseen, law.unseen, blocks) < CLEAR]
        chosen = min(as_good, key=_simplest)
        why = "the paired test over blocks cannot tell them apart"
    if chosen is best:
        return best.model, f"{told}."
    return chosen.model, (
        f"{told}. {chosen.model} is taken, {chosen.rmse / plain:.3g} with {chosen.parameters} parameters in place of "
        f"{best.parameters}: {why}."
    )


def _simplest(law: Law) -> tuple[int, float]:
    return law.parameters, law.rmse
