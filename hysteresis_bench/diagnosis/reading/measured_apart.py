"""Records that were measured apart: each has a scale of its own where a sensor was exchanged, and a delay where input
and output were started apart. No model knows of either, and the law seems wrong."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.search.selection import MISFIT
from hysteresis_bench.kernels.root_mean_square import rms
from hysteresis_bench.signals import Record

HALVES = ("first", "second")
OF_THE_LARGEST = 0.5
"""Of the largest change of a scale or a time, from which a record, or its half, is told to have changed."""
OF_IT = 0.6
"""Share of what is left over the noise that other scales must explain to be told. Of 104 fits of a wrong law to several
records they explain that in none (half of that in 19), and in five of six of the maker's law to records whose scales
differ by up to 6 %; twice of it is never."""
ALIKE = 0.9
"""Share of what scales of halves explain, from which those of whole records are told."""
FURTHEST, DELAYS = 0.05, 50
"""Of a record's duration, by which it may have been started apart, and in how many steps that is looked for, twice."""
OF_IT_LATE = 0.8
"""As `OF_IT`, of delays. Of nine fits of the maker's law to records up to 2 % of their duration apart five reach it and
two leave no more than the noise; of 126 fits of a wrong law eight reach it, of loops of two amplitudes six, whose phase
at each it misses. With 0.6 five and eleven do, with 0.95 one and six."""


def measured_apart(
    records: Sequence[Record], simulated: Sequence[Array], residuals: Sequence[Array], floor: float
) -> str:
    """A sentence, where a scale for every record, or for each half of one, explains `OF_IT` of what is left beside a
    zero of its own, `MISFIT` times the noise or more, or a delay for every record `OF_IT_LATE` of it; else "".

    simulated : (samples,) of each record;  residuals : (scored samples,);  floor : RMS of the noise"""
    responses = {record.name: one[record.scored] for record, one in zip(records, simulated, strict=True)}
    asked = [(OF_IT, *_at_other_scales(responses, residuals, floor))]
    if len(records) > 1 and all(record.timed for record in records):
        asked.append((OF_IT_LATE, *_at_other_times(records, simulated, residuals, floor)))
    return max(((share, said) for least, share, said in asked if share >= least), default=(0.0, ""))[1]


def _at_other_scales(responses: Mapping[str, Array], residuals: Sequence[Array], floor: float) -> tuple[float, str]:
    """As of `measured_apart`, of scales;  responses, residuals : (scored samples,) of each record"""
    records = list(zip(responses, responses.values(), residuals, strict=True))
    halves = [
        (f"the {half} half of {name}", own, left)
        for name, response, residual in records
        for half, own, left in zip(HALVES, np.array_split(response, 2), np.array_split(residual, 2), strict=True)
    ]
    (share, scales), (finer, of_halves) = _rescaled(records, floor), _rescaled(halves, floor)
    of = "each record"
    if share < ALIKE * finer:
        share, scales, of = finer, of_halves, "each half of a record"
    usual = float(np.median([*scales.values()]))
    most = max(abs(scale - usual) for scale in scales.values())
    told = [
        f"{name} {scale / usual:.3g}" for name, scale in scales.items() if abs(scale - usual) > OF_THE_LARGEST * most
    ]
    return share, (
        f"A scale of its own for {of} explains {100 * share:.0f} % of it: {', '.join(told)} times as large as the "
        "others. Was a sensor exchanged, or its range?"
    )


def _rescaled(parts: Sequence[tuple[str, Array, Array]], floor: float) -> tuple[float, dict[str, float]]:
    """The share of what is left over the noise that a scale for each part explains, and the scales, by its name.

    parts : name, response and residual of each, both without their means then"""
    scales, before, after = {}, [], []
    for name, response, residual in parts:
        own, left = response - response.mean(), residual - residual.mean()
        change = float(own @ left) / (float(own @ own) or 1.0)
        scales[name] = 1.0 + change
        before.append(left)
        after.append(left - change * own)
    return _share(before, after, floor), scales


def _at_other_times(
    records: Sequence[Record], simulated: Sequence[Array], residuals: Sequence[Array], floor: float
) -> tuple[float, str]:
    """As of `measured_apart`, of delays."""
    measured = [whole[one.scored] + left for one, whole, left in zip(records, simulated, residuals, strict=True)]
    parts = list(zip(records, simulated, measured, strict=True))
    delays = [_delay(*part) for part in parts]
    usual = float(np.median(delays))
    before, after = (
        [_late(*part, late) for part, late in zip(parts, each, strict=True)] for each in ([usual] * len(parts), delays)
    )
    apart = {record.name: delay - usual for record, delay in zip(records, delays, strict=True)}
    most = max(map(abs, apart.values()))
    unit = records[0].units.get("time", "s")
    told = [
        f"{name} {rounded(abs(late))} {unit} {'later' if late > 0.0 else 'earlier'}"
        for name, late in apart.items()
        if abs(late) > OF_THE_LARGEST * most
    ]
    share = _share(before, after, floor)
    return share, (
        f"A delay of its own for each record explains {100 * share:.0f} % of it: {', '.join(told)} than the others, "
        "about. Input and output were not started together in every record, or a lag is missing that depends on the "
        "excitation."
    )


def _delay(record: Record, simulated: Array, measured: Array) -> float:
    """Of the output, in units of time."""
    furthest = FURTHEST * float(record.time[-1] - record.time[0])
    best = 0.0
    for reach in (furthest, 2.0 * furthest / DELAYS):
        tried = best + np.linspace(-reach, reach, 2 * DELAYS + 1)
        best = float(min(tried, key=lambda late: rms(_late(record, simulated, measured, late))))
    return best


def _late(record: Record, simulated: Array, measured: Array, delay: float) -> Array:
    """Errors (scored samples,) with a delay of the output, without their mean."""
    left: Array = measured - np.interp(record.time[record.scored] - delay, record.time, simulated)
    return np.asarray(left - left.mean())


def _share(before: Sequence[Array], after: Sequence[Array], floor: float) -> float:
    """Of what is left over the noise, what is explained; 0 where that is too little to tell."""
    missed, still = rms(np.concatenate(before)), rms(np.concatenate(after))
    return (missed**2 - still**2) / (missed**2 - floor**2) if missed > MISFIT * floor else 0.0
