"""A density of many parameters in the place of the law around which effects were found, where it predicts better.

Effects are not sought around a density: among its many parameters most would be lost, and each takes a fit of seconds.
Those that were found around a law of few parameters, or were tied with what was found, are asked for again around it.
It stands in that law's place where the law predicts records left out worse than the noise allows, and the density, with
the effects, does clearly better, explains more than then remains of the excess over the noise (`NAMED`), and is
expected to do better on what is asked too, where its parameters weigh unless that is like what was left out
(`laws.choice.weighed`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.doubt.doubt import in_question
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import SmoothFitter
from hysteresis_bench.diagnosis.laws.choice import weighed
from hysteresis_bench.diagnosis.preparation import Prepared
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.search import Found, search
from hysteresis_bench.diagnosis.search.selection import MISFIT, NAMED
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.fit.unseen.whole import LeftOut
from hysteresis_bench.progress import Step


def in_its_place(
    law: str, prepared: Prepared, found: Found, question: Question
) -> tuple[Prepared, Found, Question] | None:
    """A density around the same records, with those of the effects that it needs; None where it does not do better.

    law : of many parameters;  prepared, found, question : of the law of few parameters
    """
    if not found.follows or _rms(found.thin.unseen(found.final)) <= MISFIT * found.selection.floor:
        return None
    question.options.on_step(Step(f"{law} in the place of {question.model}"))
    asked = replace(question, model=law, among=in_question(found))
    ready = replace(prepared, model=asked.built)
    out = judged(found.thin.stack.records, prepared.dataset)
    fitter = SmoothFitter(replace(found.thin.stack, model=ready.model), question.options.seed, out.like)
    possible = {*fitter.stack.candidates()[0], *fitter.stack.free_forms()}
    names = {registry.RECORD_OFFSET, *(possible & {*found.selection.adopted(found.final)})}
    if not _better(found, fitter, fitter.from_anywhere(frozenset(names)), out):
        return None
    dense = search(ready, gather(ready.views), asked)
    return (ready, dense, asked) if _better(found, dense.thin, dense.final, out) else None


def _better(found: Found, fitter: Fitter, dense: Hypothesis, out: LeftOut) -> bool:
    """Does a density do clearly better, and is it expected to on what is asked?  out : of the records' fits"""
    ours, theirs, blocks = fitter.unseen(dense), found.thin.unseen(found.final), int(out.blocks.block.max()) + 1
    own, others = (0, 0) if out.like else (fitter.fitted_values(dense), found.thin.fitted_values(found.final))
    expected = weighed(_rms(ours), own, blocks) < weighed(_rms(theirs), others, blocks)
    explained, excess = np.mean(theirs**2) - np.mean(ours**2), np.mean(theirs**2) - found.selection.floor**2
    return bool(expected and explained > NAMED * excess and advantage(ours, theirs, found.thin.blocks) > CLEAR)


def _rms(errors: Array) -> float:
    return float(np.sqrt(np.mean(errors**2)))
