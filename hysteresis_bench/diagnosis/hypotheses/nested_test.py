"""The nested-model test: does a system with one effect more fit better than chance would?

An F test on residuals made white by the autoregression of the larger system's, with the degrees of freedom of
the effective sample size (`autocorrelated`). A parameter without effect under the null, such as the sharpness of a
saturation that is switched off, is searched for all the same [1]: every such effect pays for `SEARCHED`
parameters more than it has.

Two systems are each fitted to the errors as they are, not as they are filtered. Beside a residual that another effect
leaves, what is slow is filtered away, and the larger system may even leave more than the smaller one. Samples left out
need no model of the errors: the paired comparison of blocks of them may speak in the test's place. The smaller p-value
of the two counts, doubled (Bonferroni).

[1] R. B. Davies, Hypothesis testing when a nuisance parameter is present only under the alternative,
Biometrika 64 (1977) 247.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import autocorrelated

SEARCHED = 2
"""Paid for the search over a parameter that the null does not know, and for the several starts."""


@dataclass(frozen=True)
class NestedTest:
    """statistic : F;  p : not corrected for the number of candidates;  added : parameters paid for."""

    statistic: float
    p: float
    added: int

    def either(self, p: float) -> NestedTest:
        """With the smaller p-value of this and of blocks left out, doubled (Bonferroni).  p : of the blocks"""
        return replace(self, p=min(1.0, 2.0 * min(self.p, p)))


def nested_test(smaller: Sequence[Array], larger: Sequence[Array], added: int, free: int) -> NestedTest:
    """smaller, larger : residuals (scored samples,) a record; added : parameters that the larger system has
    more, searched ones paid for; free : all that it has."""
    filter_ = autocorrelated.autoregression(larger)
    before, after = (
        sum(float(part @ part) for part in autocorrelated.whitened(residuals, filter_))
        for residuals in (smaller, larger)
    )
    effective = autocorrelated.effective_samples(larger)
    samples = sum(part.size for part in larger)
    if after <= 0.0 or before <= after:
        return NestedTest(0.0, 1.0 if before <= after else 0.0, added)
    statistic = (before - after) / added / (after / max(samples - free, 1))
    corrected = statistic * effective / (effective + 2.0 * free)
    return NestedTest(float(statistic), autocorrelated.f_tail(corrected, added, effective - free), added)
