"""Diagnosis around one law: the search in the records as they are read best, and what is told of what it found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.agreement import is_shape
from hysteresis_bench.diagnosis.doubt.density import in_its_place
from hysteresis_bench.diagnosis.doubt.doubt import answered, doubt
from hysteresis_bench.diagnosis.evidence.evidence import gather
from hysteresis_bench.diagnosis.evidence.noise import pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.findings.conclude import conclude
from hysteresis_bench.diagnosis.findings.remainder import Remainder, remainder
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.stages import Stages, settle_offset
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.preparation import Prepared, prepare
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.reading.beginnings import only_in_beginnings, without_beginnings
from hysteresis_bench.diagnosis.reading.between_samples import few_samples
from hysteresis_bench.diagnosis.reading.drifts import DRIFTS, drift_of_each
from hysteresis_bench.diagnosis.reading.lone_samples import without_lone_samples
from hysteresis_bench.diagnosis.reading.noisy_input import with_smooth_inputs
from hysteresis_bench.diagnosis.reading.past import Past, begun, explain, pasts, settled, with_pasts
from hysteresis_bench.diagnosis.reading.scales import scaled, scales_of_each, scales_told
from hysteresis_bench.diagnosis.reading.zeros import levelled, zeros_of_each, zeros_told
from hysteresis_bench.diagnosis.search.fallback import unseen_rmse
from hysteresis_bench.diagnosis.search.search import Found, search
from hysteresis_bench.diagnosis.search.selection import ALIKE, BETTER, MISFIT, REACHED
from hysteresis_bench.diagnosis.search.sets import claims
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.smooth.rough import Rough
from hysteresis_bench.fit.unseen.between_samples import FINER, with_finer_steps
from hysteresis_bench.progress import Step
from hysteresis_bench.signals import Dataset

SMOOTHED = (
    "The input is measured with noise. It was smoothed by as much as its noise is (a hum taken off, a smoothing "
    "spline), so that no effect makes up for the noise; what that may still leave of it is taken for noise of the "
    "output. `predict` will leave more with inputs as measured."
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

OWN = (("scales", scales_of_each, scaled, scales_told), ("zeros", zeros_of_each, levelled, zeros_told))
"""What every record may have for itself: in a word, what finds it, takes it off, and tells it."""

ESTIMATED = 3
"""Times that what came before the records is estimated at most, each by another system, that leaves less."""


@dataclass(frozen=True)
class Standing:
    """What a law with its effects is preferred by.

    effects : in the model;  parameters : how many, of the law and of the effects
    unseen, floor : as of `Diagnosis`
    """

    law: str
    effects: tuple[str, ...]
    parameters: int
    unseen: float
    floor: float

    @property
    def reached(self) -> bool:
        """Does it predict to the noise?"""
        return self.unseen <= REACHED * self.floor

    @property
    def shaped(self) -> bool:
        """Does it need what has no dynamics, which may be another law's shape?"""
        return any(map(is_shape, self.effects))


@dataclass(frozen=True, eq=False)
class Around:
    """What was found around one law, before other laws are asked. question : with that law for its model"""

    dataset: Dataset
    question: Question
    prepared: Prepared
    found: Found

    @cached_property
    def standing(self) -> Standing:
        """Beside other laws with their effects."""
        found = self.found
        adopted, unseen = found.selection.adopted(found.best), unseen_rmse(found.thin, found.final)
        return Standing(self.question.model, adopted, len(found.final.values), unseen, found.evidence.floor)


def searched(dataset: Dataset, question: Question) -> Around:
    """Effects around the question's model, in the records as they leave least.

    Raises UserError telling every fault of the question and of the records at once."""
    on_step, law = question.options.on_step, question.model
    on_step(Step(f"{law}: the records"))
    prepared = prepare(dataset, question)
    on_step(Step(f"{law}: noise and memory"))
    evidence = gather(prepared.views)
    found = search(prepared, evidence, question)
    on_step(Step(f"{law}: lone samples"))
    if found.follows and (mended := without_lone_samples(found, prepared.dataset)):
        prepared = prepared.read_as(mended.records, mended.note)
        if mended.refit:
            prepared, found = _anew(prepared, question)
            evidence = found.evidence
    on_step(Step(f"{law}: the noise of the input"))
    # the floor knows of the input's noise: what is left far above it, no smoother input explains. The records are
    # asked: where the noise was estimated anew, from what a system leaves, the input's counts as the output's
    heard = pooled_noise([view.noise for view in prepared.views]).input_heard
    if heard and found.best.rmse <= WRONG * found.selection.floor:
        smooth = prepared.read_as(with_smooth_inputs(prepared.dataset.records), SMOOTHED)
        quiet = gather(smooth.views)
        # what is left of an input that is rough by itself passes for noise again
        again = found if quiet.noise.input_heard else search(smooth, quiet, question)
        if explains_more(again.best, found.best, found.selection.floor):
            prepared, found = smooth, again
    on_step(Step(f"{law}: what lies between the samples"))
    if few_samples(found):
        finer, again = _anew(prepared.read_as(with_finer_steps(prepared.dataset.records), BETWEEN), question)
        if again.best.rmse < ALIKE * found.best.rmse:
            prepared, found = finer, again
    for what, own_of_each, without, told in OWN:
        on_step(Step(f"{law}: the records' {what}"))
        if own := own_of_each(found, prepared.dataset.held_out):
            records = prepared.dataset.records
            prepared, found = _anew(prepared.read_as(without(records, own), told(records, own)), question)
    on_step(Step(f"{law}: the records' beginnings"))
    # what needs no hysteresis remembers nothing of what came before
    if evidence.memory.needed:
        spare = only_in_beginnings(found)
        if spare is not None or explain(found, prepared.dataset):
            if drifting := drift_of_each(found):
                question = replace(question, effects=(*question.effects, drifting))
                prepared, found = _anew(prepared.read_as(prepared.dataset.records, DRIFTS.format(drifting)), question)
            else:
                prepared, found = _in_mid_loop(prepared, found, spare or (), question)
    return Around(dataset, question, prepared, found)


