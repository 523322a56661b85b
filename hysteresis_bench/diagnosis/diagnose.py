"""Diagnosis: fit a model, see what is left, name what is missing, refit, and report before and after."""

from __future__ import annotations

from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.findings.conclude import conclude
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import settle_offset
from hysteresis_bench.diagnosis.preparation import prepare
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.search import search
from hysteresis_bench.diagnosis.threads import single_threaded
from hysteresis_bench.progress import Step
from hysteresis_bench.signals import Dataset


@single_threaded
def diagnose(dataset: Dataset, question: Question) -> Diagnosis:
    """Find what a registered model lacks on the fitted records; the held-out ones are opened once, at the end.

    Raises UserError telling every fault at once.
    """
    on_step = question.options.on_step
    on_step(Step("the records"))
    prepared = prepare(dataset, question)
    evidence = gather(prepared.views)
    found = search(prepared, evidence, question)
    on_step(Step("before and after"))
    stages = settle_offset(prepared, found, question)
    return conclude(dataset, question, prepared, found, stages)
