"""Diagnosis: fit a model, see what is left, name what is missing, refit, and report before and after."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.around import Around, Standing, concluded, of_few_parameters, searched
from hysteresis_bench.diagnosis.doubt.agreement import is_rate_independent
from hysteresis_bench.diagnosis.doubt.same_effects import better_law, simpler_law
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.hypotheses.expected_error import TIED
from hysteresis_bench.diagnosis.laws.comparison import Comparison, compare
from hysteresis_bench.diagnosis.preparation import with_held_out
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.selection import NAMED
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.checks.faulty_records import without_faults
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.signals import Dataset

PURSUED = 2
"""Laws on which effects are searched, where no model is given. One more costs one more diagnosis."""


@economical()
def diagnose(dataset: Dataset, question: Question) -> Diagnosis:
    """Find what a registered model lacks on the fitted records; the held-out ones are opened once, at the end.

    Where no model is asked about, the law is found from the data: all are compared, effects are searched on the most
    promising ones, and the pair of law and effects is taken that predicts best what it did not see (`_preferred`).
    Raises UserError telling every fault at once.
    """
    dataset = question.in_wanted_units(without_faults(dataset))
    if question.model:
        return concluded(searched(dataset, question), of_few_parameters(registry.usable("models")))
    if question.settings or question.bounds or question.fixed:
        raise UserError("diagnose", "settings, bounds and fixed parameters are those of a model; name it.")
    laws = compare(dataset, question, effects_follow=True)
    found = list(_pursued(dataset, question, laws))
    if simpler := _simpler(found, laws, question.options.seed):
        found.append(searched(dataset, replace(question, model=simpler)))
    best = _judged(found, [law for law in laws.ranked if law not in of_few_parameters(laws.ranked)])
    return replace(best, laws=laws, warnings=(_told(best, found, laws), *best.warnings))


def _pursued(dataset: Dataset, question: Question, laws: Comparison) -> Iterator[Around]:
    """The most promising law, and another one unless that predicts to the noise, without anything that another law may
    have in itself or in its shape: from there none can do clearly better with less. Where it does not predict to the
    noise, the other is the one that follows best with the effects that were found around it; the laws were ranked
    without them."""
    first, *others = _promising(laws, len(with_held_out(dataset)[0].fitted) > 1)
    yield (one := searched(dataset, replace(question, model=first)))
    if not others or (is_rate_independent(first) and one.standing.reached and not one.standing.shaped):
        return
    better = "" if one.standing.reached else better_law(first, one.found, _plain(laws, [first]), question.options)
    yield searched(dataset, replace(question, model=better or others[0]))


def _simpler(found: Sequence[Around], laws: Comparison, seed: int) -> str:
    """A law of fewer parameters than the preferred one has, which may predict to the noise as well; "" if none does.
    One with dynamics of its own may hold the effect in itself."""
    preferred = _preferred([one.standing for one in found])
    if not preferred.reached:
        return ""
    (around,) = (one for one in found if one.question.model == preferred.law)
    others = _plain(laws, [one.question.model for one in found])
    own = laws.table.set_index("law")["parameters"][preferred.law]
    fewer = [law for law, count in others.items() if count < own]
    return simpler_law(preferred.law, around.found, sorted(fewer, key=lambda law: others[law]), seed)


def _plain(laws: Comparison, known: Sequence[str]) -> dict[str, int]:
    """Laws of few parameters without dynamics of their own that are not `known`, and how many parameters they have."""
    count = laws.table.set_index("law")["parameters"]
    others = [law for law in of_few_parameters(laws.ranked) if law not in known and is_rate_independent(law)]
    return {law: int(count[law]) for law in others}


def _judged(found: Sequence[Around], densities: Sequence[str]) -> Diagnosis:
    """The preferred one, as it is after other laws were asked; then another one may be preferred, and is asked too."""
    standings, known = {one.question.model: one.standing for one in found}, dict[str, Diagnosis]()
    laws = tuple(standings)
    while (law := _preferred([*standings.values()]).law) not in known:
        (around,) = (one for one in found if one.question.model == law)
        known[law] = told = concluded(around, laws, densities)
        standings[law] = Standing(law, told.effects, len(told.model.parameters), told.unseen, told.floor)
    return known[law]


def _promising(laws: Comparison, several: bool) -> list[str]:
    """The chosen law, and the next one that is expected to predict well. A law with dynamics of its own may owe its
    place to an effect that others lack: beside it, one without is pursued. Of a lone record the chosen one only, as its
    blocks cannot judge between laws."""
    if not laws.ranked:
        raise UserError("diagnose", f"no law can be fitted to these records. {laws.words}")
    first, *others = of_few_parameters(laws.ranked) or list(laws.ranked)
    if not is_rate_independent(first):
        others.sort(key=lambda law: not is_rate_independent(law))
    return [first, *others][: PURSUED if several else 1]


def _preferred(found: Sequence[Standing]) -> Standing:
    """The one that predicts best; of those that predict to the noise, equally well (`TIED`), that of fewest parameters.
    What has no dynamics makes with a law that was not given just another law: one that needs nothing of that kind is
    preferred, unless it leaves more than twice the excess over the noise (`NAMED`)."""
    best, *others = sorted(found, key=lambda one: one.unseen)
    if best.reached:
        tied = [best, *(one for one in others if one.unseen <= TIED * best.unseen)]
        return min(tied, key=lambda one: (one.parameters, one.shaped))
    plain = (one for one in others if not one.shaped and _excess(best) > (1.0 - NAMED) * _excess(one))
    return next(plain, best) if best.shaped else best


def _excess(one: Standing) -> float:
    return one.unseen**2 - one.floor**2


def _told(best: Diagnosis, found: Sequence[Around], laws: Comparison) -> str:
    others = [one.standing for one in found if one.question.model != best.model_name]
    rest = "".join(f" {one.law} with its effects reaches {one.unseen:.3g}." for one in others)
    unseen, few = laws.table.set_index("law")["unseen"], of_few_parameters(laws.ranked)
    dense = [law for law in laws.ranked if law not in few]
    if best.model_name in dense:
        rest += (
            " That law has many parameters, among which effects would be lost: only what was found around a law of few "
            "was asked for again."
        )
    elif better := next((law for law in dense if unseen[law] < best.unseen), ""):
        rest += (
            f" {better} alone predicts it to {unseen[better]:.3g}, with more parameters than these records vouch for. "
            f"Where the prediction counts, not what is missing, take `fit --model {better}`."
        )
    return f"{laws.words} With its effects, {best.model_name} predicts what it did not see to {best.unseen:.3g}.{rest}"