def explains_more(smooth: Hypothesis, found: Hypothesis, floor: float) -> bool:
    """Does a smoother input leave less? Instead of effects, or of as many others, it may leave a little more: one that
    takes the input's noise off as well also takes off what a spline leaves of it, or takes for noise. Instead of
    effects it may leave as much as the input's noise does by itself: all that were needed were sought again without it.

    floor : with the noise of inputs as they were measured"""
    if claims(smooth) < claims(found):
        return smooth.rmse < REACHED * max(found.rmse, floor)
    others = claims(smooth) == claims(found) and smooth.names != found.names
    return smooth.rmse < (ALIKE if others else 1.0) * found.rmse


def concluded(around: Around, laws: Sequence[str], densities: Sequence[str] = ()) -> Diagnosis:
    """The diagnosis, after other laws were asked whether the records are theirs, and what they need.

    laws : which may be the right one, the question's own among them or not; without any, nobody else is asked
    densities : laws of many parameters, one of which may take this one's place"""
    question, prepared, found = around.question, around.prepared, around.found
    question.options.on_step(Step(f"{question.model}: before and after"))
    stages = settle_offset(prepared, found, question)
    left = _left(stages, found)
    # noise blames nobody, unless a curve without a formula was needed to come down to it; a law that predicts
    # clearly better shows that it is none, and what one excitation leaves may as well be the law's
    blameless = left.noise and not forms_of(stages.adopted) and found.thin.excitations.varied
    witnesses = [] if blameless or not laws else of_few_parameters(registry.usable("models"))
    doubted = doubt(found, question, laws, witnesses)
    if doubted.raised:
        known, found = found, answered(found, doubted, question.options)
        if found.best.names > known.best.names:
            # with more around it the law may do as well as another one did: that is asked again
            return concluded(replace(around, found=found), laws, densities)
        if found.best is not known.best:
            stages = settle_offset(prepared, found, question)
            left = _left(stages, found)
    for law in densities:
        if better := in_its_place(law, prepared, found, question):
            ready, dense, asked = better
            return concluded(Around(around.dataset, asked, ready, dense), ())
    return conclude(around.dataset, question, prepared, found, stages, left, doubted)


def _left(stages: Stages, found: Found) -> Remainder:
    """In the residual of the last stage; what a black box predicts of records left out is no noise."""
    left = remainder(stages.after, found.evidence, found.thin.fitted_values(found.final))
    several = len(found.thin.stack.records) > 1
    return left.of_a_cause() if several and left.noise and found.ceiling.better else left


def _anew(ready: Prepared, question: Question) -> tuple[Prepared, Found]:
    return ready, search(ready, gather(ready.views), question)


def _in_mid_loop(prepared: Prepared, found: Found, spare: Sequence[str], question: Question) -> tuple[Prepared, Found]:
    """Without the records' beginnings, or with what came before them where that leaves as little of all samples.

    What came before is estimated by what was found without the beginnings, and again where something else is found
    then."""
    needed = f"{listed(spare)} had been selected and is needed there only, to make up for that" if spare else ""
    told = MID_LOOP.format(f"; {needed}" if needed else "")
    measured = prepared.dataset
    cut = _anew(prepared.read_as(without_beginnings(measured.records), f"{told} {CUT}"), question)
    system, estimated = settled(cut[1], measured)
    limit = WRONG * cut[1].selection.floor
    if min(system.rmse, cut[1].best.rmse) > limit:
        return prepared, found  # the law is wrong, whatever came before
    best, known = cut, dict[str, Past]()
    for _ in range(ESTIMATED):
        again = _anew(prepared.read_as(with_pasts(measured, estimated), f"{told} {PAST}"), question)
        if again[1].best.rmse >= limit:
            break
        best, known, limit = again, estimated, BETTER * again[1].best.rmse
        if again[1].best.names == system.names:
            break
        system, estimated = settled(again[1], measured)
    if known and best[1].best.rmse <= ALIKE * cut[1].best.rmse:  # where a held-out record stands tells its past as well
        everywhere = known | pasts(*best[1].thin.fitted(best[1].final), begun(measured.held_out))
        best = (prepared.read_as(with_pasts(measured, everywhere), f"{told} {PAST}"), best[1])
    else:
        best = cut
    return best if best[1].best.rmse <= MISFIT * best[1].selection.floor else (prepared, found)


def of_few_parameters(laws: Sequence[str]) -> list[str]:
    """Without densities of many parameters, among which effects would be lost."""
    return [law for law in laws if not isinstance(registry.build("models", law, {}), Rough)]
