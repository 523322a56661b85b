"""The simplest offset that the data accept."""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.fallback import unseen_rmse
from hysteresis_bench.diagnosis.search.selection import NAMED, Selection


def with_simplest_offset(selection: Selection, hypothesis: Hypothesis) -> Hypothesis:
    """The same effects with the simplest offset that the data accept: none, one for all records, one a record.

    Far from the noise a constant makes up for a part of what the law does wrong, and adds as much to what is held out:
    there one for all records has to explain more than is then left, as an effect has to keep its name, or to help to
    predict records left out."""
    fitter = selection.fitter
    none = fitter.refitted(fitter.reduced(hypothesis, registry.RECORD_OFFSET))
    count = len(selection.candidates)
    if not selection.needed(none, hypothesis, count):
        return none
    # without any offset the other values were bent far away
    common = fitter.extended(none, registry.COMMON_OFFSET, hypothesis.values)
    several = len(fitter.stack.records) > 1
    if several and selection.needed(common, hypothesis, count):
        return hypothesis
    makes_up = common.rmse > WRONG * selection.floor and selection.share(none, common) < NAMED
    helps = several and unseen_rmse(fitter, common) < unseen_rmse(fitter, none)
    return none if makes_up and not helps else common
