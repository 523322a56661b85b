"""From what the search found to what is told: verdict, sentences, ties, advice, the model ready to predict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.evidence.autocorrelated import effective_samples
from hysteresis_bench.diagnosis.experiments.power import Fitted, Left
from hysteresis_bench.diagnosis.families import family_findings
from hysteresis_bench.diagnosis.findings.advice import Advice, advise
from hysteresis_bench.diagnosis.findings.candidates import candidates_of, description_row, step_of
from hysteresis_bench.diagnosis.findings.description import accepted
from hysteresis_bench.diagnosis.findings.remainder import Remainder, remainder
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import Stage, Stages, refuted, stage_of
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.findings.ties import Tie, tie
from hysteresis_bench.diagnosis.findings.words import Outcome, headline, warnings
from hysteresis_bench.diagnosis.preparation import Prepared
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.certainty import Certainty, certainties
from hysteresis_bench.diagnosis.search.fallback import unseen_rmse
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.accuracy import response_table, simulated
from hysteresis_bench.fit.identifiability.analysis import analyse, analyse_others
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.fit.model_file import FittedModel, fitted_model
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.fit.settling import gap_after, not_closed
from hysteresis_bench.fit.smooth.rough import solvable
from hysteresis_bench.fit.unseen.interval import interval
from hysteresis_bench.signals import Dataset


def conclude(
    dataset: Dataset,
    question: Question,
    prepared: Prepared,
    found: Found,
    stages: Stages,
    left: Remainder,
    doubt: Doubt,
) -> Diagnosis:
    """dataset : as measured;  left : in the residual of the last stage;  doubt : whether the law is wrong"""
    # held-out records choose no system; names that they contradict are not claimed
    known = () if refuted(stages.before, stages.after, found.evidence.floor) else tuple(found.rivals)
    held = doubt.holding(known)
    stand_ins = tuple(name for name in found.rivals if name not in held)
    ties = tuple(
        tie(name, rival, found.best.apart(other))
        for name, rivals in found.rivals.items()
        for rival, other in rivals.items()
        if name not in stand_ins
    )
    candidates, after, evidence = candidates_of(found, ties, stand_ins), stages.after, found.evidence
    adopted, waterfall = stages.adopted, stages.waterfall
    if question.options.accept_terms and left.equation and left.equation.terms:
        candidates = (description_row(left.equation, after), *candidates)
        after = _described(found, left.equation, prepared)
        adopted = (*adopted, registry.DESCRIPTION)
        waterfall = (*waterfall, (registry.DESCRIPTION, after.fitted.rmse))
        left = remainder(after, evidence, found.thin.fitted_values(found.final) + len(left.equation.terms))
    model = _model(after, prepared, question)
    held_out = prepared.dataset.held_out
    model = replace(model, interval=interval(after.problem, after.values, held_out, model.system, _left_out(found)))
    alone = len(dataset.records) == 1
    outcome = Outcome(stages.before, after, adopted, found, ties, left, dataset.units, question.model, doubt, alone)
    waterfall = tuple((f"{name} (stand-in)" if name in outcome.stand_ins else name, rmse) for name, rmse in waterfall)
    return Diagnosis(
        model_name=question.model,
        verdict="unexplained-residual"
        if outcome.unexplained
        else "effect-found"
        if outcome.named
        else "no-effect-needed",
        headline=headline(outcome),
        effects=outcome.named,
        stand_ins=outcome.stand_ins,
        carrying=doubt.carrying,
        better_law=doubt.cause,
        agreement=doubt.agreement,
        offset=stages.offset,
        before=stages.before,
        after=after,
        noise=evidence.noise,
        floor=evidence.floor,
        candidates=candidates,
        steps=tuple(step_of(at) for at in found.selection.rounds),
        waterfall=(*waterfall, ("noise", evidence.noise.floor)),
        ties=ties,
        advice=_advice(found, ties, question.preparation),
        memory=evidence.memory,
        equation=left.equation,
        doubtful=outcome.doubtful,
        model=model,
        families=family_findings(model),
        certainty=_certainty(outcome, question.options.seed),
        responses=_responses(prepared.dataset, stages.before, after),
        split={
            "fitted": [record.name for record in prepared.dataset.fitted],
            "held_out": [record.name for record in prepared.dataset.held_out],
            "how": prepared.how,
        },
        warnings=(*dataset.notes, *prepared.notes, *warnings(outcome), *_open(after, prepared)),
        units=dataset.units,
        given_up=found.given_up,
        unseen=unseen_rmse(found.thin, found.final),
        ceiling=found.ceiling and replace(found.ceiling, told=left.noise, law=doubt.cause is not None),
    )


def _certainty(outcome: Outcome, seed: int) -> dict[str, Certainty]:
    """Of the claimed effects; of no offset, and of no mere description."""
    found = outcome.found
    claims = [name for name in outcome.named if name in found.best.names]
    rivals = {name: sum(tie.effect == name for tie in outcome.ties) for name in claims}
    left = (outcome.cause.unseen if outcome.cause else found.best.cv_rmse) / found.selection.floor
    return certainties(found.selection, found.best, rivals, left, seed)


def _described(found: Found, equation: Equation, prepared: Prepared) -> Stage:
    """The final system with an equation's terms added to its output."""
    stack = replace(found.full.stack, ready={registry.DESCRIPTION: accepted(equation)})
    final = replace(found.final, names=found.final.names | {registry.DESCRIPTION})
    return stage_of(replace(found, full=replace(found.full, stack=stack)), final, prepared)


def _advice(found: Found, ties: Sequence[Tie], preparation: Preparation) -> Advice | None:
    if not ties:
        return None
    first = ties[0].effect
    full, thin, best = found.full, found.thin, found.best
    left = split(full.errors(best.names, thin.fitted(best)[1]), full.stack.records)
    samples = sum(part.size for part in left)
    tied = {
        name: Fitted(thin.stack.problem(one.names), thin.fitted(one)[1], samples / best.residuals.size)
        for name, one in ((first, best), *found.rivals[first].items())
    }
    heard = Left(max(found.evidence.floor, best.rmse), effective_samples(left) / samples)
    return advise(tied, full.stack.records, found.evidence.floor, left=heard, preparation=preparation)


def _open(after: Stage, prepared: Prepared) -> list[str]:
    if not prepared.passes:
        return []
    gap = gap_after(after.problem.system, prepared.dataset.fitted, after.values, repeats=prepared.passes)
    return not_closed(gap, prepared.passes)


def _left_out(found: Found) -> Array | None:
    """Errors of all samples, each record left out of the fit, where that is solved for; elsewhere they are made for
    the model that is written."""
    return found.full.apart(found.final) if solvable(found.full.stack.system(found.final.names)) else None


def _model(stage: Stage, prepared: Prepared, question: Question) -> FittedModel:
    return fitted_model(
        stage.problem,
        stage.values,
        _standard_errors(stage.problem, stage.values),
        dataset=prepared.dataset,
        model=question.model,
        settings=question.settings,
        preparation=replace(question.preparation, settle=prepared.passes, steps=prepared.steps),
    )


def _standard_errors(problem: Problem, values: Array) -> Array:
    try:
        if solvable(problem.system):
            return analyse_others(problem, values, problem.system.model.linear)[1]
        return analyse(problem, values).standard_errors
    except (ValueError, np.linalg.LinAlgError):
        return np.full(values.size, np.inf)


def _responses(ready: Dataset, before: Stage, after: Stage) -> pd.DataFrame:
    stages = {"before": before, "after": after}
    return response_table(
        ready, {name: simulated(one.problem.system, ready.records, one.values) for name, one in stages.items()}
    )
