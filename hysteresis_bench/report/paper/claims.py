"""Which of the paper's claims hold in our trials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hysteresis_bench import stats
from hysteresis_bench.report.paper.published import Claim, Published
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, listed, p_equals, probability, share
from hysteresis_bench.report.trials.metrics import TO_SUCCESS, metric_text
from hysteresis_bench.report.trials.problem import Problem

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
        told = [claim for claim in published.claim if problem.traces or claim.metric != TO_SUCCESS]
        able = [claim for claim in told if {claim.better, claim.worse} <= set(problem.labels)]
        samples = [
            tuple(problem.compared(label, claim.metric) for label in (claim.better, claim.worse)) for claim in able
        ]
        enough = len(problem.trials) >= stats.ENOUGH
        p = stats.holm([stats.wilcoxon(*pair) for pair in samples]) if enough and able else [None] * len(able)
        for claim, (ours, theirs), chance in zip(able, samples, p, strict=True):
            found = stats.Comparison(chance, stats.a12(ours, theirs))
            medians = stats.quantile(ours, 0.5), stats.quantile(theirs, 0.5)
            verdict, why = _verdict(found)
            judged.append(Judged(claim, problem.name, verdict, why, medians, chance, found.a12))
        judged += [
            Judged(claim, problem.name, UNDECIDED, f"{claim.better} or {claim.worse} was not run")
            for claim in told
            if claim not in able
        ]
        judged += [
            Judged(claim, problem.name, UNDECIDED, "the course of the searches was not kept")
            for claim in published.claim
            if claim not in told
        ]
    return judged


def _verdict(found: stats.Comparison) -> tuple[str, str]:
    if found.words in (stats.TOO_FEW, stats.SAME):
        return UNDECIDED, found.words
    return (HOLDS if found.a12 > 0.5 else FAILS), found.words


def section(judged: Sequence[Judged]) -> Section | None:
    """None without a claim."""
    if not judged:
        return None
    how = (
        "A claim holds, or does not, where a Wilcoxon signed-rank test over trials that share their first points tells "
        f"the two apart (p\u00a0<\u00a0{stats.LEVEL} after Holm’s correction over the claims of a problem). A12 is how "
        "often the one said to be better is better; 0.5 is a coin’s toss."
    )
    return Section("claims", "Which of the paper’s claims hold here", [how, _table(judged)])


def _table(judged: Sequence[Judged]) -> Table:
    rows: list[list[str | Cell]] = []
    for found in judged:
        tone = {HOLDS: "good", FAILS: "bad"}.get(found.verdict, "quiet")
        medians = [NONE, NONE] if found.medians is None else [metric_text(found.claim.metric, m) for m in found.medians]
        rows.append(
            [
                found.claim.says,
                found.claim.where,
                found.problem,
                Cell(found.verdict, tone, strong=True),
                Cell(found.why, "quiet"),
                *medians,
                probability(found.p),
                share(found.a12),
            ]
        )
    header = ["The paper says", "Where", "Problem", "Here", "Why", "Median of the better", "Median of the other"]
    return Table("The paper's claims in our trials", [*header, "p", "A12"], rows)


def in_words(judged: Sequence[Judged]) -> list[str]:
    """A sentence a claim: where it holds, where not, where nobody can tell."""
    return [_sentence(judged, says) for says in dict.fromkeys(found.claim.says for found in judged)]


def _sentence(judged: Sequence[Judged], says: str) -> str:
    parts = []
    for found in (found for found in judged if found.claim.says == says):
        numbers = ""
        if found.verdict in (HOLDS, FAILS):
            effect = stats.magnitude(found.a12 or 0.0)
            numbers = f" ({p_equals(found.p)}, A12 = {share(found.a12)}, {effect} effect)"
        elif found.why:
            numbers = f" ({found.why})"
        verdict = found.why if found.why == stats.SAME else f"{_here(found.verdict)}{numbers}"
        parts.append(f"on “{found.problem}” {verdict}")
    return f"The paper says: {says}. Here, {listed(parts)}."


def _here(verdict: str) -> str:
    return {HOLDS: "this holds", FAILS: "this does not hold; the contrary does"}.get(verdict, "we cannot tell")
