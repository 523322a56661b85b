"""Diagnosis: fit a model, see what is left, name what is missing, refit, and report before and after."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hysteresis_bench import registry
from hysteresis_bench.data.spikes import without_spikes
from hysteresis_bench.diagnosis.doubt.agreement import is_shape
from hysteresis_bench.diagnosis.doubt.doubt import Doubt, answered, doubt
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.families.finding import forms_of
from hysteresis_bench.diagnosis.findings.conclude import conclude
from hysteresis_bench.diagnosis.findings.remainder import remainder
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import settle_offset
from hysteresis_bench.diagnosis.laws.comparison import BASELINE, Comparison, compare
from hysteresis_bench.diagnosis.preparation import Prepared, prepare, with_held_out
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.beginnings import only_in_beginnings, without_beginnings
from hysteresis_bench.diagnosis.search.between_samples import FINER, few_samples, with_finer_steps
from hysteresis_bench.diagnosis.search.noisy_input import with_smooth_inputs
from hysteresis_bench.diagnosis.search.past import begun, pasts, with_pasts
from hysteresis_bench.diagnosis.search.search import Found, search
from hysteresis_bench.diagnosis.search.selection import ALIKE, BETTER, MISFIT, NAMED
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.smooth.smoothing import Rough
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.progress import Step
from hysteresis_bench.signals import Dataset

PURSUED = 2
"""Laws on which effects are searched, where no model is given. One more costs one more diagnosis."""

SMOOTHED = (
    "The input is measured with noise. It was smoothed by as much as its noise is (a smoothing spline), which leaves "
    "less, so that no effect makes up for the noise; `predict` will leave more with inputs as measured."
)

BETWEEN = (
    f"The samples are few for this law: it was simulated with {FINER} steps from one to the next, along a smooth curve "
    "through the input where it has no corners, so that no effect makes up for what lies between. `predict` does the "
    "same; what `control` and `export` simulate has the steps of its own time."
)

MID_LOOP = (
    "The records seem to begin in mid-loop, where a model begins at rest: until the input has passed both ends of its "
    "range they are off, and not later{}. How far a change with the path, such as fatigue, had gone before is not "
    "known."
)
CUT = "Up to there they are simulated and not scored; `predict` will be off there as well."
PAST = (
    "Two turning points of the input before each record were estimated, which explain what it remembers, and are "
    "simulated before it (of one that is held out, by its beginning, which is not scored); `predict` begins at rest, "
    "and will be off there."
)

ESTIMATED = 3
"""Times that what came before the records is estimated at most, each by another system, that leaves less."""


@economical()
def diagnose(dataset: Dataset, question: Question) -> Diagnosis:
    """Find what a registered model lacks on the fitted records; the held-out ones are opened once, at the end.

    Where no model is asked about, the law is found from the data: all are compared, effects are searched on the most
    promising ones, and the pair of law and effects is taken that predicts best what it did not see (`_preferred`).
    Raises UserError telling every fault at once.
    """
    dataset = without_spikes(dataset)
    if question.model:
        return _diagnosed(dataset, question, _of_few_parameters(registry.names("models")))
    if question.settings or question.bounds or question.fixed:
        raise UserError("diagnose", "settings, bounds and fixed parameters are those of a model; name it.")
    laws = compare(dataset, question, effects_follow=True)
    promising = _promising(laws, len(with_held_out(dataset)[0].fitted) > 1)
    found = [_diagnosed(dataset, replace(question, model=law), promising) for law in promising]
    best = _preferred(found)
    return replace(best, laws=laws, warnings=(_told(best, found, laws), *best.warnings))


def _diagnosed(dataset: Dataset, question: Question, laws: Sequence[str]) -> Diagnosis:
    """laws : which may be the right one, the question's own among them or not"""
    on_step, law = question.options.on_step, question.model
    on_step(Step(f"{law}: the records"))
    prepared = prepare(dataset, question)
    on_step(Step(f"{law}: noise and memory"))
    evidence = gather(prepared.views)
    found = search(prepared, evidence, question)
    on_step(Step(f"{law}: the noise of the input"))
    # the floor knows of the input's noise: what is left far above it, no smoother input explains
    if evidence.noise.input_heard and found.best.rmse <= WRONG * found.selection.floor:
        smooth = prepared.read_as(with_smooth_inputs(prepared.dataset.records), SMOOTHED)
        quiet = gather(smooth.views)
        # what is left of an input that is rough by itself passes for noise again
        again = found if quiet.noise.input_heard else search(smooth, quiet, question)
        if again.best.rmse < found.best.rmse:
            prepared, found = smooth, again
    on_step(Step(f"{law}: what lies between the samples"))
    if few_samples(found):
        finer, again = _anew(prepared.read_as(with_finer_steps(prepared.dataset.records), BETWEEN), question)
        if again.best.rmse < ALIKE * found.best.rmse:
            prepared, found = finer, again
    on_step(Step(f"{law}: the records' beginnings"))
    # what needs no hysteresis remembers nothing of what came before
    if evidence.memory.needed and (spare := only_in_beginnings(found)) is not None:
        prepared, found = _in_mid_loop(prepared, found, spare, question)
    on_step(Step(f"{law}: before and after"))
    stages = settle_offset(prepared, found, question)
    left = remainder(stages.after, found.evidence)
    # slow noise blames nobody, unless a curve without a formula was needed to come down to it; a law that predicts
    # clearly better shows that it is none, and what one excitation leaves may as well be the law's
    blameless = left.slow and not forms_of(stages.adopted) and found.thin.excitations.varied
    witnesses = [] if blameless else _of_few_parameters(registry.names("models"))
    doubted = doubt(found, question, laws, witnesses)
    if doubted != Doubt():
        known, found = found, answered(found, doubted, question.options)
        if found.best is not known.best:
            stages = settle_offset(prepared, found, question)
            left = remainder(stages.after, found.evidence)
    return conclude(dataset, question, prepared, found, stages, left, doubted)


