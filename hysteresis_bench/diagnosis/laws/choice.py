"""Which of the fitted laws is taken, and why, in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.laws.law import Law
from hysteresis_bench.diagnosis.laws.left_out import LeftOut
from hysteresis_bench.diagnosis.laws.smoothing import Rough


def choose(laws: Sequence[Law], without: Array, out: LeftOut) -> tuple[str, str]:
    """The law's name, and a sentence; the name is "" where no law beats the polynomial.

    laws : the best first;  without : errors of the polynomial without memory, as `Law.unseen`;  out : what was left out
    """
    fitted = [law for law in laws if law.unseen.size]
    plain = float(np.sqrt(np.mean(without**2)))
    if not fitted or fitted[0].rmse >= plain:
        return "", "No law predicts what it did not see better than a cubic polynomial of the input, without memory."
    best = fitted[0]
    told = f"{best.model} predicts best what it did not see: {best.rmse / plain:.3g} of the polynomial's error"
    as_good = [law for law in fitted if law is best or out.as_good(best.unseen, law.unseen)]
    if out.telling:
        chosen = min(as_good, key=_simplest)
        why = "the paired test over blocks cannot tell them apart"
    else:
        # as smooth as is near, a density is the simplest of its kind already
        chosen = best if isinstance(_built(best), Rough) else min(as_good, key=_safest)
        why = (
            "so few excitations cannot show how a law predicts another one, so that of the laws that are near the "
            "simplest with return-point memory is taken"
        )
    if chosen is best:
        return best.model, f"{told}."
    return chosen.model, (
        f"{told}. {chosen.model} is taken, {chosen.rmse / plain:.3g} with {chosen.parameters} parameters in place of "
        f"{best.parameters}: {why}."
    )


def _simplest(law: Law) -> tuple[int, float]:
    return law.parameters, law.rmse


def _safest(law: Law) -> tuple[bool, int, float]:
    """Inner loops of most devices return to where they left, whatever the data show of it."""
    return "return-point" not in _built(law).properties, *_simplest(law)


def _built(law: Law) -> Model:
    model: Model = registry.build("models", law.model, {})
    return model
