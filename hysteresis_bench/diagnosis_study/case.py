"""One case of a study of diagnosis: data with known hidden effects in, who was named out."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PositiveInt

from hysteresis_bench import registry
from hysteresis_bench.contracts import Rig
from hysteresis_bench.fit.search import generator
from hysteresis_bench.signals import Dataset, joined
from hysteresis_bench.study.study_file import duration


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class BenchSpec(_Strict):
    """One bench: a rig, what is hidden in it, and what the diagnosis gets to see.

    hidden : names that count as right, one entry for each effect that is switched on; "a|b" where either name says
        it. "of the rig" takes the names from what the rig itself says is hidden
    vary : the rig's setting that takes the number of the case; seeds alone differ where it is empty
    fresh : experiments that are neither fitted nor held out, for the error at the end
    share : cases of this bench for each of the study's trials
    """

    name: str
    rig: str
    settings: dict[str, Any] = {}
    hidden: list[str] | Literal["of the rig"] = "of the rig"
    vary: str = ""
    model: str
    fitted: list[str] = Field(min_length=1)
    held_out: list[str] = Field(min_length=1)
    fresh: list[str] = []
    options: dict[str, Any] = {}
    share: PositiveInt = 1


class DiagnosisStudy(_Strict):
    """A checked study of diagnosis."""

    kind: Literal["diagnosis"]
    title: str
    seed: int
    trials: PositiveInt = 1
    timeout: Annotated[float, BeforeValidator(duration)] = 900.0
    notes: list[str] = []
    bench: list[BenchSpec] = Field(min_length=1)


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

    named : hidden effects that were claimed by name;  tied : claimed only as tied with another
    missed : hidden and neither;  extra : claimed without being hidden
    before, after : RMSE held out, over the noise (an estimate where the rig does not tell);  fresh : the same, after,
        on records that were neither fitted nor held out;  unfitted : fitted RMSE of the bare model over the noise
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


def run_case(ticket: CaseTicket) -> Case:
    """Measure, diagnose, and compare what was claimed with what is hidden."""
    from hysteresis_bench.diagnosis.diagnose import diagnose
    from hysteresis_bench.diagnosis.question import Question

    study = DiagnosisStudy.model_validate_json(ticket.study)
    bench = next(bench for bench in study.bench if bench.name == ticket.bench)
    rig = build_rig(bench, ticket.number)
    key = (study.seed, bench.name, ticket.number)
    seen = measured(rig, [*bench.fitted, *bench.held_out], *key).split(bench.held_out)
    truth = hidden_in(bench, seen)
    begun = time.monotonic()
    found = diagnose(Dataset(seen.records, seen.held_out_names), Question(bench.model, **bench.options), jobs=1)
    seconds = time.monotonic() - begun
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
        records = measured(rig, bench.fresh, *key)
        predicted = found.model.predict(records)
        errors = [p.output - r.output for p, r in zip(predicted.records, records.records, strict=True)]  # type: ignore[operator]
        fresh = float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) / noise
    return Case(
        bench.name,
        bench.model,
        ticket.number,
        "done",
        hidden=" ".join(truth),
        claimed=" ".join(claimed),
        named=" ".join(named),
        tied=" ".join(tied),
        missed=" ".join(missed),
        extra=" ".join(extra),
        verdict=found.verdict,
        noise=noise,
        before=before.rmse / noise,
        after=after.rmse / noise,
        fresh=fresh,
        unfitted=found.before.fitted.rmse / noise,
        seconds=seconds,
    )


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


def measured(rig: Rig, experiments: Sequence[str], *key: object) -> Dataset:
    """One record an experiment, each with noise of its own."""
    return joined(*(rig.measure(experiment, generator(*key, experiment)) for experiment in experiments))


def hidden_in(bench: BenchSpec, dataset: Dataset) -> tuple[str, ...]:
    """What a right diagnosis names."""
    if bench.hidden == "of the rig":
        return tuple(name for name in dataset.hidden if name != "noise")
    return tuple(bench.hidden)


def _noise(dataset: Dataset, estimate: float) -> float:
    """RMS of the noise: as the rig tells, or as it is estimated where noise also enters through the input."""
    told = dataset.hidden.get("noise")
    if isinstance(told, Mapping):
        told = None if told.get("input") else told.get("output")
    return float(told) if isinstance(told, (int, float)) and told > 0 else estimate


def build_rig(bench: BenchSpec, number: int) -> Rig:
    """The rig of a case."""
    settings = {**bench.settings, **({bench.vary: number} if bench.vary else {})}
    rig: Rig = registry.build("rigs", bench.rig, settings)
    return rig
