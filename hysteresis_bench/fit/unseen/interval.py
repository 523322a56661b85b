"""How far a prediction may be from a measurement: conformal half-widths, from errors of fits that left records out.

Every fitted record is predicted by a fit to the others, every held-out one by the fit itself. Where they are alike with
the next record, the largest of their own quantiles holds that share of its samples with a probability of records /
(records + 1), whatever the noise or the law [1]. Ours: a record, not a sample, is what is exchanged, as errors of
neighbouring samples are alike; and the fits differ by the record that is left out, as in the jackknife. Where a zero or
the like is estimated on every record, its output is needed for that: without one stands what the fitted records have in
common, and the interval is wider by how far they lie from it. Ours too: a record on which a curve of the time, the path
or the temperature would be extrapolated has no say where others have.

[1] V. Vovk, A. Gammerman, G. Shafer, Algorithmic Learning in a Random World, Springer (2005); for records of several
samples R. Dunn, L. Wasserman, A. Ramdas, J. Am. Stat. Assoc. 118 (2023) 2491.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.data.units import rounded
from hysteresis_bench.fit.json_values import number_of, value_of
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.unseen.left_out import cut, left_out_errors, unseen_errors
from hysteresis_bench.fit.unseen.whole import extrapolated
from hysteresis_bench.kernels.divided_differences import divided_differences
from hysteresis_bench.kernels.longest_rest import longest_rest
from hysteresis_bench.kernels.white_noise import MEDIAN
from hysteresis_bench.signals import Record

LEVELS = (50, 68, 90, 95, 99)
"""Percent of a record's samples."""

LOW, HIGH = "output_low", "output_high"
"""Columns beside a prediction."""

BEYOND = 1.25
"""Times the fastest, or slowest, fitted record, from which an input counts as of another speed, and times the longest
one from which it lasts longer."""
RESTING = 2.0
"""Times the longest rest of the fitted inputs from which one rests longer. In made records like the fitted ones it is
0.6 to 1.2 times as long (1.2 with noise on the input), in held-out ones of 12 measured devices 1.8 at most, in
staircases 2.5 to 4. With half of this 4 of these devices are told of, with twice this no staircase is."""
SLACK, SPAN = 0.01, 6.0
"""Share of an input's range that counts as nothing: beyond the fitted ones, and in a rest; there with so many times the
RMS noise of the input, which lie between the highest and the lowest of some hundred samples of it."""


def further(record: Record, ranges: Sequence[float]) -> str:
    """How much of a record goes beyond the fitted inputs, a clause; empty where nothing does, or they are not known."""
    if not ranges:
        return ""
    low, high = ranges
    slack = SLACK * (high - low)
    outside = float(np.mean((record.input < low - slack) | (record.input > high + slack)))
    beyond = f"of its samples lie beyond the fitted inputs ({low:.4g} to {high:.4g})"
    return f"{record.name}: {outside:.0%} {beyond}" if outside else ""


@dataclass(frozen=True)
class Interval:
    """half_widths : unit of the output, a level of `LEVELS` each;  unmeasured : of records whose output is not known
    records : how many were predicted unseen; 0 where a lone record's own blocks were
    speeds : lowest and highest RMS rate of the fitted inputs, their unit per unit of time
    duration, rest : of the longest fitted record, and the longest that an input stays where it is, in units of time;
        infinite in files of before they were kept
    """

    half_widths: Mapping[int, float]
    unmeasured: Mapping[int, float]
    records: int
    speeds: tuple[float, float]
    duration: float = np.inf
    rest: float = np.inf

    def around(self, output: Array, level: int, measured: bool) -> dict[str, Array]:
        """The columns `LOW` and `HIGH`, (samples,), of a record whose output was measured, or was not."""
        half = (self.half_widths if measured else self.unmeasured)[level]
        return {LOW: output - half, HIGH: output + half}

    def words(self, level: int, unit: str, measured: bool = True) -> str:
        """What it promises of records whose output was measured, or was not."""
        half = (self.half_widths if measured else self.unmeasured)[level]
        said = f"{level} % interval: ±{half:.3g}{'' if unit == '1' else f' {unit}'}"
        if half != self.half_widths[level]:
            said += (
                " where no output was measured, as what every record has of its own, such as a zero, is not known there"
            )
        if not self.records:
            return (
                f"{said}, from blocks left out of the one record that was fitted: it holds for excitations like that "
                f"one, and nothing is known of others. Fit several records, or hold one out."
            )
        share, count = self.records / (self.records + 1), "1 record" if self.records == 1 else f"{self.records} records"
        return (
            f"{said}, the widest of {count} predicted unseen: of the next one like them it holds {level} % of the "
            f"samples or more with a probability of {share:.0%}."
        )

    def beyond(self, record: Record, ranges: Sequence[float]) -> Iterator[str]:
        """Why it need not hold for a record, a sentence each; ranges : of the fitted inputs, in the record's unit."""
        if outside := further(record, ranges):
            yield f"{outside}; there the interval need not hold."
        if not record.timed:
            return
        slow, fast = self.speeds
        if not slow / BEYOND <= (own := speed(record)) <= fast * BEYOND:
            limit, called = (fast, "fastest") if own > fast else (slow, "slowest")
            yield (
                f"{record.name}: its input moves at {rounded(own / limit)} times the {called} fitted record's speed; "
                f"where the device knows a rate, the interval need not hold."
            )
        if (own := duration(record)) > BEYOND * self.duration:
            yield (
                f"{record.name}: it lasts {rounded(own / self.duration)} times as long as the longest fitted record; "
                f"where the device changes with time or with use, the interval need not hold."
            )
        if (own := rest(record)) > RESTING * self.rest:
            yield (
                f"{record.name}: its input stays where it is {rounded(own / self.rest)} times as long as any fitted "
                f"one; where the device creeps or relaxes, the interval need not hold."
            )

    def as_dict(self) -> dict[str, Any]:
        """For model.json."""
        return {
            "half_widths": {str(level): half for level, half in self.half_widths.items()},
            "unmeasured": {str(level): half for level, half in self.unmeasured.items()},
            "records": self.records,
            "speeds": list(self.speeds),
            **{key: one for key, one in (("duration", self.duration), ("rest", self.rest)) if np.isfinite(one)},
        }


