"""What every record has for itself, and a system that follows all of them, fitted in turn.

No model knows of what a record has for itself, and fitted to all of them it bends its shape to that: what it leaves
then hides the cause. In turn, both come to their own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import MISFIT, REACHED
from hysteresis_bench.diagnosis.search.sets import claims
from hysteresis_bench.signals import Record

ROUNDS, FALLS, STILL = 12, 0.95, 0.999
"""So often both are fitted in turn, at most: as long as what is left falls to this share of it, before it is near the
noise and after. In eight made cases, three of them without anything of the kind, half and twice of ROUNDS and of the
distances from 1 of the others change no number by more than 1e-3."""

Own = dict[str, float]
"""What is a record's own, by names."""

Read = Callable[[tuple[Record, ...], Own], tuple[Record, ...]]
"""Records without what is their own."""

Estimated = Callable[[System, Array], Own]
"""From a system and its values (dimension,), in units."""


def own_of_each(found: Found, read: Read, estimated: Estimated, more: int) -> Own:
    """With which the law alone, or with what was found around it, comes down to the noise; empty where neither does, or
    nothing asks for it: what was found is near the noise with one formula, or with fewer parameters.

    more : numbers that are estimated"""
    floor = found.selection.floor
    near = found.best.rmse <= MISFIT * floor
    simple = claims(found.best) < 2 and not forms_of(found.selection.adopted(found.best))
    fewer = len(found.best.values) - len(found.base.values) <= more
    if found.base.rmse <= MISFIT * floor or (near and (simple or fewer)):
        return {}
    systems = (found.base, *(() if near else (found.best,)))
    tried = (_in_turn(found.thin, one, REACHED * floor, read, estimated) for one in systems)
    return next((own for own in tried if own), {})


def _in_turn(fitter: Fitter, system: Hypothesis, limit: float, read: Read, estimated: Estimated) -> Own:
    own, last = Own(), np.inf
    for _ in range(ROUNDS):
        beside = replace(fitter, stack=replace(fitter.stack, records=read(fitter.stack.records, own)))
        system = beside.followed(system)
        if system.rmse > (STILL if system.rmse <= limit else FALLS) * last:
            break
        last = system.rmse
        own = estimated(*beside.fitted(system))
    return own if last <= limit else {}
