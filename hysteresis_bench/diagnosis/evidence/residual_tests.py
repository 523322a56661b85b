"""What is left in a residual: tests per record and overall, each with its p-value in plain words.

Dependence is tested by regression with autocorrelated errors (`autocorrelated`), so that n samples are not taken
for n independent ones. The spectrum is tested against its own smooth background, coherence between segments.
Where the input may answer to the output, what is found must be in the input's past as well: noise that a controller
feeds back is in its future. p-values are corrected by Holm for all tests made. A test that cannot be made (no time
base, no temperature, one cycle) is left out.

[1] G. M. Ljung, G. E. P. Box, Biometrika 65 (1978) 297.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial.legendre import legvander

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.units import frequency_in, rounded
from hysteresis_bench.diagnosis.evidence import autocorrelated, covariates, spectrum
from hysteresis_bench.diagnosis.evidence.noise import period
from hysteresis_bench.diagnosis.evidence.ripple import ripple
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.statistics import LEVEL, holm

OVERALL = "all"
FEWEST_SAMPLES = 40
"""Samples below which a record is only told of together with the others."""

LEAST_P = 0.001
"""The least p that is told."""

TAPS = (0, 1, 2, 4, 8, 16)
"""Samples by which the input is late in what may follow it linearly."""


@dataclass(frozen=True)
class ResidualTest:
    """One test of one record, or of all together.

    p, corrected_p : before and after Holm's correction for all tests made
    share : of the residual's variance that the finding explains, 0 to 1
    """

    record: str
    name: str
    statistic: float
    p: float
    corrected_p: float
    share: float
    words: str

    @property
    def significant(self) -> bool:
        return self.corrected_p < LEVEL


def residual_tests(views: Sequence[View], residuals: Sequence[Array]) -> list[ResidualTest]:
    """Every test of every record, and of all together where there are several.

    residuals : (scored samples,) a record, measured minus simulated
    """
    found: list[ResidualTest] = []
    for view, residual in zip(views, residuals, strict=True):
        if len(views) == 1 or residual.size >= FEWEST_SAMPLES:
            found += _tests(view.record.name, [view], [residual])
    if len(views) > 1:
        found += _tests(OVERALL, views, residuals)
    corrected = holm([test.p for test in found]) if found else []
    return [_told(replace(test, corrected_p=p)) for test, p in zip(found, corrected, strict=True)]


def _told(test: ResidualTest) -> ResidualTest:
    verdict = "" if test.significant else "no evidence that "
    share = f" ({100 * test.share:.0f} % of its variance)" if test.significant and test.share >= 0.005 else ""
    return replace(test, words=f"{verdict}the residual {test.words}{share}, {p_in_words(test.corrected_p)}")


def p_in_words(p: float) -> str:
    """p = 0.023, or p < 0.001: below that its size says nothing more."""
    return "p < 0.001" if p < LEAST_P else f"p = {p:.2g}"


def _tests(name: str, views: Sequence[View], residuals: Sequence[Array]) -> Iterator[ResidualTest]:
    def test(kind: str, statistic: float, p: float, share: float, words: str) -> ResidualTest:
        return ResidualTest(name, kind, float(statistic), float(p), 1.0, float(np.clip(share, 0.0, 1.0)), words)

    if all(np.ptp(part) == 0 and part[0] == 0 for part in residuals) or sum(part.size for part in residuals) < 16:
        return
    yield test("noise-floor", *_noise_floor(views, residuals), "is larger than the noise in the data")
    yield test("whiteness", *_whiteness(residuals), "is correlated from sample to sample")
    level = autocorrelated.f_test(residuals, autocorrelated.constants(residuals), level=False)
    yield test("offset", level.statistic, level.p, level.share, "has a mean that is not zero")
    for kind, ways, nuisance, words in _dependences(views):
        answer = _weakest(residuals, ways, nuisance)
        yield test(kind, answer.statistic, answer.p, answer.share, words)
    followed = [view.y - part for view, part in zip(views, residuals, strict=True)]
    for kind, courses, steps in (
        ("input", [view.u for view in views], [0.0] * len(views)),
        ("output", followed, [view.noise.quantum for view in views]),
    ):
        waves = ripple(residuals, courses, steps)
        if waves is not None:
            often = f"{rounded(waves.cycles)} times over the range of" if waves.cycles else "along"
            words = f"repeats itself {often} the {kind}"
            yield test(f"ripple-{kind}", waves.test.statistic, waves.test.p, waves.test.share, words)
    sizes = _sizes(residuals)
    for kind, ways, words in _scatters(views):
        answer = _weakest(sizes, ways)
        yield test(kind, answer.statistic, answer.p, answer.share, words)
    if all(view.record.timed and view.even for view in views):
        longest, residual = max(zip(views, residuals, strict=True), key=lambda pair: pair[1].size)
        if residual.size >= spectrum.FEWEST_SAMPLES:
            line = spectrum.line(residual, longest.step)
            at = frequency_in(longest.record.units.get("time", "1"), line.frequency)
            words = f"has a spectral line at {at}{_drive(longest, line.frequency)}"
            yield test("spectral-line", line.ratio, line.p, line.share, words)
            top, p, share = spectrum.coherence(residual, longest.u)
            past = autocorrelated.f_test([residual], [_taps(longest)])
            yield test("coherence", top, max(p, past.p), min(share, past.share), "follows the input linearly")


def _noise_floor(views: Sequence[View], residuals: Sequence[Array]) -> tuple[float, float, float]:
    """Mean square over noise^2, an F ratio; both with the degrees of freedom that autocorrelation leaves."""
    samples = np.array([part.size for part in residuals])
    square = sum(float(part @ part) for part in residuals) / samples.sum()
    floor = sum(n * view.noise.floor**2 for n, view in zip(samples, views, strict=True)) / samples.sum()
    freedom = sum(view.noise.degrees_of_freedom for view in views)
    if floor <= 0.0:
        return np.inf, 0.0, 1.0
    correlation = autocorrelated.correlations(residuals)
    own = samples.sum() / (2.0 * np.sum(correlation**2) - 1.0)
    return square / floor, autocorrelated.f_tail(square / floor, own, freedom), 1.0 - floor / max(square, floor)


def _whiteness(residuals: Sequence[Array]) -> tuple[float, float, float]:
    """[1] Ljung-Box, summed over the records; about 10 log10(n) lags, spread up to a tenth of the record."""
    from scipy.special import chdtrc

    statistic, freedom, left, whole = 0.0, 0, 0.0, 0.0
    for part in residuals:
        e = part - part.mean()
        lags = int(min(10.0 * np.log10(e.size), e.size // 5))
        if lags < 1 or not e @ e > 0:
            continue
        r = autocorrelated.lagged_products(e)[1 : lags + 1] / (e @ e)
        statistic += e.size * (e.size + 2.0) * float(np.sum(r**2 / (e.size - np.arange(1, lags + 1))))
        freedom += lags
        innovation = autocorrelated.whitened([e], autocorrelated.autoregression([e]))[0]
        left, whole = left + float(np.mean(innovation**2)) * e.size, whole + float(e @ e)
    return statistic, float(chdtrc(freedom, statistic)) if freedom else 1.0, 1.0 - left / whole if whole else 0.0


def _dependences(views: Sequence[View]) -> Iterator[tuple[str, list[list[Array]], list[Array] | None, str]]:
    """Name, ways to see the columns in question, columns that may count anyhow, words."""
    low, high = min(float(view.u.min()) for view in views), max(float(view.u.max()) for view in views)
    if high <= low:
        return
    x = [_scaled(view.u, low, high) for view in views]
    inputs = [legvander(part, 4)[:, 1:] for part in x]
    yield "input", [inputs], None, "depends on the input"
    last = [_last_turn(view) for view in views]
    directions = [
        covariates.branch(view.record.input, view.turns)[turn][:, None] for view, turn in zip(views, last, strict=True)
    ]
    yield "direction", [directions], None, "differs between rising and falling input"
    if any(view.turns.size for view in views):
        past = [
            part - _scaled(view.record.input[turn], low, high) for part, view, turn in zip(x, views, last, strict=True)
        ]
        columns = [np.column_stack([part, part * np.abs(part), np.abs(part)]) for part in past]
        yield "past-extrema", [columns], inputs, "depends on where the input last turned"
    if max(view.turns.size for view in views) >= 6:
        cycles = [covariates.cycle(view.u.size, view.noticed - view.record.history) for view in views]
        most = max(float(part.max()) for part in cycles)
        columns = [np.column_stack([part / most, part / most * inner]) for part, inner in zip(cycles, x, strict=True)]
        yield "cycle", [columns], inputs, "changes from cycle to cycle"
    if all(view.record.timed for view in views):
        signed = [[np.column_stack([part, part * np.abs(part)]) for part in rates] for rates in _rates(views)]
        yield "rate", signed, None, "depends on the input's rate"
        elapsed = [view.time - view.record.time[0] for view in views]
        longest = max(float(part[-1]) for part in elapsed)
        times = [np.column_stack([part / longest, np.log1p(100.0 * part / longest)]) for part in elapsed]
        yield "time", [times], None, "drifts in time"
    if all("temperature" in view.record.columns for view in views):
        heat = [view.record.columns["temperature"][view.record.scored] for view in views]
        joined = np.concatenate(heat)
        if np.ptp(joined) > 0:
            heat = [(part - joined.mean()) / np.ptp(joined) for part in heat]
            columns = [np.column_stack([part, part * inner]) for part, inner in zip(heat, x, strict=True)]
            yield "temperature", [columns], inputs, "depends on the temperature"


def _rates(views: Sequence[View]) -> list[list[Array]]:
    """Of all records, over the fastest one, each in the two ways of `View.rates`."""
    ways = [list(one) for one in zip(*(view.rates for view in views), strict=True)]
    largest = [max(float(np.max(np.abs(part))) for part in way) or 1.0 for way in ways]
    return [[part / scale for part in way] for way, scale in zip(ways, largest, strict=True)]


def _weakest(
    residuals: Sequence[Array], ways: Sequence[list[Array]], nuisance: list[Array] | None = None
) -> autocorrelated.FTest:
    """Of the tests on each of these ways to see the same columns: what is there is seen in all."""
    return max((autocorrelated.f_test(residuals, columns, nuisance) for columns in ways), key=lambda answer: answer.p)


def _taps(view: View) -> Array:
    """The input now and before, (scored samples, taps): what follows it does not precede it, as a controller does that
    answers to the output's noise."""
    u = view.u
    return np.column_stack([np.concatenate([np.full(lag, u[0]), u[: u.size - lag]]) for lag in TAPS])