def interval_of(content: Any) -> Interval | None:
    """From model.json, which may have none. Raises KeyError, TypeError or ValueError where it is wrong."""
    if content is None:
        return None
    halves = value_of(content, "half_widths", dict)
    slow, fast = value_of(content, "speeds", list)
    widths = {level: number_of(halves, str(level)) for level in LEVELS}
    # files of before tell nothing of records without an output
    others = value_of(content, "unmeasured", dict) if "unmeasured" in content else halves
    wider = {level: number_of(others, str(level)) for level in LEVELS}
    if min(*widths.values(), *wider.values()) < 0.0:
        raise ValueError("interval: half_widths and unmeasured must not be below 0")
    longest = {key: number_of(content, key) for key in ("duration", "rest") if key in content}
    return Interval(widths, wider, value_of(content, "records", int), (float(slow), float(fast)), **longest)


def interval(
    problem: Problem, values: Array, held_out: Sequence[Record], system: System, left_out: Array | None = None
) -> Interval:
    """Of a fit; values : (dimension,), in units;  held_out : records that it has not seen.

    system : the problem's, with what its effects remember of the fitted records
    left_out : (scored samples,) errors by fits without them, where they are known; None: they are made here"""
    records = problem.records
    point = np.clip(problem.space.to_unit(values[:, None])[:, 0], 0.0, 1.0)
    alone = len(records) == 1
    left = left_out
    if left is None:
        left = left_out_errors(problem, point, cut(records)) if alone else unseen_errors(problem, point)
    column = values[:, None]
    new = [record.measured - problem.system.respond(record, column)[record.scored, 0] for record in held_out]
    beyond = extrapolated((effect for _, effect in problem.system.effects), records)
    told = list(zip(records, split(left, records), strict=True))
    kept = [one for k, one in enumerate(told) if k not in beyond] or told
    kept += zip(held_out, new, strict=True)
    widths = _widths([error for _, error in kept])
    blind = _widths([error + _own(problem.system, system, record, column) for record, error in kept])
    unmeasured = {level: max(width, blind[level]) for level, width in widths.items()}
    speeds = [speed(record) for record in records]
    # of less than a sample's step nothing is known
    rests = [max(rest(record), float(np.median(np.diff(record.time[record.scored])))) for record in records]
    longest = max(map(duration, records))
    return Interval(widths, unmeasured, len(kept) - alone, (min(speeds), max(speeds)), longest, max(rests))


def _widths(errors: Sequence[Array]) -> dict[int, float]:
    return {level: max(float(np.quantile(np.abs(one), level / 100.0)) for one in errors) for level in LEVELS}


def _own(system: System, remembering: System, record: Record, column: Array) -> Array:
    """What the effects estimate of a record's output, beyond what they remember of others: (scored samples,)."""
    unmeasured = replace(record, output=None)
    change: Array = system.respond(record, column) - remembering.respond(unmeasured, column)
    return change[record.scored, 0]


def speed(record: Record) -> float:
    """RMS rate of the scored input, its unit per unit of time."""
    time, driven = record.time[record.scored], record.input[record.scored]
    return float(np.sqrt(np.mean((np.diff(driven) / np.diff(time)) ** 2))) if time.size > 1 else 0.0


def duration(record: Record) -> float:
    """Of the scored part, unit of time."""
    time = record.time[record.scored]
    return float(time[-1] - time[0])


def rest(record: Record) -> float:
    """The longest time within which the scored input stays where it is, unit of time."""
    time = np.ascontiguousarray(record.time[record.scored])
    driven = np.ascontiguousarray(record.input[record.scored], dtype=float)
    left = divided_differences(time, driven, 4, 1) if time.size > 4 else np.zeros(1)
    noise = float(np.median(np.abs(left))) / MEDIAN
    return float(longest_rest(time, driven, SLACK * float(np.ptp(driven)) + SPAN * noise))
