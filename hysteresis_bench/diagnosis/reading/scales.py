"""Has the output of every record a scale of its own, as after a sensor or its range was exchanged?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from statistics import median_low

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.reading.in_turn import Own, own_of_each
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.signals import Record

SCALED = (
    "The outputs of the records have scales of their own: {} times as large as those of the others, and were divided "
    "by that, also where they were held out. Was a sensor exchanged, or its range? `predict` answers in the scale of "
    "the others."
)

TOLD = 0.002
"""From 1, of a scale that is told."""


def scales_of_each(found: Found, held_out: Sequence[Record]) -> Own:
    """By the name of each record, relative to the middle one of those that were fitted; empty where scales do not come
    down to the noise, or nothing asks for any."""
    records = found.thin.stack.records

    def estimated(system: System, values: Array) -> Own:
        scales = {one.name: _scale(one, system, values) for one in (*records, *held_out)}
        usual = median_low([scales[record.name] for record in records])
        return {name: scale / usual for name, scale in scales.items()}

    return own_of_each(found, scaled, estimated, len(records) - 1) if len(records) > 1 else {}


def scaled(records: tuple[Record, ...], scales: Mapping[str, float]) -> tuple[Record, ...]:
    """Divided by the scales of their outputs; those without one as they are."""
    return tuple(
        one if one.output is None else replace(one, output=one.output / scales.get(one.name, 1.0)) for one in records
    )


def scales_told(records: Sequence[Record], scales: Mapping[str, float]) -> str:
    """The note."""
    names = [record.name for record in records if abs(scales.get(record.name, 1.0) - 1.0) > TOLD]
    return SCALED.format(listed([f"{name} {scales[name]:.3g}" for name in names]))


def _scale(record: Record, system: System, values: Array) -> float:
    """Of what was measured over the response, both without their means;  values : (dimension,), in units"""
    response = system.respond(record, values[:, None])[record.scored, 0]
    own, measured = response - response.mean(), record.measured - record.measured.mean()
    return float(own @ measured) / (float(own @ own) or 1.0)
