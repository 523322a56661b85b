"""What is wrong with measured records: from a clean one to one as a test bench hands it out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeAlias

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Record

Imperfection: TypeAlias = Callable[[Record, float, Generator], Record]
"""imperfection(record, rms, rng) -> the record as it was measured; rms : of the noise, unit of the output."""


def noisy(record: Record, rms: float, rng: Generator) -> Record:
    """White noise on the output, which all others have as well."""
    assert record.output is not None
    return replace(record, output=record.output + rms * rng.standard_normal(record.time.size))


def coloured(record: Record, rms: float, rng: Generator) -> Record:
    """Noise whose neighbouring samples are correlated by 0.9, as behind an anti-aliasing filter or a slow sensor."""
    from scipy.signal import lfilter

    assert record.output is not None
    shocks = rng.standard_normal(record.time.size + 100)
    slow: Array = lfilter([np.sqrt(1.0 - 0.9**2)], [1.0, -0.9], shocks)[100:]
    return replace(record, output=record.output + rms * slow)


def heavy_tailed(record: Record, rms: float, rng: Generator) -> Record:
    """Noise of Student's distribution with three degrees of freedom: few samples are far off."""
    assert record.output is not None
    return replace(record, output=record.output + rms * rng.standard_t(3, record.time.size) / np.sqrt(3.0))


def stuck(record: Record, rms: float, rng: Generator) -> Record:
    """A channel that hangs for a twenty-fifth of the record."""
    measured = noisy(record, rms, rng)
    assert measured.output is not None
    output, quarter = measured.output.copy(), record.time.size // 4
    at = int(rng.integers(quarter, 3 * quarter))
    output[at : at + record.time.size // 25] = output[at]
    return replace(measured, output=output)


def quantised(record: Record, rms: float, rng: Generator) -> Record:
    """A converter with steps of four times the noise."""
    measured, step = noisy(record, rms, rng), 4.0 * rms
    assert measured.output is not None
    return replace(measured, output=step * np.rint(measured.output / step))


def noisy_input(record: Record, rms: float, rng: Generator) -> Record:
    """The input is measured, too, with noise of 0.2 % of its range; what acts is the true one."""
    measured = noisy(record, rms, rng)
    share = 0.002 * float(np.ptp(record.input))
    return replace(measured, input=record.input + share * rng.standard_normal(record.input.size))


def spiked(record: Record, rms: float, rng: Generator) -> Record:
    """One sample in two hundred is off by 20 to 100 times the noise, either way."""
    measured = noisy(record, rms, rng)
    assert measured.output is not None
    hit = rng.choice(record.time.size, max(2, record.time.size // 200), replace=False)
    output = measured.output.copy()
    output[hit] += rms * rng.uniform(20.0, 100.0, hit.size) * rng.choice([-1.0, 1.0], hit.size)
    return replace(measured, output=output)


def uneven(record: Record, rms: float, rng: Generator) -> Record:
    """A third of the samples is lost, and one stretch of a twentieth of the record."""
    kept = rng.random(record.time.size) > 1.0 / 3.0
    gap = int(rng.integers(record.time.size // 4, 3 * record.time.size // 4))
    kept[gap : gap + record.time.size // 20] = False
    kept[[0, -1]] = True
    return noisy(record, rms, rng).take(np.flatnonzero(kept))


def coarse(record: Record, rms: float, rng: Generator) -> Record:
    """Every fourth sample only."""
    return noisy(record, rms, rng).take(np.arange(0, record.time.size, 4))


def in_mid_loop(record: Record, rms: float, rng: Generator) -> Record:
    """The first tenth is missing: the loop does not begin at rest."""
    return noisy(record, rms, rng).take(np.arange(record.time.size // 10, record.time.size))


IMPERFECTIONS: Mapping[str, Imperfection] = {
    "coloured": coloured,
    "heavy-tailed": heavy_tailed,
    "quantised": quantised,
    "noisy-input": noisy_input,
    "spiked": spiked,
    "uneven": uneven,
    "coarse": coarse,
    "in-mid-loop": in_mid_loop,
    "stuck": stuck,
}
