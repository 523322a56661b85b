"""Every law beside every other, beside a polynomial without memory, and beside the noise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.doubt.agreement import is_rate_independent
from hysteresis_bench.diagnosis.evidence.memory import memory
from hysteresis_bench.diagnosis.evidence.noise import pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG, floor_of
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.expected_error import TIED
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.laws.baseline import baseline_ahead, baseline_errors, polynomial
from hysteresis_bench.diagnosis.laws.choice import choose, ranking
from hysteresis_bench.diagnosis.laws.exclusion import excluded, unlike_in_unit, why_not
from hysteresis_bench.diagnosis.laws.law import Law, both
from hysteresis_bench.diagnosis.laws.passing import MOST, Passing
from hysteresis_bench.diagnosis.laws.surroundings import changes, curves
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question, record_faults
from hysteresis_bench.diagnosis.search.selection import MISFIT, REACHED
from hysteresis_bench.diagnosis.structure.structure import Structure, structure
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.fit.checks.asked import around_faults
from hysteresis_bench.fit.checks.faulty_records import without_faults
from hysteresis_bench.fit.checks.settled_periods import SAID, settled_periods, unsettled
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.fit.settling import FIRST_REPEATS, open_loops
from hysteresis_bench.fit.unseen.likeness import judged
from hysteresis_bench.fit.unseen.whole import last_part, open_way
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.kernels.root_mean_square import rms
from hysteresis_bench.signals import Dataset, Record

BASELINE = "cubic polynomial"
REACHABLE = 2.0
"""Times what branches of the data's own leave on a few like excitations, from where no law is chosen: there one of few
parameters may be expected to predict better than a richer one with half its error."""
OPEN = (
    "The record that was fitted closes no loop: nothing in it tells how a law comes back. Do not believe one beyond "
    "these samples, and record a whole cycle."
)
LEADING = 4
"""Laws that are tried with what changes with time, path or temperature, and added waves: what is left last."""
PASSED = f"Every loop was passed until its law closed it, {FIRST_REPEATS} to {MOST} times, before it was scored."


@dataclass(frozen=True, eq=False)
class Comparison:
    """table : a row a law, the best first: law, parameters, fitted, unseen, held_out (RMSE, unit of the output),
    seconds (CPU), reason (why there is no fit)
    chosen : the law that is expected to predict best, "" where none predicts better than the polynomial
    ranked : what was fitted, as of `ranking`; where effects will be sought and no law without dynamics of its own comes
    down to the noise alone, of such a one with dynamics, near the noise, or of several records with what may act around
    it
    words : why, in a sentence;  floor : RMS below which nothing is judged;  units : of the data
    notes : how it was made;  structure : what the data say before any fit
    """

    table: pd.DataFrame
    chosen: str
    words: str
    floor: float
    units: dict[str, str]
    notes: tuple[str, ...] = ()
    structure: Structure | None = None
    ranked: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """For a JSON file."""
        rows = self.table.astype(object).where(self.table.notna(), None).to_dict("records")
        findings = [finding.as_dict() for finding in self.structure.findings] if self.structure else []
        told = {"chosen": self.chosen or None, "words": self.words, "floor": self.floor}
        return {**told, "laws": rows, "structure": findings}


@economical()
def compare(dataset: Dataset, question: Question, *, effects_follow: bool = False) -> Comparison:
    """Fit every law that the question's options name to the fitted records, and predict what it did not see.

    Where none is named, those are left out that the data exclude. Held-out records are predicted and never choose.
    effects_follow : effects will be sought around the laws, and a part is held out where none is.
    Raises UserError telling every fault at once.
    """
    options, purpose = question.options, "diagnose" if effects_follow else "compare"
    ready = _prepared(question.in_wanted_units(dataset), question, purpose)
    settles = settled_periods(ready.fitted, options.settle)
    passing = Passing(ready, settles, effects_follow, tuple(question.effects), options.seed)
    thin, seen = passing.begun, passing.begun.dataset
    views = views_of(seen.fitted)
    floor = floor_of(views, pooled_noise([view.noise for view in views]))
    asked = views_of(thin.records)
    found, out = structure(asked), judged(thin.records, seen)
    names, reasons = tuple(options.laws), dict[str, str]()
    if not names:
        names = registry.usable("models")
        # branches of the data's own, judged on what they were not fitted to, do about as well as the best law
        reachable = max(floor, memory(asked).branch_rmse) * (1.0 if out.telling else REACHABLE)
        reasons = excluded(names, found, reachable, alone=not (question.effects or effects_follow))
    reasons |= unlike_in_unit(names, thin.records)
    with Workers[Law](passing, options.processes, options.on_step, options.kept) as workers:
        fitted = workers.map([("law", name) for name in names if name not in reasons])
        wanting = _wanting(fitted, floor) if effects_follow else []
        around = _around(workers, wanting, floor, lone=len(thin.records) == 1)
    struck = [Law(name, reason) for name, reason in reasons.items()]
    laws = sorted([*fitted, *struck], key=lambda law: law.rmse)
    plain = both(baseline_errors(thin.records, out.blocks), baseline_ahead(thin.records, last_part(thin.records)))
    chosen, why = choose(laws, plain, out.blocks, like=out.like)
    better = {law.model: law for law in around}
    rows = [*(_row(law, better.get(law.model)) for law in laws), _baseline_row(plain, seen)]
    table = pd.DataFrame(rows).sort_values("unseen", kind="stable", na_position="last", ignore_index=True)
    ranked = ranking([better.get(law.model, law) for law in laws], REACHED * floor, out.blocks, like=out.like)
    taken = next((law for law in laws if law.model == chosen), None)
    words = [
        why,
        *(_beside_noise(taken, floor, found) if taken else ()),
        *_cautions(chosen, thin.records, found, table),
        *(() if effects_follow else unsettled(ready.fitted, options.settle)),  # a diagnosis says so itself
        *_better_around(chosen, ranked, around),
    ]
    told = ((SAID,) if options.settle is None else ()) + (PASSED,) if settles else ()
    notes = (*_notes(seen, options), *told)
    return Comparison(table, chosen, " ".join(words), floor, dict(dataset.units), notes, found, ranked)


def _beside_noise(law: Law, floor: float, found: Structure) -> Iterator[str]:
    """What the law that was chosen leaves, and why, where that is far above the noise."""
    left = law.rmse / floor
    if left > WRONG:
        yield f"It leaves {rounded(left)} times the noise: the law cannot follow these data, or an effect is missing."
        if why := why_not(law.model, found, law.rmse):
            yield why


def _cautions(chosen: str, records: Sequence[Record], found: Structure, table: pd.DataFrame) -> Iterator[str]:
    """Why not to believe what was chosen, or why nothing was.  records : that were fitted;  table : of a comparison"""
    if chosen and open_way(records):
        yield OPEN
    if not chosen and found.of("sense").mixed:
        yield f"Of these records {found.of('sense').words}"
    held_out = table.set_index("law")["held_out"]
    if chosen and held_out[chosen] > held_out[BASELINE]:  # False where nothing is held out
        yield "On what was held out it does worse than the polynomial: do not believe it there."


def _better_around(chosen: str, ranked: Sequence[str], around: Sequence[Law]) -> Iterator[str]:
    """Which other law predicts best with what may act around it, and which do as well."""
    first = next((law for law in around if law.model == next(iter(ranked), "")), None)
    if first and first.model != chosen:
        equal = [law.model for law in around if law is not first and law.rmse <= TIED * first.rmse]
        as_well = f", and {listed(sorted(equal))} as well." if equal else "."
        yield f"With what may act around it, {first.model} predicts that to {first.rmse:.3g}{as_well}"


def _wanting(fitted: Sequence[Law], floor: float) -> list[Law]:
    """Laws without dynamics of their own, where none comes down to the noise: those with them, or of many parameters,
    may owe their place to an effect that the others lack."""
    still = [law for law in fitted if law.found is not None and is_rate_independent(law.model)]
    return still if _least(still) > REACHED * floor else []


def _around(workers: Workers[Law], laws: Sequence[Law], floor: float, *, lone: bool) -> list[Law]:
    """As laws without dynamics predict with what may act around them: with dynamics, and of several records with
    whatever it takes to come near the noise.

    lone : one record was fitted. What is around a wrong law follows its fault there, so that they count near the noise
    alone: a friction damper comes to 17 times the noise so, a piezo stack to 1.5."""
    moved = workers.map([("with_dynamics", law) for law in laws])
    if not lone:
        return _surrounded(workers, laws, moved, floor)
    return moved if _least(moved) <= WRONG * floor else []


def _surrounded(workers: Workers[Law], laws: Sequence[Law], known: Sequence[Law], floor: float) -> list[Law]:
    """As they predict with what may act around them, tried in rounds while all of them are far from the noise.

    known : the laws with dynamics"""
    moved, alone = list(known), {law.model: law for law in laws}
    if _far(moved, floor):
        moved = workers.map([("with_any", alone[law.model], law, curves) for law in moved])
    if _far(moved, floor):
        moved = sorted(moved, key=lambda law: law.rmse)
        moved[:LEADING] = workers.map([("with_any", alone[law.model], law, changes) for law in moved[:LEADING]])
    return moved


def _far(laws: Sequence[Law], floor: float) -> bool:
    """Does the best leave more than a right law may that predicts by many parameters?"""
    return _least(laws) > MISFIT * floor


def _least(laws: Sequence[Law]) -> float:
    """What the best leaves; 0 without laws."""
    return min((law.rmse for law in laws), default=0.0)


def law_faults(models: Sequence[str], effects: Sequence[str]) -> list[str]:
    """A sentence on every fault of the names of laws that are compared, and of the effects around them."""
    known = registry.names("models")
    faults = [f'no model "{name}". {nearest(name, known)}' for name in models if name not in known]
    faults += [f'the model "{name}" is named twice.' for name in {*models} if list(models).count(name) > 1]
    return faults + around_faults("", effects)


def _prepared(dataset: Dataset, question: Question, purpose: str) -> Dataset:
    """As the laws see it.  purpose : the command that asks"""
    faults = law_faults(question.options.laws, question.effects) + question.preparation.faults(dataset.records)
    faults += open_loops(dataset.records) if question.options.settle and not faults else []
    seen = dataset if faults else without_faults(dataset).map(question.preparation)
    if faults := faults or record_faults(seen.fitted, purpose):
        raise UserError(purpose, faults)
    return seen


def _notes(seen: Dataset, options: DiagnosisOptions) -> tuple[str, ...]:
    fitted, held_out = ([record.name for record in records] for records in (seen.fitted, seen.held_out))
    return (
        *seen.notes,
        f"Fitted: {', '.join(fitted)}." + (f" Held out: {', '.join(held_out)}." if held_out else ""),
        f"Every law is fitted by two searches of {registry.SEARCH} (seed {options.seed}), with an offset for each "
        "record.",
    )


def _row(law: Law, around: Law | None) -> dict[str, object]:
    return {
        "law": law.model,
        "parameters": law.parameters,
        "fitted": law.fitted,
        "unseen": law.rmse if law.unseen.size else np.nan,
        "held_out": law.held_out,
        "around": around.rmse if around else np.nan,
        "seconds": law.seconds,
        "reason": law.reason,
    }


def _baseline_row(unseen: float, seen: Dataset) -> dict[str, object]:
    plain = polynomial(seen.fitted)
    fitted, held = ([plain.errors(record) for record in records] for records in (seen.fitted, seen.held_out))
    return {
        "law": BASELINE,
        "parameters": plain.coefficients.size,
        "fitted": rms(np.concatenate(fitted)),
        "unseen": unseen,
        "held_out": rms(np.concatenate(held)) if held else np.nan,
        "around": np.nan,
        "seconds": 0.0,
        "reason": "",
    }
