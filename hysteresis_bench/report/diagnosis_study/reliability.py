"""How often claims were right, against the probability that was told with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from hysteresis_bench import registry
from hysteresis_bench.diagnosis_study.case import Case

EDGES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)


@dataclass(frozen=True)
class Bin:
    """Claims whose probability was told between two bounds.

    told : mean of the probabilities;  right : claims whose effect was hidden, or one tied with it, or whose family was
    told with its curve and is a hidden one's
    """

    low: float
    high: float
    claims: int
    told: float
    right: int


def reliability(cases: Sequence[Case]) -> list[Bin]:
    """Over the claims of all finished cases; bins without a claim are left out."""
    claims = [claim for case in cases if case.status == "done" for claim in _claims(case)]
    found = []
    for low, high in pairwise(EDGES):
        inside = [(told, right) for told, right in claims if low <= told < high or told == high == EDGES[-1]]
        if inside:
            told = sum(one for one, _ in inside) / len(inside)
            found.append(Bin(low, high, len(inside), told, sum(right for _, right in inside)))
    return found


def _claims(case: Case) -> list[tuple[float, bool]]:
    """Probability told, and whether it was right, of each claim that has one."""
    names, told, spare = case.claimed.split(), case.sure.split(), case.extra.split()
    hidden = case.family.split()  # told by their families
    families = {registry.effect(name).family for name in hidden}
    all_told = len(hidden) == len(spare)  # then each stands for one, if not of its own family then of a tied one's
    wrong = [name for name in spare if not all_told and registry.effect(name).family not in families]
    pairs = zip(names, told, strict=True) if told else ()
    return [(float(one), name not in wrong) for name, one in pairs if one != "-"]
