"""One case of a study of diagnosis: data with known hidden effects in, who was named out."""

from __future__ import annotations

import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.contracts import DrivenRig, Rig
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.experiments.settled import Tied
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis.search.certainty import Certainty
from hysteresis_bench.diagnosis_study.advised import Bench, measured, nothing_to_measure, ties_after
from hysteresis_bench.diagnosis_study.study_file import BenchSpec, DiagnosisStudy
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.problems import measure


@dataclass(frozen=True)
class CaseTicket:
    """Which case to run. The study travels as text."""

    study: str
    bench: str
    number: int

    @property
    def file(self) -> str:
        return f"{''.join(c if c.isalnum() else '-' for c in self.bench)}.{self.number}.json"


@dataclass(frozen=True)
class Case:
    """What became of one case; effects are names joined by spaces, absent numbers None.

    model : that was asked about, or else the law that was found
    named : hidden effects that were claimed by name;  tied : claimed only as tied with another
    missed : hidden and neither;  extra : claimed without being hidden
    sure : probabilities of the claims, in their order, "-" where none is told
    family : those of the missed for which a free form of their family was claimed, or tied with a claimed one, which
        stands under extra
    before, after : RMSE held out, over the noise (an estimate where the rig does not tell);  fresh : the same, after,
        on records that were neither fitted nor held out, without what is imperfect about these
    unfitted : fitted RMSE of the bare model over the noise
    ties : "one~other~third" each, where the bench measures what is advised;  told : with what probability that was
    expected to settle each, "-" where it was not made for it
    settled : what became of each: "right", the hidden one alone is claimed; "narrowed", it is among fewer; "open",
    all are tied still; "wrong", one is claimed that is not hidden; "gone", none is claimed any more; "void", none of
    them is hidden
    then : effects that are claimed after that experiment
    """

    bench: str
    model: str
    number: int
    status: str
    reason: str = ""
    hidden: str = ""
    claimed: str = ""
    named: str = ""
    tied: str = ""
    missed: str = ""
    extra: str = ""
    family: str = ""
    sure: str = ""
    ties: str = ""
    told: str = ""
    settled: str = ""
    then: str = ""
    verdict: str = ""
    noise: float | None = None
    before: float | None = None
    after: float | None = None
    fresh: float | None = None
    unfitted: float | None = None
    seconds: float | None = None

    @property
    def right(self) -> bool:
        """Every hidden effect named or tied with a claimed one, and none extra."""
        return self.status == "done" and not self.missed and not self.extra

    @property
    def right_by_family(self) -> bool:
        """Every hidden effect named, tied, or its family named with its curve, and nothing else claimed."""
        missed, extra, family = (text.split() for text in (self.missed, self.extra, self.family))
        return self.status == "done" and sorted(missed) == sorted(family) and len(extra) == len(family)


def run_case(ticket: CaseTicket) -> Case:
    """Measure, diagnose, and compare what was claimed with what is hidden."""
    study = DiagnosisStudy.model_validate_json(ticket.study)
    bench = next(bench for bench in study.bench if bench.name == ticket.bench)
    rig = build_rig(bench, ticket.number)
    key = (study.seed, bench.name, ticket.number)
    seen = measure(rig, [*bench.fitted, *bench.held_out], *key).split(bench.held_out)
    truth = hidden_in(bench, seen)
    begun = time.monotonic()
    blind = Dataset(seen.records, seen.held_out_names)
    question = Question(bench.model, options=DiagnosisOptions(jobs=1))
    found = diagnose(blind, question)
    seconds = time.monotonic() - begun
    driven = Bench(rig, bench.rig, key) if bench.measure and isinstance(rig, DrivenRig) else None
    last = _measured(blind, question, found, driven) if driven else found
    ties = ties_after(found, last) if driven else ()
    rivals = {
        name: {tie.rival for tie in found.ties if tie.effect == name}
        | {t.effect for t in found.ties if t.rival == name}
        for name in found.effects
    }
    claimed = [name for name in found.effects if name != registry.RECORD_OFFSET]
    named, tied, missed, extra = compared(truth, claimed, rivals)
    noise = _noise(seen, found.floor)
    before, after = (stage.held_out or stage.fitted for stage in (found.before, found.after))
    fresh = None
    if bench.fresh:
        sound = {name: value for name, value in bench.settings.items() if name != "imperfect"}
        records = measure(build_rig(bench.model_copy(update={"settings": sound}), ticket.number), bench.fresh, *key)
        predicted = found.model.predict(records)
        errors = [p.output - r.output for p, r in zip(predicted.records, records.records, strict=True)]  # type: ignore[operator]
        fresh = float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) / noise
    return Case(
        bench.name,
        found.model_name,
        ticket.number,
        "done",
        hidden=" ".join(truth),
        claimed=" ".join(claimed),
        named=" ".join(named),
        tied=" ".join(tied),
        missed=" ".join(missed),
        extra=" ".join(extra),
        sure=" ".join(_told(found.certainty.get(name)) for name in claimed),
        family=" ".join(by_family(missed, [_families({name, *rivals[name]}) for name in extra])),
        ties=" ".join("~".join(tied.names) for tied in ties),
        told=" ".join("-" if tied.probability is None else f"{tied.probability:.3f}" for tied in ties),
        settled=" ".join(outcome(tied, truth) for tied in ties),
        then=" ".join(last.effects) if ties else "",
        verdict=found.verdict,
        noise=noise,
        before=before.rmse / noise,
        after=after.rmse / noise,
        fresh=fresh,
        unfitted=found.before.fitted.rmse / noise,
        seconds=seconds,
    )


