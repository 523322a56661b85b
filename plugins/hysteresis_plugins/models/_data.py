"""What the laws take from the data for their boxes and their advice: spans, and the sense of the loop."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.white_noise import white_noise_rms
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record

SIGNIFICANT = 4.0
"""Enclosed areas from this many of their standard errors have a sign."""
THIN = 2e-3
"""Share of the rectangle around the loop below which an enclosed area says nothing, whatever its error."""
COARSE = 0.3
"""A step of the input beyond this share of its span leaves out a branch: such a loop's area says nothing."""
STEEPEST = 50.0
"""Largest slope of a box, in ratios of the spans of output and input."""
CLEAR = 0.5
"""Correlation of input and output from which a record rises, or falls."""
OFFSET_SHARE = 0.02
"""Share of the output's span from which a record's offset is worth a word."""


def input_span(records: Sequence[Record]) -> float:
    """Largest span of the input in one record, 1 where it never moves."""
    return max(float(np.ptp(record.input)) for record in records) or 1.0


def in_the_middle(centre: Parameter, records: Sequence[Record]) -> Parameter:
    """Where a structure comes to rest: within the middle fifth of the inputs, by the largest span of one record."""
    low = min(float(np.min(record.input)) for record in records)
    high = max(float(np.max(record.input)) for record in records)
    middle, span = 0.5 * (low + high), input_span(records)
    return centre.within(middle - 0.1 * span, middle + 0.1 * span)


def path(records: Sequence[Record]) -> float:
    """Longest path of the input in one record, 1 where it never moves."""
    return max(float(np.sum(np.abs(np.diff(record.input)))) for record in records) or 1.0


def output_span(records: Sequence[Record]) -> float:
    """Largest span of the output in one record, 1 where there is none."""
    return max((float(np.ptp(record.measured)) for record in records if record.output is not None), default=0.0) or 1.0


def largest_output(records: Sequence[Record]) -> float:
    """Largest |output| in one record, or its span where that is less: an output far from zero has an offset."""
    return max(min(float(np.max(np.abs(record.measured))), float(np.ptp(record.measured))) for record in records)


def steepness(records: Sequence[Record]) -> float:
    """Span of the output over that of the input."""
    return output_span(records) / input_span(records)


def measured(records: Sequence[Record]) -> list[Record]:
    return [record for record in records if record.output is not None]


def sense(records: Sequence[Record]) -> int:
    """1 where loops run anticlockwise, output over input: it lags; -1 where they run clockwise, as a force over a
    displacement does; 0 where the data do not say, or where records disagree."""
    found = {_sense(record) for record in measured(records)} - {0} or {_of_reversal_curves(measured(records))} - {0}
    return found.pop() if len(found) == 1 else 0


def sided(parameter: Parameter, most: float, side: int) -> Parameter:
    """The parameter in 0 to most, -most to 0, or -most to most: side 1, -1, or 0."""
    return parameter.within(-most if side <= 0 else 0.0, most if side >= 0 else 0.0)


def _sense(record: Record) -> int:
    u, y = record.input[record.scored], record.measured
    box = float(np.ptp(u) * np.ptp(y))
    if box == 0.0 or u.size < 5:
        return 0
    first, last = _cycles(u)
    u, y = u[first : last + 1], y[first : last + 1]
    if np.max(np.abs(np.diff(u)), initial=0.0) > COARSE * np.ptp(u):
        return 0
    closed = np.append(y, y[0]) - np.mean(y)
    steps = np.append(np.diff(u), u[0] - u[-1])
    between = 0.5 * (closed[1:] + closed[:-1])
    area = -float(between @ steps)
    error = white_noise_rms(y, 2) * float(np.sqrt(np.sum((0.5 * (steps + np.roll(steps, 1))) ** 2)))
    # the last step closes the loop along a straight line, where the output may have moved on
    error = float(np.hypot(error, 0.5 * abs(float(steps[-1]) * (y[-1] - y[0]))))
    return int(np.sign(area)) if abs(area) > max(SIGNIFICANT * error, THIN * box) else 0


def _cycles(u: Array) -> tuple[int, int]:
    """First and last sample of whole cycles: between the input's first and last rise through its middle; where there
    is at most one, from the first sample to the last one that is nearest to it."""
    above = u >= 0.5 * (u.min() + u.max())
    rises = np.flatnonzero(~above[:-1] & above[1:]) + 1
    if rises.size > 1:
        return int(rises[0]), int(rises[-1])
    far = np.abs(u - u[0])
    turned = int(np.argmax(far))
    return 0, turned + int(np.argmin(far[turned:]))


def _of_reversal_curves(records: Sequence[Record]) -> int:
    """The sense of records that each go one way from a reversal of their own: where a curve begins it still has the
    output of the way back, which the curves that come from further on there have not."""
    curves = [(record.input[record.scored], record.measured) for record in records]
    rising = [bool(np.all(np.diff(u) >= 0.0)) for u, _ in curves]
    falling = [bool(np.all(np.diff(u) <= 0.0)) for u, _ in curves]
    if len(curves) < 3 or not (all(rising) or all(falling)):
        return 0
    way = 1 if all(rising) else -1
    above = [
        y[0] - np.interp(way * u[0], way * v, z)
        for u, y in curves
        for v, z in curves
        if way * v[0] < way * u[0] <= way * v[-1]
    ]
    if not above:
        return 0
    typical = float(np.median(above))
    return int(way * np.sign(typical)) if abs(typical) > THIN * output_span(records) else 0


def slope(record: Record) -> float:
    """Correlation of input and output, -1 to 1; 0 where one of them does not move."""
    u = record.input[record.scored] - np.mean(record.input[record.scored])
    y = record.measured - np.mean(record.measured)
    size = float(np.sqrt((u @ u) * (y @ y)))
    return float(u @ y) / size if size > 0.0 else 0.0


def falling(records: Sequence[Record], what: str) -> tuple[str, ...]:
    """The advice where the output falls while the input rises, and the model cannot. what : that it is."""
    names = [record.name for record in measured(records) if slope(record) < -CLEAR]
    rising = [record.name for record in measured(records) if slope(record) > CLEAR]
    if names and rising:
        return (
            f"The output falls as the input rises in {', '.join(names)}, and rises with it in {', '.join(rising)}; "
            "no model with one set of parameters follows both.",
        )
    if names:
        return (
            f"The output falls as the input rises in {', '.join(names)}; {what}. "
            "Turn the input's sign: with --flip, or without it where it was given.",
        )
    return ()


def offset(records: Sequence[Record]) -> tuple[str, ...]:
    """The advice where the output does not start on a line through 0."""
    names = [record.name for record in measured(records) if _offset(record) > OFFSET_SHARE]
    if not names:
        return ()
    return (
        f"The output does not start at a multiple of the input in {', '.join(names)}, and the model has no offset. "
        "Add the effect bias, or record-offset where it differs from record to record.",
    )


def _offset(record: Record) -> float:
    """|output - slope * input| of the middle of the loop, as a share of the output's span."""
    driven, found = record.input[record.scored], record.measured
    centre_in, centre_out = (0.5 * (values.min() + values.max()) for values in (driven, found))
    span_in, span_out = float(np.ptp(driven)), float(np.ptp(found))
    if span_in == 0.0 or span_out == 0.0:
        return 0.0
    # a loop that starts at rest may sit half its own height off the line, so that much is no offset
    mean = span_out / span_in
    height = float(np.ptp(found - mean * driven))
    return float(max(abs(centre_out - mean * centre_in) - height, 0.0) / span_out)
