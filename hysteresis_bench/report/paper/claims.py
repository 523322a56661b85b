"""Which of the paper's claims hold in our trials."""

from __future__ import annotations

from dataclasses import dataclass

from hysteresis_bench import stats
from hysteresis_bench.report.paper.published import Claim, Published
from hysteresis_bench.report.study.summary import Problem

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "cannot tell"


@dataclass(frozen=True)
class Judged:
    """A claim on one problem. medians : of the one said to be better and of the other."""

    claim: Claim
    problem: str
    verdict: str
    why: str
    medians: tuple[float, float] | None = None
    p: float | None = None
    a12: float | None = None


def judge(published: Published, problems: list[Problem]) -> list[Judged]:
    """Every claim on every problem; p is Holm-corrected over the claims of a problem."""
    judged = []
    for problem in problems:
        able = [claim for claim in published.claim if {claim.better, claim.worse} <= set(problem.labels)]
        samples = [
            tuple(problem.compared(label, claim.metric) for label in (claim.better, claim.worse)) for claim in able
        ]
        enough = len(problem.trials) >= stats.ENOUGH
        p = stats.holm([stats.wilcoxon(*pair) for pair in samples]) if enough and able else [None] * len(able)
        for claim, (ours, theirs), probability in zip(able, samples, p, strict=True):
            found = stats.Comparison(probability, stats.a12(ours, theirs))
            medians = stats.quantile(ours, 0.5), stats.quantile(theirs, 0.5)
            verdict, why = _verdict(found)
            judged.append(Judged(claim, problem.name, verdict, why, medians, probability, found.a12))
        judged += [
            Judged(claim, problem.name, UNDECIDED, f"{claim.better} or {claim.worse} was not run")
            for claim in published.claim
            if claim not in able
        ]
    return judged


def _verdict(found: stats.Comparison) -> tuple[str, str]:
    if found.words in (stats.TOO_FEW, stats.SAME):
        return UNDECIDED, found.words
    return (HOLDS if found.a12 > 0.5 else FAILS), found.words