def _scatters(views: Sequence[View]) -> Iterator[tuple[str, list[list[Array]], str]]:
    """Name, ways to see the columns, words."""
    middle = 0.5 * (min(float(view.u.min()) for view in views) + max(float(view.u.max()) for view in views))
    inputs = [np.abs(view.u - middle)[:, None] for view in views]
    yield "scatter-input", [inputs], "scatters more at some inputs than at others"
    if all(view.record.timed for view in views):
        speeds = [[np.abs(part)[:, None] for part in rates] for rates in _rates(views)]
        yield "scatter-rate", speeds, "scatters more at some rates than at others"
        times = [(view.time - view.time[0])[:, None] for view in views]
        yield "scatter-time", [times], "scatters more at some times than at others"


def _sizes(residuals: Sequence[Array]) -> list[Array]:
    """Size of the whitened residual; what the filter loses at the start is filled with the mean."""
    centred = [part - part.mean() for part in residuals]
    white = [np.abs(part) for part in autocorrelated.whitened(centred, autocorrelated.autoregression(centred))]
    mean = float(np.mean(np.concatenate(white)))
    return [
        np.concatenate([np.full(part.size - size.size, mean), size])
        for part, size in zip(residuals, white, strict=True)
    ]


def _scaled(u: Array, low: float, high: float) -> Array:
    """-1 at the lowest, 1 at the highest input of all records."""
    return (2.0 * u - low - high) / (high - low)


def _last_turn(view: View) -> Array:
    """Index, in the whole record, of the last turning point that is noticed by each scored sample; 0 before any."""
    turns, noticed = np.concatenate([[0], view.turns]), np.concatenate([[0], view.noticed])
    return turns[np.searchsorted(noticed, np.arange(view.record.history, view.record.input.size), side="right") - 1]


def _drive(view: View, frequency: float) -> str:
    """What the line has to do with a periodic input."""
    lag = period(view.u)
    if lag is None:
        return ""
    multiple = frequency * lag * view.step
    whole = round(multiple)
    if whole >= 1 and abs(multiple - whole) * view.u.size / lag < 1.5:
        return f", {whole} times the input's frequency"
    return ", no multiple of the input's frequency"