def _told(certainty: Certainty | None) -> str:
    told = certainty.probability if certainty else None
    return "-" if told is None else f"{told:.3f}"


def _measured(dataset: Dataset, question: Question, found: Diagnosis, bench: Bench) -> Diagnosis:
    """After the advised experiment; the same where there is none."""
    return (
        found if nothing_to_measure(found) else measured(dataset, found, bench, lambda more: diagnose(more, question))
    )


def outcome(tied: Tied, truth: Sequence[str]) -> str:
    """What became of a tie, as in `Case.settled`; truth : as of `compared`"""
    hidden = {name for entry in truth for name in entry.split("|")} & {*tied.names}
    if not hidden:
        return "void"
    if not tied.left:
        return "gone"
    if not all(hidden & {*names} for names in tied.left):
        return "wrong"
    return "open" if tied.open else "right" if all(len(names) == 1 for names in tied.left) else "narrowed"


def compared(
    truth: Sequence[str], claimed: Sequence[str], rivals: Mapping[str, set[str]]
) -> tuple[list[str], list[str], list[str], list[str]]:
    """Which of the hidden effects were named, tied with a claimed one, or missed, and which claims are extra.

    truth : one entry a hidden effect, "a|b" where either name says it;  rivals : of each claimed effect
    """
    left = list(claimed)
    named: list[str] = []
    tied: list[str] = []
    missed: list[str] = []
    for entry in truth:
        match = next((name for name in entry.split("|") if name in left), None)
        if match:
            left.remove(match)
            named.append(entry)
    for entry in (entry for entry in truth if entry not in named):
        match = next((name for name in left if rivals.get(name, set()) & set(entry.split("|"))), None)
        if match:
            left.remove(match)
        (tied if match else missed).append(entry)
    return named, tied, missed, left


def by_family(missed: Sequence[str], families: Sequence[Collection[str]]) -> list[str]:
    """Which of the missed effects have their family among the claimed ones; each claim counts once.

    families : of each claim, its own and those of what is tied with it
    """
    left, found = list(families), []
    for entry in missed:
        own = {registry.effect(name).family for name in entry.split("|")}
        claim = next((each for each in left if own & {*each}), None)
        if claim is not None:
            left.remove(claim)
            found.append(entry)
    return found


def _families(names: Collection[str]) -> set[str]:
    """Of the free forms among effects."""
    return set(forms_of(tuple(names)).values())


def hidden_in(bench: BenchSpec, dataset: Dataset) -> tuple[str, ...]:
    """What a right diagnosis names."""
    if bench.hidden is None:
        return tuple(name for name in dataset.hidden if name != "noise")
    return tuple(bench.hidden)


def _noise(dataset: Dataset, estimate: float) -> float:
    """RMS of the noise: as the rig tells, or as it is estimated where noise also enters through the input."""
    known = dataset.hidden.get("noise")
    if isinstance(known, Mapping):
        known = None if known.get("input") else known.get("output")
    return float(known) if isinstance(known, (int, float)) and known > 0 else estimate


def build_rig(bench: BenchSpec, number: int) -> Rig:
    """The rig of a case."""
    settings = {**bench.settings, **({bench.vary: number} if bench.vary else {})}
    rig: Rig = registry.build("rigs", bench.rig, settings)
    return rig
