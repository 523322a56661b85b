"""Do the samples lie so far apart that what is between them decides what a search finds?

A model of the samples cannot come down to the noise then, and an effect that bends the loop a little may be taken for
what is missing. So where it matters the search is made again with `FINER` steps from one sample to the next, along a
spline where the input is smooth.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.preparation import SEARCHED
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.unseen.between_samples import TELLING, between_samples

DECIDING = 5.0
"""Of the floor's standard error, the floor over the root of the number of samples, from where it may decide between
names: the square of it is what it adds to a chi-square. Lags were named on the wrong side of the law at 6.6 to 10; with
twice it they still are, with half of it well sampled loops are simulated four times as finely too."""


def few_samples(found: Found) -> bool:
    """Does it matter to what was found, or to the bare law, for which an effect may make up? Not asked where there are
    so many samples that a search takes some of them only."""
    fitter, floor = found.full, found.selection.floor
    records = fitter.stack.records
    samples = sum(record.measured.size for record in records)
    if samples > SEARCHED:
        return False
    left = found.best.rmse
    limit = TELLING * left if left > WRONG * floor else floor * min(TELLING, DECIDING / np.sqrt(samples))
    systems = (fitter.fitted(hypothesis) for hypothesis in (found.base, found.best))
    return any(between_samples(system, records, values) > limit for system, values in systems)
