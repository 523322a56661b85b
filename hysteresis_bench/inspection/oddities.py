"""What is odd about records, a sentence each with what would help: a hysteresis model believes every reversal it sees.

Thresholds are ours: what they let through changes a fit by less than the measurement's own noise on the rigs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.data_files import too_small
from hysteresis_bench.data.faults.dropouts import dropouts_told
from hysteresis_bench.data.faults.hidden_turns import hidden_turns_told
from hysteresis_bench.data.faults.spikes import spikes_told
from hysteresis_bench.data.faults.stuck import stuck_told
from hysteresis_bench.data.units import seconds_in
from hysteresis_bench.fit.checks.faulty_records import jumps_told
from hysteresis_bench.fit.settling import is_closed
from hysteresis_bench.inspection.excitation import TURN, alike, amplitudes, turns, unexcited
from hysteresis_bench.inspection.few_samples import few_told
from hysteresis_bench.kernels.white_noise import white_noise_rms
from hysteresis_bench.signals import Record

SMALLEST = 1e-6
"""Share of the range that is rounding."""
FALSE, RESTING, OPEN, DRIFTING, JITTER, NOISY = 3, 0.05, 0.03, 0.03, 0.05, 0.002
"""False reversals for a meant one; shares of samples, of the range, of the median step, of the range."""
AHEAD = 0.02
"""Share of the rectangle around a cycle that it encloses against the usual sense."""
SIGNIFICANT = 4.0
"""Areas from this many of their standard errors are no accident."""
FLAT = 5
"""Samples in a row at the largest output that are no accident."""
CORNERS = 20
"""Samples of a cycle below which corners are cut."""


def oddities(records: Sequence[Record]) -> tuple[str, ...]:
    """Sentences on these records, each with what would help; empty where nothing is odd."""
    looks: tuple[Callable[[Record], str], ...] = (
        _false_reversals,
        _input_noise,
        _plateau,
        _open,
        _drift,
        _clipping,
        _aliasing,
        _jitter,
        dropouts_told,
        stuck_told,
        hidden_turns_told,
        spikes_told,
        jumps_told,
    )
    moving = [record for record in records if record.time.size > 3 and not _constant(record)]
    found = [said for record in records if record.time.size > 3 and (said := _constant(record))]
    found += [said for record in moving for look in looks if (said := look(record))]
    found += [said] if (said := few_told(records)) else []
    return (*found, *_ahead(records), *unexcited(moving))


def _constant(record: Record) -> str:
    for name, values in (("input", record.input), ("output", record.output)):
        if values is not None and not np.ptp(values) > 0.0:
            return (
                f"{record.name}: the {name} is {float(values[0]):.4g} throughout, so that nothing can be identified: "
                f"is it the right column (--{name}), or was the channel off?"
            )
        if values is not None and (small := too_small(values)):
            return f"{record.name}, column {name}: {small}"
    return ""


def _false_reversals(record: Record) -> str:
    every, meant = turns(record, SMALLEST).size, turns(record).size
    if every - meant <= FALSE * max(meant, 1):
        return ""
    return (
        f"{record.name}: the input turns {every - meant} times by less than {TURN:.0%} of its range, beside {meant} "
        f"meant reversals. A model of hysteresis takes each for a small loop: take the commanded input with --input "
        f"NAME in place of the measured one, or smooth it."
    )


def _input_noise(record: Record) -> str:
    """By fourth differences, which leave nothing of a smooth drive."""
    noise = white_noise_rms(record.input, 4) / (float(np.ptp(record.input)) or 1.0)
    cycle = 2.0 * record.time.size / max(turns(record).size, 1)
    if noise <= NOISY or cycle < CORNERS:
        return ""
    return (
        f"{record.name}: the input has noise of {noise:.1%} of its range, which a model cannot tell from a drive: take "
        f"the commanded input with --input NAME, or smooth it."
    )


def _plateau(record: Record) -> str:
    still = np.abs(np.diff(record.input)) <= SMALLEST * (float(np.ptp(record.input)) or 1.0)
    runs = [run for run in _runs(still) if run[1] - run[0] > FLAT]
    if sum(high - low for low, high in runs) <= RESTING * record.time.size:
        return ""
    low, high = _longest(still)
    unit = record.units.get("time", "s")
    lasts = float(record.time[high] - record.time[low])
    where = f"{record.name}: the input rests for {lasts:.4g} {unit} from {float(record.time[low]):.4g} {unit}"
    if low == 0:
        length = lasts / seconds_in(unit, 1.0)
        return f"{where}, its beginning: --skip {length:.4g} leaves it out of the score."
    return f"{where}: what the output does meanwhile is creep or noise, and a law that knows no time cannot follow it."


def _open(record: Record) -> str:
    """The last cycle between two reversals; of a single cycle, its ends."""
    at, spread = turns(record), float(np.ptp(record.output)) if record.output is not None else 0.0
    several = at.size > 3 and alike(amplitudes(record))
    if record.output is None or spread == 0.0 or not (several or (at.size < 3 and is_closed(record))):
        return ""
    first, last = (at[-3], at[-1]) if several else (0, -1)
    gap = abs(float(record.output[last] - record.output[first])) / spread
    if gap <= OPEN:
        return ""
    return (
        f"{record.name}: the last loop does not close: the input comes back, the output {gap:.0%} of its range "
        f"away. Where the loop had "
        f"settled in the test, --settle repeats it until a model has, too; where it had not, --skip SECONDS leaves the "
        f"first cycle out of the score."
    )


def _drift(record: Record) -> str:
    """The middle of the output, cycle by cycle of the input."""
    upper = turns(record)[::2]
    if record.output is None or upper.size < 4:
        return ""
    middles = np.array([float(np.mean(record.output[a:b])) for a, b in pairwise(upper)])
    at = np.arange(middles.size, dtype=float)
    slope, level = np.polyfit(at, middles, 1)
    left = float(np.std(middles - slope * at - level))
    moved = abs(float(slope)) * (middles.size - 1)
    share = moved / (float(np.ptp(record.output)) or 1.0)
    if share <= DRIFTING or moved <= 3.0 * left or not alike(amplitudes(record)):
        return ""
    return (
        f"{record.name}: the middle of the output drifts by {share:.0%} of its range in {middles.size} cycles: fit "
        f"with the effect drift or record-drift, or --skip SECONDS of a beginning that had not settled."
    )


def _clipping(record: Record) -> str:
    if record.output is None:
        return ""
    steps = np.abs(np.diff(record.output))
    moving = steps[steps > 0]
    spread = float(np.ptp(record.output))
    if not moving.size or float(np.median(moving)) > spread / 50.0:
        return ""
    for edge, word in ((record.output.max(), "largest"), (record.output.min(), "smallest")):
        low, high = _longest(record.output == edge)
        resting = np.ptp(record.input[low:high]) <= TURN * np.ptp(record.input) / FLAT
        if high - low >= FLAT and not resting:
            return (
                f"{record.name}: the output stays at its {word} value, {float(edge):.4g}, for {high - low} samples "
                f"while the input moves: a sensor or amplifier at its limit? Measure with a larger range; a fit "
                f"believes the flat."
            )
    return ""


def _aliasing(record: Record) -> str:
    at = turns(record)
    if at.size < 2:
        return ""
    cycle = 2.0 * float(np.median(np.diff(at)))
    if cycle >= CORNERS:
        return ""
    return (
        f"{record.name}: only {cycle:.0f} samples a cycle of the input: corners are cut, and faster movements appear "
        f"as slower ones (aliasing). Take at least {CORNERS}; where the rate was given with --rate, is it right?"
    )


def _jitter(record: Record) -> str:
    steps = np.diff(record.time)
    middle = float(np.median(steps))
    near = steps[steps < 1.5 * middle]  # a gap is told where the file is read
    share = float(np.std(near)) / middle if near.size > 2 else 0.0
    if not record.timed or share <= JITTER:
        return ""
    return (
        f"{record.name}: steps of time vary by {share:.0%} (standard deviation): where the samples were taken evenly "
        f"and only their times are rough, give --rate HZ."
    )


def _ahead(records: Sequence[Record]) -> list[str]:
    """The records whose cycles enclose an area in the sense of an output that is ahead of its input."""
    names = [record.name for record in records if _turning(record) > AHEAD]
    if not names:
        return []
    which = names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more"
    return [
        f"{which}: the output runs ahead of the input. A force over its displacement does so; where yours should lag, "
        f"input and output may be exchanged: say which is which with --input and --output."
    ]


def _turning(record: Record) -> float:
    """The area of whole cycles over the rectangles about them, positive where a rising output is ahead of its input;
    0 where the noise may have drawn it."""
    at = turns(record)[::2]
    if record.output is None or at.size < 2 or not np.ptp(record.output) > 0.0:
        return 0.0
    u, y = record.input[at[0] : at[-1] + 1], record.output[at[0] : at[-1] + 1]
    rises = np.sign(float(np.sum((u - np.mean(u)) * (y - np.mean(y)))))
    rectangles = (at.size - 1) * float(np.ptp(u)) * (float(np.ptp(y)) or 1.0)
    area = float(np.sum(np.diff(u) * (y[1:] + y[:-1]) / 2.0))
    error = white_noise_rms(y, 2) * float(np.sqrt(np.sum(((u[2:] - u[:-2]) / 2.0) ** 2)))
    return float(rises * area / rectangles) if abs(area) > SIGNIFICANT * error else 0.0


def _longest(holds: Array) -> tuple[int, int]:
    """First and one past the last sample of the longest run."""
    return max(_runs(holds), key=lambda run: run[1] - run[0], default=(0, 0))


def _runs(holds: Array) -> list[tuple[int, int]]:
    """First and one past the last sample of every run."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], np.asarray(holds, dtype=int), [0]))))
    return [(int(low), int(high)) for low, high in zip(edges[::2], edges[1::2], strict=True)]
