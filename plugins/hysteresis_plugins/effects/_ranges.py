"""What the effects take from the ranges of records: their boxes, and why they cannot be fitted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Record

FINEST = 0.02
"""Time constants are searched down to this share of a sampling step: less leaves no trace in the samples."""

COARSE = 0.25
"""An input that moves by more than this share of its range in a typical step is not resolved in time."""

AT_REST = 0.05
"""Of the largest input, below which a record begins with none. Records begin at rest or well away from it: half or
twice of it made no difference yet."""

SHIFTED = 0.25
"""Share of the output's range from which an output is taken to be off zero. Of six made cases, stops with offsets of
0.2 to 1 range, half of it changed none; with twice it a stop at an offset of 0.4 was missed."""

SAME, PURE = 0.2, 0.99
"""Share by which frequencies may differ, and share of the power within it, for an input of one frequency. A
triangle has 0.986 in its fundamental: its harmonics are other frequencies."""


def input_span(records: Sequence[Record]) -> float:
    """Largest range of the input within one record."""
    return max(float(np.ptp(record.input)) for record in records)


def output_span(records: Sequence[Record]) -> float:
    """Largest range of the measured output within one record."""
    return max(float(np.ptp(record.measured)) for record in records)


def largest_input(records: Sequence[Record]) -> float:
    return max(float(np.max(np.abs(record.input))) for record in records)


def offset(records: Sequence[Record]) -> float:
    """About how far the output is off, unit of the output, which the law's own response is not; 0 where that is less
    than `SHIFTED` of its range, as the shape of a loop may be as much.

    What is measured where the records begin at rest, with no input; where none does, where a straight line through all
    samples has the input 0.
    """
    least = AT_REST * largest_input(records)
    first = [one.measured[0] for one in records if not one.history and abs(one.input[0]) <= least]
    if first:
        found = float(np.median(first))
    else:
        u, y = (
            np.concatenate(parts) for parts in zip(*((r.input[r.scored], r.measured) for r in records), strict=True)
        )
        spread = float(np.var(u))
        slope = float(np.mean((u - u.mean()) * y)) / spread if spread else 0.0
        found = float(y.mean()) - slope * float(u.mean())
    return found if abs(found) > SHIFTED * output_span(records) else 0.0


def fastest(records: Sequence[Record]) -> float:
    """Fastest movement of the input, unit of input over unit of time: all but a hundredth of the steps are slower."""
    return max(float(np.quantile(speeds(record), 0.99)) for record in records)


def speeds(record: Record) -> Array:
    """Of the input in every step, (samples - 1,), unit of input over unit of time."""
    return np.asarray(np.abs(np.diff(record.input)) / np.diff(record.time))


def duration(record: Record) -> float:
    return float(record.time[-1] - record.time[0])


def longest(records: Sequence[Record]) -> float:
    """Duration of the longest record, unit of time."""
    return max(duration(record) for record in records)


def finest_step(records: Sequence[Record]) -> float:
    """Median sampling step of the most finely sampled record, unit of time."""
    return min(float(np.median(np.diff(record.time))) for record in records)


def spectrum(time: Array, values: Array) -> tuple[Array, Array]:
    """Frequencies and amplitudes of an unevenly sampled signal: resampled evenly, without its mean, tapered
    and padded, so that its ends do not leak and its lines are resolved finely."""
    even = np.linspace(time[0], time[-1], time.size)
    resampled = np.interp(even, time, values)
    padded = 1 << int(np.ceil(np.log2(8 * even.size)))
    tapered = (resampled - np.mean(resampled)) * np.hanning(even.size)
    return np.fft.rfftfreq(padded, even[1] - even[0]), np.abs(np.fft.rfft(tapered, padded)) / np.sqrt(even.size)


def dominant_frequency(record: Record) -> float:
    """Frequency of the input's largest spectral line, 1 / unit of time; at least one period in the record."""
    lowest = 1.0 / duration(record)
    if np.ptp(record.input) == 0.0 or record.time.size < 4:
        return lowest
    frequencies, amplitudes = spectrum(record.time, record.input)
    peak = int(np.clip(np.argmax(amplitudes), 1, amplitudes.size - 2))
    before, here, after = np.log(amplitudes[peak - 1 : peak + 2] + np.finfo(float).tiny)
    bend = before - 2.0 * here + after
    between = 0.5 * (before - after) / bend if bend < 0.0 else 0.0  # the vertex of a parabola
    return max(lowest, float((peak + between) * frequencies[1]))


def one_frequency(records: Sequence[Record]) -> bool:
    """Is the input of all records a sine of the same frequency, but for slow changes of its amplitude?"""
    moving = [record for record in records if np.ptp(record.input) > 0.0 and record.time.size >= 8]
    centres = [dominant_frequency(record) for record in moving]
    if not moving or max(centres) > (1.0 + SAME) * min(centres):
        return False
    return all(_share_near(record, centre) > PURE for record, centre in zip(moving, centres, strict=True))


def _share_near(record: Record, centre: float) -> float:
    """Of the input's power, what lies within SAME of a frequency, or within what the record's duration resolves."""
    frequencies, amplitudes = spectrum(record.time, record.input)
    power = amplitudes**2
    near = np.abs(frequencies - centre) <= SAME * centre + 2.0 / duration(record)
    return float(power[near].sum() / power.sum())


def without_time(records: Sequence[Record]) -> str:
    """The reason against an effect of time or rate, or an empty string."""
    if not all(record.timed for record in records):
        return "the time of these records is only an index"
    return ""


def motionless(records: Sequence[Record]) -> str:
    """The reason against an effect on the input, or an empty string."""
    return "the input never moves" if input_span(records) == 0.0 else ""


def unresolved(records: Sequence[Record]) -> str:
    """The reason against a lag or a delay, or an empty string."""
    if reason := without_time(records) or motionless(records):
        return reason
    if max(record.time.size for record in records) < 8:
        return "no record has 8 samples"
    steps = [float(np.median(np.abs(np.diff(r.input))) / np.ptp(r.input)) for r in records if np.ptp(r.input) > 0]
    if min(steps) > COARSE:
        return f"the sampling is too coarse: in a typical step the input moves by {100 * min(steps):.0f} % of its range"
    return ""


def unresolved_curve(records: Sequence[Record]) -> str:
    """The reason against dynamics with a curve of their own, or an empty string."""
    if reason := unresolved(records):
        return reason
    if one_frequency(records):
        return (
            "at the one frequency of these records dynamics are a gain and a phase: more than a lag is not to be told"
        )
    return ""
