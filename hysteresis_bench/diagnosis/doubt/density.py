"""A density of many parameters in the place of the law around which effects were found, where it predicts better.

Effects are not sought around a density: among its many parameters most would be lost, and each takes a fit of seconds.
Those that were found around a law of few parameters, or were tied with what was found, are asked for again around it.
It stands in that law's place where the law predicts records left out worse than the noise allows, and the density with
the effects does clearly better (`cause.clearly_better`) and is expected to on what is asked too, where its parameters
weigh unless that is like what was left out (`expected_error`).
"""

from __future__ import annotations

from dataclasses import replace

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.cause import clearly_better
from hysteresis_bench.diagnosis.doubt.doubt import in_question
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.hypotheses.expected_error import weighed
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.smooth_fitter import SmoothFitter
from hysteresis_bench.diagnosis.preparation import Prepared
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.search import Found, search
from hysteresis_bench.diagnosis.search.selection import MISFIT
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.fit.unseen.whole import LeftOut
from hysteresis_bench.progress import Step


def in_its_place(
    law: str, prepared: Prepared, found: Found, question: Question
) -> tuple[Prepared, Found, Question] | None:
    """A density around the same records, with those of the effects that it needs; None where it does not do better.

    law : of many parameters;  prepared, found, question : of the law of few parameters
    """
    own = _contender(question.model, found.thin, found.final)
    if not found.follows or own.rmse <= MISFIT * found.selection.floor:
        return None
    question.options.on_step(Step(f"{law} in the place of {question.model}"))
    asked = replace(question, model=law, among=in_question(found))
    ready = replace(prepared, model=asked.built)
    out = judged(found.thin.stack.records, prepared.dataset)
    fitter = SmoothFitter(replace(found.thin.stack, model=ready.model), question.options.seed, out.like)
    possible = {*fitter.stack.candidates()[0], *fitter.stack.free_forms()}
    names = {registry.RECORD_OFFSET, *(possible & {*found.selection.adopted(found.final)})}
    if not _better(_contender(law, fitter, fitter.from_anywhere(frozenset(names))), own, found, out):
        return None
    dense = search(ready, gather(ready.views), asked)
    return (ready, dense, asked) if _better(_contender(law, dense.thin, dense.final), own, found, out) else None


def _contender(law: str, fitter: Fitter, final: Hypothesis) -> Contender:
    return Contender(law, (), fitter.unseen(final), fitter.fitted_values(final))


def _better(dense: Contender, own: Contender, found: Found, out: LeftOut) -> bool:
    """Does it do clearly better, and is it expected to on what is asked?  out : of the records' fits"""
    expected = _expected(dense, out) < _expected(own, out)
    return expected and clearly_better(dense, own, found.selection.floor, found.thin.blocks)


def _expected(one: Contender, out: LeftOut) -> float:
    """RMSE to expect on what is asked;  out : of the records' fits"""
    return one.rmse if out.like else weighed(one.rmse, one.parameters, int(out.blocks.block.max()) + 1)
