"""How often claims were right, against the probability that was told with them.

In bins of equally many claims [1]: most claims are told with much the same probability, and bins of equal width would
have one of them full and the others empty. Ours: claims told alike share a bin, as cutting through them would show the
same probability several times; the bins are then fewer, and not of one size.

[1] K. Nguyen, B. O'Connor, Posterior calibration and exploratory analysis for natural language processing models,
EMNLP (2015) 1587.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter

from hysteresis_bench import registry
from hysteresis_bench.diagnosis_study.case import Case

BINS, LEAST = 5, 10
"""So many bins at most, of so many claims at least, where there are as many: of fewer an interval says little."""


@dataclass(frozen=True)
class Bin:
    """Claims whose probability was told between two bounds, both included.

    told : mean of the probabilities;  right : claims whose effect was hidden, or one tied with it, or whose family was
    told with its curve and is a hidden one's
    """

    low: float
    high: float
    claims: int
    told: float
    right: int


def reliability(cases: Sequence[Case]) -> list[Bin]:
    """Over the claims of all finished cases, from the least probable to the most; none without claims."""
    claims = [claim for case in cases if case.status == "done" for claim in _claims(case)]
    claims.sort(key=itemgetter(0))
    bins = [claims[first:end] for first, end in pairwise(_cuts([told for told, _ in claims]))]
    return [
        Bin(one[0][0], one[-1][0], len(one), sum(told for told, _ in one) / len(one), sum(right for _, right in one))
        for one in bins
    ]


def _cuts(told: Sequence[float]) -> list[int]:
    """Where the bins of these rising probabilities begin and end: between unequal ones only, next to where bins of
    equally many claims would, and at least LEAST claims apart."""
    if not told:
        return []
    count = min(BINS, max(1, len(told) // LEAST))
    unequal = [place for place in range(1, len(told)) if told[place - 1] < told[place]]
    cuts = [0]
    for aim in (len(told) * k // count for k in range(1, count) if unequal):
        _, nearest = min((abs(place - aim), place) for place in unequal)
        if nearest - cuts[-1] >= LEAST and len(told) - nearest >= LEAST:
            cuts.append(nearest)
    return [*cuts, len(told)]


def _claims(case: Case) -> list[tuple[float, bool]]:
    """Probability told, and whether it was right, of each claim that has one."""
    names, told, spare = case.claimed.split(), case.sure.split(), case.extra.split()
    hidden = case.family.split()  # told by their families
    families = {registry.effect(name).family for name in hidden}
    all_told = len(hidden) == len(spare)  # then each stands for one, if not of its own family then of a tied one's
    wrong = [name for name in spare if not all_told and registry.effect(name).family not in families]
    pairs = zip(names, told, strict=True) if told else ()
    return [(float(one), name not in wrong) for name, one in pairs if one != "-"]
