"""The covariance of the noise, white and autocorrelated, from short stretches of branches.

A smooth output is a polynomial over a few samples of one branch. What is left of such a stretch, in directions to which
no polynomial reaches, is noise alone; the likelihood of these contrasts (restricted likelihood [1]) tells how much of
the noise is white and how much an autoregression, whose slow part the polynomial would have taken. The covariance is
averaged over the likelihood: where the stretches cannot tell how slow the noise is, slow noise is allowed for.

[1] H. D. Patterson, R. Thompson, Biometrika 58 (1971) 545.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hysteresis_bench.arrays import Array

DECAYS = (0.5, 0.9, 0.97)
"""Correlations of neighbouring samples that are tried for the autoregression: few, so that what lies between them is
taken for slower. Short stretches cannot tell, and too fast a noise makes curves differ that are alike."""
SHARES = (0.05, 0.2, 0.5, 0.8, 1.0)
"""Its shares of the variance that are tried; with 0 the noise is white."""
SHORTEST, LONGEST = 10, 96
"""Samples of a stretch."""
DEGREES = {10: 3, 20: 4, 36: 6}
"""Degree of the polynomial, from so many samples on."""
SMALL = 0.02
"""Share of the variance below which a part is counted to the next slower one."""
FEWEST = 4
"""Stretches that are needed."""
CLIP = 3.0
"""Stretches of more than so many times the typical energy hold a kink."""


@dataclass(frozen=True)
class Colour:
    """decays, variances : of independent autoregressions of the first order, one white (0);  freedom : of a chi-square
    variable as uncertain as the variance;  borders : where records begin among all samples, and the number of these
    """

    decays: tuple[float, ...]
    variances: tuple[float, ...]
    freedom: float
    borders: tuple[int, ...]

    @property
    def rms(self) -> float:
        """Unit of the output."""
        return float(np.sqrt(sum(self.variances)))

    def covariance(self, rows: Array) -> Array:
        """Of linear functions of the output; rows : (functions, samples) -> (functions, functions)."""
        from scipy.signal import lfilter

        found = np.zeros((rows.shape[0], rows.shape[0]))
        used = np.flatnonzero(rows.any(axis=0))
        if not used.size:
            return found
        low, high = int(used[0]), int(used[-1]) + 1
        borders = [low, *(border for border in self.borders if low < border < high), high]
        for decay, variance in zip(self.decays, self.variances, strict=True):
            if variance <= 0.0:
                continue
            parts = []
            for begin, end in pairwise(borders):
                part = lfilter([1.0], [1.0, -decay], rows[:, end - 1 : begin - 1 if begin else None : -1], axis=1)
                part[:, :-1] *= np.sqrt(1.0 - decay**2)
                parts.append(part)
            whole = np.hstack(parts)
            found += variance * (whole @ whole.T)
        return found


def colour(stretches: Sequence[Array], borders: Sequence[int], least: float, most: float = np.inf) -> Colour:
    """From the outputs along branches, (samples,) each; least, most : RMS that it has at least, at most."""
    typical = float(np.median([part.size for part in stretches])) if stretches else 0.0
    size = int(np.clip(typical // 2, SHORTEST, LONGEST))
    cut = [part[k : k + size] for part in stretches for k in range(0, part.size - size + 1, size)]
    if len(cut) < FEWEST:
        return Colour((0.0,), (least**2,), float(max(2 * len(cut), 2)), tuple(borders))
    degree = max(value for samples, value in DEGREES.items() if samples <= size)
    powers = np.linspace(-1.0, 1.0, size)[:, None] ** np.arange(degree + 1)
    contrasts = np.linalg.qr(np.hstack([powers, np.eye(size)]))[0][:, degree + 1 :]
    found = np.array(cut) @ contrasts
    energies = np.sum(found**2, axis=1)
    quiet = found[energies <= CLIP * np.median(energies)]
    decays, variances = _averaged(quiet.T @ quiet / len(quiet), contrasts, len(quiet))
    for index in np.flatnonzero(variances[:-1] < SMALL * variances.sum()):  # slower, and cheaper
        variances[index + 1], variances[index] = variances[index + 1] + variances[index], 0.0
    variances *= min(1.0, most**2 / max(variances.sum(), 1e-300))
    variances[0] += max(least**2 - variances.sum(), 0.0)
    freedom = len(quiet) * contrasts.shape[1] * (1.0 - float(np.sum(variances * decays) / max(variances.sum(), 1e-300)))
    return Colour(tuple(decays.tolist()), tuple(variances.tolist()), max(freedom, 4.0), tuple(borders))


def _averaged(product: Array, contrasts: Array, stretches: int) -> tuple[Array, Array]:
    """Decays, the white one first, and their variances. product : mean over the stretches of the contrasts' product"""
    size, count = contrasts.shape
    decays = np.array([0.0, *DECAYS])
    variances, likelihoods = [], []
    lags = np.abs(np.subtract.outer(np.arange(size), np.arange(size)))
    correlations = [contrasts.T @ (decay**lags) @ contrasts for decay in DECAYS]
    for index in range(decays.size):
        for share in SHARES if index else (0.0,):
            mixed = share * correlations[index - 1] + (1.0 - share) * np.eye(count) if index else np.eye(count)
            scale = float(np.trace(np.linalg.solve(mixed, product))) / count
            own = np.zeros(decays.size)
            own[0], own[index] = (1.0 - share) * scale, own[index] + share * scale
            if not index:
                own[0] = scale
            variances.append(own)
            spread = count * np.log(max(scale, 1e-300))
            likelihoods.append(-0.5 * stretches * (np.linalg.slogdet(mixed)[1] + spread))
    weights = np.exp(np.array(likelihoods) - max(likelihoods))
    averaged: Array = weights @ np.array(variances) / weights.sum()
    return decays, averaged
