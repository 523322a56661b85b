"""What records excite: their reversals, amplitudes and speeds; and what all of them together leave unexcited."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.units import frequency_in
from hysteresis_bench.kernels.turning_points import turning_points
from hysteresis_bench.signals import Record

TURN = 0.05
"""Share of the input's range beyond which a reversal is meant."""
CURVES = 3
"""Records that each go one way from which they are reversal curves."""
ALIKE = 0.1
"""Relative difference up to which amplitudes and frequencies are one."""
STEADY = 1.3
"""Ratio of a record's upper to its lower quartile of frequencies up to which it has one: half cycles of few samples,
and noise on a reversal, spread them."""
NEAR, MOSTLY = 0.2, 0.9
"""Relative difference from that frequency within which so much of the input's power must lie. Of 200 made multisines of
six tones 106 were told as one frequency without it and none are with it, of 147 sines, triangles and trapezoids 141
either way; half and twice of NEAR, 0.8 and 0.95 for MOSTLY change at most one of these."""


def turns(record: Record, share: float = TURN) -> Array:
    """Where the input turns by more than a share of its range, rising indices."""
    values = np.ascontiguousarray(record.input, dtype=float)
    return np.asarray(turning_points(values, share * float(np.ptp(values))))


def amplitudes(record: Record) -> Array:
    """Half the way of every half cycle between two reversals, (half cycles,), unit of the input."""
    return np.asarray(np.abs(np.diff(record.input[turns(record)])) / 2.0)


def frequencies(record: Record) -> Array:
    """Quartiles of its half cycles between meant reversals, two at least, (3,), cycles a unit of time."""
    return np.quantile(0.5 / np.diff(record.time[turns(record)]), (0.25, 0.5, 0.75))


def unexcited(records: Sequence[Record]) -> list[str]:
    """What all records together do not excite."""
    found = []
    if 0 < len(records) < CURVES and not any(turns(record).size for record in records):
        found.append(
            "the input never turns: one way tells no hysteresis from a curve of the input. Add the way back, and loops "
            "within it."
        )
    sizes = [amplitudes(record) for record in records]
    every = np.concatenate(sizes) if sizes else np.zeros(0)
    if every.size > 1 and alike(every):
        found.append(
            f"one amplitude only ({np.median(every):.4g}): what small loops do, and whether the law is right for them, "
            f"cannot be seen. Add a record with growing or nested amplitudes."
        )
    turning = [record for record in records if record.timed and turns(record).size > 1]
    rates = np.array([frequencies(record) for record in turning]).reshape(-1, 3)
    steady = rates.size and alike(rates[:, 1]) and np.all(rates[:, 2] <= STEADY * rates[:, 0])
    if steady and all(_mostly_at(record, frequency) for record, frequency in zip(turning, rates[:, 1], strict=True)):
        about = frequency_in(turning[0].units.get("time", "1"), float(np.median(rates[:, 1])))
        found.append(
            f"one frequency only (about {about}): lags, delays and eddy currents cannot be told apart, nor told from "
            f"the law. Add a record at another speed."
        )
    return found


def alike(values: Array) -> bool:
    """Whether all of them are alike; the first and the last may be parts."""
    inner = values[1:-1] if values.size > 4 else values
    return bool(np.ptp(inner) <= ALIKE * np.max(np.abs(inner)))


def _mostly_at(record: Record, frequency: float) -> bool:
    """Does nearly all of the input's power lie near this frequency?"""
    even = np.linspace(record.time[0], record.time[-1], record.time.size)
    u = np.interp(even, record.time, record.input)
    power = np.abs(np.fft.rfft((u - u.mean()) * np.hanning(u.size), 4 * u.size)) ** 2
    away = np.abs(np.fft.rfftfreq(4 * u.size, even[1] - even[0]) - frequency)
    near = away <= max(NEAR * frequency, 2.0 / float(even[-1] - even[0]))  # of the window no line is narrower
    return bool(power[near].sum() >= MOSTLY * power.sum())
