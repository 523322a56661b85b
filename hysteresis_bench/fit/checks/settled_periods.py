"""Are these records periods of a loop that had settled? A model begins at rest, which such a device does not.

A record is one where the input begins at an end of its own range and comes back there, the output comes back with it,
and the first pass may lie on the loop: play operators that have gone round once leave about as little as those that
begin at rest, which follow the way from rest of what was at rest.

Eleven laws were driven between ends of a range by one or three cycles of five shapes, 88 draws each at noise of 0.3, 1
and 3 % of the range. Of settled periods 68 to 88 were found; of loops that began at rest 0 to 26 passed for settled:
where the way from rest differs from the settled loop by less than the noise, mostly, and by 1.9 times it at worst. With
0.03 % of noise 44 to 79 were found, as straight pieces leave more than that, and 1 of 440 passed. A record that begins
elsewhere tells nothing here: the way from rest may be anything there. It is begun at rest, as before.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.settling import is_closed
from hysteresis_bench.kernels.white_noise import white_noise_rms
from hysteresis_bench.signals import Record

SAID = (
    "Every fitted record begins and ends at one reversal of its input, with one output: they are periods of loops that "
    "had settled, and loops were passed before they were scored. --no-settle begins them at rest."
)

OPEN = (
    "These records were to be passed as settled loops, and are none: the input ends where it began, the output does "
    "not, by so much of its range: {}. A settled model cannot follow that, and an effect may be named for it. "
    "--no-settle begins them at rest."
)

FEWEST, MOST = 40, 1000
"""Scored samples from which a record can tell, and that are looked at."""
PLAYS = np.array((0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8))
"""Half-widths, as shares of half the input's range; 0: the input itself."""
PIECES = 6
"""Of each of their curves."""
RIDGE = 1e-6
"""Share of a column's sum of squares that is added to it: columns that are alike would leave the weights open."""
NOISE = 3.0 * np.sqrt(2.0)
"""Times the noise's RMS by which two samples of one output may differ."""
WORSE = 1.1
"""Times what plays from rest leave, up to which those that have gone round leave as little."""
LOOP = 1.2
"""Times what plays leave, from which the input alone leaves more: there is a loop."""


def settled_periods(records: Sequence[Record], asked: bool | None = None) -> bool:
    """Shall loops be passed before they are scored? As `asked`; where it is None, as the records say.

    records : with outputs, as the model sees them, not repeated
    """
    return asked if asked is not None else bool(records) and all(map(_is_one, records))


def unsettled(records: Sequence[Record], asked: bool | None) -> tuple[str, ...]:
    """A sentence on the records that are to be passed as loops, as `asked`, and whose outputs do not come back.

    records : with outputs, as the model sees them, not repeated
    """
    if not asked:
        return ()
    off = [f"{record.name} ({100.0 * gap:.2g} %)" for record in records if (gap := _gap(record)) > 0.0]
    return (OPEN.format(", ".join(off)),) if off else ()


def _gap(record: Record) -> float:
    """How far from its beginning the output of a loop ends, a share of its range; 0 where nothing says that it does."""
    y = record.output
    if y is None or y.size < FEWEST or not is_closed(record) or _comes_back(record.input, y):
        return 0.0
    return abs(float(y[-1] - y[0])) / (float(np.ptp(y)) or 1.0)


def _is_one(record: Record) -> bool:
    if record.history or record.output is None or record.time.size < FEWEST or not is_closed(record):
        return False
    u, y = record.input, record.output
    step = 2.0 * float(np.max(np.abs(np.diff(u))))
    if min(float(u[0] - u.min()), float(u.max() - u[0])) > step or not _comes_back(u, y):
        return False
    x = 2.0 * (u - u.min()) / (np.ptp(u) or 1.0) - 1.0
    kept = np.unique(np.append(np.arange(0, x.size, -(-x.size // MOST)), x.size - 1))
    rest, settled = (_played(path)[-x.size :][kept] for path in (x, np.append(x, x)))
    left = _left(settled, y[kept])
    alone = _left(settled[:, :1], y[kept], PIECES * PLAYS.size)
    return left <= WORSE * _left(rest, y[kept]) and LOOP * left < alone


def _comes_back(u: Array, y: Array) -> bool:
    """Does the output end where it began, within its noise and what the input misses of coming back?"""
    missing = abs(float(u[-1] - u[0])) / float(np.max(np.abs(np.diff(u))))
    step = max(abs(float(y[1] - y[0])), abs(float(y[-1] - y[-2])))
    return float(np.ptp(y)) > 0.0 and abs(float(y[-1] - y[0])) <= missing * step + NOISE * white_noise_rms(y, 4)


def _played(x: Array) -> Array:
    """(samples, plays), each beginning in the middle of its dead band;  x : from -1 to 1"""
    from hysteresis_bench.kernels.play import play

    return play(np.ascontiguousarray(x[:, None]), PLAYS)


def _left(plays: Array, y: Array, count: int = PIECES) -> float:
    """RMS that a sum of curves of so many straight pieces, of each of the plays, leaves."""
    low = np.linspace(-1.0, 1.0, count + 1)[:-1]
    pieces = np.clip((plays[:, :, None] - low) * (0.5 * count), 0.0, 1.0)
    columns = np.column_stack([np.ones(y.size), pieces.reshape(y.size, -1)])
    columns = columns / np.sqrt(np.mean(columns**2, axis=0) + np.finfo(float).tiny)
    normal = columns.T @ columns + RIDGE * y.size * np.eye(columns.shape[1])
    return float(np.sqrt(np.mean((y - columns @ np.linalg.solve(normal, columns.T @ y)) ** 2)))
