"""Records of formulas of our own, not of the shipped kernels: plays, Coleman-Hodgdon, a lag; noise of two colours."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from scipy.signal import lfilter

from hysteresis_bench.diagnosis.evidence.view import View, views_of
from hysteresis_bench.signals import Record

Response = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""response(time, u) -> output"""

CYCLES = 4.0
RADII = np.linspace(0.03, 0.8, 25)


def plays(radii: np.ndarray = RADII, slope: float = 0.3) -> Response:
    """A sum of plays, sample by sample."""

    def response(_time: np.ndarray, u: np.ndarray) -> np.ndarray:
        positions, found = np.zeros(len(radii)), []
        for value in u:
            positions = np.minimum(np.maximum(positions, value - radii), value + radii)
            found.append(slope * value + 0.1 * positions.sum())
        return np.array(found)

    return response


def coleman_hodgdon(alpha: float = 4.0, loss: float = 0.5) -> Response:
    """dy/dt = alpha |du/dt| (f(u) - y) + (f'(u) - loss) du/dt with f = u; Euler steps between finer samples."""

    def response(_time: np.ndarray, u: np.ndarray) -> np.ndarray:
        y, found = 0.0, [0.0]
        for begin, end in pairwise(u):
            for value in np.linspace(begin, end, 9)[:-1]:
                step = (end - begin) / 8.0
                y += alpha * abs(step) * (value - y) + (1.0 - loss) * step
            found.append(y)
        return np.array(found)

    return response


def late(constant: float = 0.03) -> Response:
    """A first-order lag, no hysteresis."""

    def response(time: np.ndarray, u: np.ndarray) -> np.ndarray:
        y, found = u[0], [u[0]]
        for step, value in zip(np.diff(time), u[1:], strict=True):
            y += (1.0 - np.exp(-step / constant)) * (value - y)
            found.append(y)
        return np.array(found)

    return response


def sine(phase: np.ndarray) -> np.ndarray:
    return np.sin(2.0 * np.pi * phase)


def triangle(phase: np.ndarray) -> np.ndarray:
    return 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * phase))


def modulated(phase: np.ndarray) -> np.ndarray:
    return sine(phase) * (0.3 + 0.7 * phase / CYCLES)


def minor_loops(phase: np.ndarray) -> np.ndarray:
    return 0.6 * sine(phase) + 0.4 * sine(3.0 * phase)


def noise(rng: np.random.Generator, samples: int, decay: float) -> np.ndarray:
    """Of unit variance."""
    return lfilter([np.sqrt(1.0 - decay**2)], [1.0, -decay], rng.standard_normal(samples + 400))[400:]


def seen(
    response: Response,
    drive: Callable[[np.ndarray], np.ndarray],
    *,
    level: float = 0.003,
    decay: float = 0.0,
    samples: int = 500,
    seed: int = 0,
) -> tuple[View, ...]:
    """Three records: two amplitudes, two speeds. level : of the noise, as a share of the range"""
    rng, made = np.random.default_rng(seed), []
    for share, frequency in ((1.0, 1.0), (0.6, 1.0), (1.0, 2.0)):
        time = np.linspace(0.0, CYCLES / frequency, samples)
        u = share * drive(time * frequency)
        made.append((time, u, response(time, u)))
    span = max(np.ptp(y) for _, _, y in made)
    return views_of(
        [
            Record(time, u, y + level * span * noise(rng, samples, decay), f"run {number}")
            for number, (time, u, y) in enumerate(made)
        ]
    )
