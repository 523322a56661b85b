"""Has the output of every record a scale of its own, as after a sensor or its range was exchanged?

No model knows of that: fitted to all of them, each record bends the law's shape, and what is left then tells the scales
no more. So the law and the scales are fitted in turn, and where the law alone, or with what was found around it, comes
down to the noise so, the records are divided by their scales.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from statistics import median_low

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import MISFIT, REACHED
from hysteresis_bench.diagnosis.search.sets import claims
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.signals import Record

SCALED = (
    "The outputs of the records have scales of their own: {} times as large as those of the others, and were divided "
    "by that, also where they were held out. Was a sensor exchanged, or its range? `predict` answers in the scale of "
    "the others."
)

TOLD = 0.002
"""From 1, of a scale that is told."""

ROUNDS, FALLS, STILL = 12, 0.95, 0.999
"""So often law and scales are fitted in turn, at most: as long as what is left falls to this share of it, before it is
near the noise and after."""


def scales_of_each(found: Found, held_out: Sequence[Record]) -> dict[str, float]:
    """By the name of each record, relative to the middle one of those that were fitted; empty where scales do not come
    down to the noise, or nothing asks for any: what was found is near it with one formula, or with fewer parameters."""
    floor, more = found.selection.floor, len(found.thin.stack.records) - 1
    near = found.best.rmse <= MISFIT * floor
    simple = claims(found.best) < 2 and not forms_of(found.selection.adopted(found.best))
    fewer = len(found.best.values) - len(found.base.values) <= more
    if not more or found.base.rmse <= MISFIT * floor or (near and (simple or fewer)):
        return {}
    systems = (found.base, *(() if near else (found.best,)))
    tried = (_scales(found.thin, one, REACHED * floor, held_out) for one in systems)
    return next((scales for scales in tried if scales), {})


def scaled(records: tuple[Record, ...], scales: Mapping[str, float]) -> tuple[Record, ...]:
    """Divided by the scales of their outputs; those without one as they are."""
    return tuple(
        one if one.output is None else replace(one, output=one.output / scales.get(one.name, 1.0)) for one in records
    )


def scales_told(scales: Mapping[str, float]) -> str:
    """The note."""
    return SCALED.format(listed([f"{name} {scale:.3g}" for name, scale in scales.items() if abs(scale - 1.0) > TOLD]))


def _scales(fitter: Fitter, system: Hypothesis, limit: float, held_out: Sequence[Record]) -> dict[str, float]:
    records, last = fitter.stack.records, np.inf
    scales = dict.fromkeys([record.name for record in records], 1.0)
    for _ in range(ROUNDS):
        own = replace(fitter, stack=replace(fitter.stack, records=scaled(records, scales)))
        system = own.followed(system)
        if system.rmse > (STILL if system.rmse <= limit else FALLS) * last:
            break
        last, (built, values) = system.rmse, own.fitted(system)
        found = {one.name: _scale(one, built, values) for one in (*records, *held_out)}
        usual = median_low([found[record.name] for record in records])
        scales = {name: scale / usual for name, scale in found.items()}
    return scales if last <= limit else {}


def _scale(record: Record, system: System, values: Array) -> float:
    """Of what was measured over the response, both without their means;  values : (dimension,), in units"""
    response = system.respond(record, values[:, None])[record.scored, 0]
    own, measured = response - response.mean(), record.measured - record.measured.mean()
    return float(own @ measured) / (float(own @ own) or 1.0)
