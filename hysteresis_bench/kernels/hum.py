"""A hum on a slow course: one weak sinusoid, faster than all else, as a sensor picks it up from the mains."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array

WEAK, REST, FASTER, LONE = 0.05, 0.01, 3.0, 0.8
"""Of the hum: its range over that of all; the share of all power beyond the slow band, whose edge its frequency
exceeds so many times; and its share of the power from there on. Of 144 made hums (0.3 to 3 % of six courses, without
noise and in 0.1 %) 88 are found: none on stairs, on a triangle those of 3 %, on the others all but 0.3 % in noise; and
none on 274 records without one, those of 20 measured devices among them. Half of WEAK loses 40 more, twice of REST,
half and twice of FASTER and half of the distance of LONE from 1 lose 5 to 8; twice of that finds one on two of the
devices' records. Half of REST and twice of WEAK change none."""

PERIODS, FASTEST = 20, 0.4
"""The fewest periods in the record, and the highest frequency, in cycles a sample: what is faster is noise.
Half and twice of the former change none of those records."""

LOBE = 4
"""Half of the width of a line in the spectrum, of the window that is taken."""


def hum(time: Array, values: Array) -> Array:
    """The hum (samples,), unit of the values; zeros where there is none, or samples are not even.

    time : (samples,), increasing;  values : (samples,)
    The largest line of a spectrum whose window [1] lets nothing of what is slow leak to it.

    [1] F. J. Harris, Proc. IEEE 66 (1978) 51, the minimum 4-term Blackman-Harris window.
    """
    from scipy.optimize import minimize_scalar
    from scipy.signal.windows import blackmanharris

    none, size, steps = np.zeros(values.size), values.size, np.diff(time)
    if size < PERIODS / FASTEST or np.ptp(values) == 0.0 or np.ptp(steps) > 1e-3 * steps.mean():
        return none
    window, samples = blackmanharris(size, sym=False), np.arange(size)
    seen = window * (values - np.average(values, weights=window))
    power = np.abs(np.fft.rfft(seen)) ** 2
    band = int(np.argmax(np.cumsum(power) > (1.0 - REST) * power.sum()))
    first, last = max(int(FASTER * band), PERIODS) + LOBE, int(FASTEST * size)
    if first >= last:
        return none
    peak = first + int(np.argmax(power[first:last]))
    around = power[peak - LOBE : peak + LOBE + 1]
    if around.max() > power[peak] or around.sum() < LONE * power[first - LOBE :].sum():
        return none

    def line(cycles: float) -> complex:
        return complex(2.0 * (seen @ np.exp(-2j * np.pi * cycles / size * samples)) / window.sum())

    cycles = minimize_scalar(lambda c: -abs(line(c)), bounds=(peak - 1, peak + 1), method="bounded").x
    found = np.real(line(cycles) * np.exp(2j * np.pi * cycles / size * samples))
    return found if np.ptp(found) < WEAK * np.ptp(values) else none