def _anew(ready: Prepared, question: Question) -> tuple[Prepared, Found]:
    return ready, search(ready, gather(ready.views), question)


def _in_mid_loop(prepared: Prepared, found: Found, spare: Sequence[str], question: Question) -> tuple[Prepared, Found]:
    """Without the records' beginnings, or with what came before them where that leaves as little of all samples.

    What came before is estimated by what was found without the beginnings, and again by what is found then."""
    needed = f"{listed(spare)} had been selected and is needed there only, to make up for that" if spare else ""
    told = MID_LOOP.format(f"; {needed}" if needed else "")
    measured = prepared.dataset
    cut = _anew(prepared.read_as(without_beginnings(measured.records), f"{told} {CUT}"), question)
    best, known = cut, {}
    for _ in range(ESTIMATED):
        estimated = pasts(*best[1].thin.fitted(best[1].best), measured.fitted)
        again = _anew(prepared.read_as(with_pasts(measured, estimated), f"{told} {PAST}"), question)
        if best is not cut and again[1].best.rmse >= BETTER * best[1].best.rmse:
            break
        same = again[1].best.names == best[1].best.names
        best, known = again, estimated
        if same:
            break
    if best[1].best.rmse > ALIKE * cut[1].best.rmse:
        best = cut
    else:  # where a held-out record stands tells its past as well
        everywhere = known | pasts(*best[1].thin.fitted(best[1].final), begun(measured.held_out))
        best = (prepared.read_as(with_pasts(measured, everywhere), f"{told} {PAST}"), best[1])
    return best if best[1].best.rmse <= MISFIT * best[1].selection.floor else (prepared, found)


def _promising(laws: Comparison, several: bool) -> list[str]:
    """The chosen law, and those that predict best beside it; of a lone record the former only, as its blocks cannot
    judge between laws."""
    fitted = [law for law in laws.table.dropna(subset="unseen")["law"] if law != BASELINE]
    if not fitted:
        raise UserError("diagnose", f"no law can be fitted to these records. {laws.words}")
    ranked = sorted(fitted, key=lambda law: law != laws.chosen)
    return (_of_few_parameters(ranked) or ranked)[: PURSUED if several else 1]


def _preferred(found: Sequence[Diagnosis]) -> Diagnosis:
    """The one that predicts best. What has no dynamics makes with a law that was not given just another law: one that
    needs nothing of that kind is preferred, unless it leaves more than twice the excess over the noise (`NAMED`)."""
    best, *others = sorted(found, key=lambda one: one.unseen)
    if any(map(is_shape, best.effects)):
        for one in others:
            if not any(map(is_shape, one.effects)) and _excess(best) > (1.0 - NAMED) * _excess(one):
                return one
    return best


def _excess(one: Diagnosis) -> float:
    return one.unseen**2 - one.floor**2


def _of_few_parameters(laws: Sequence[str]) -> list[str]:
    """Without densities of many parameters, among which effects would be lost."""
    return [law for law in laws if not isinstance(registry.build("models", law, {}), Rough)]


def _told(best: Diagnosis, found: list[Diagnosis], laws: Comparison) -> str:
    others = [one for one in found if one is not best]
    rest = "".join(f" {one.model_name} with its effects reaches {one.unseen:.3g}." for one in others)
    return f"{laws.words} With its effects, {best.model_name} predicts what it did not see to {best.unseen:.3g}.{rest}"
