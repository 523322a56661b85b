"""The simplest offset that the data accept."""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.selection import Selection


def with_simplest_offset(selection: Selection, hypothesis: Hypothesis) -> Hypothesis:
    """The same effects with the simplest offset that the data accept: none, one for all records, one a record."""
    fitter = selection.fitter
    none = fitter.refitted(fitter.reduced(hypothesis, registry.RECORD_OFFSET))
    count = len(selection.candidates)
    if not selection.needed(none, hypothesis, count):
        return none
    # without any offset the other values were bent far away
    common = fitter.extended(none, registry.COMMON_OFFSET, hypothesis.values)
    if len(fitter.stack.records) == 1 or not selection.needed(common, hypothesis, count):
        return common
    return hypothesis
