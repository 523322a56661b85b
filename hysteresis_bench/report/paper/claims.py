"""Which of the paper's claims hold in our trials, and what our own ablations say of its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import statistics
from hysteresis_bench.report.paper.published import Claim, Published
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, listed, p_equals, probability, share
from hysteresis_bench.report.trials.metrics import TO_SUCCESS, metric_text
from hysteresis_bench.report.trials.problem import Problem

HOLDS, FAILS, EQUIVALENT, UNDECIDED = "holds", "does not hold", "makes no difference", "cannot tell"
VERDICTS = {"better": HOLDS, "worse": FAILS, "equivalent": EQUIVALENT}
CLAIMS, ABLATIONS = "The paper's claims in our trials", "What the parts of the paper's algorithm are worth"
ABSENT = "the course of the searches was not kept"
NOT_STAGED = "no stage was run on every trial"


@dataclass(frozen=True)
class Judged:
    """A claim on one problem. medians : of the one said to be better and of the other;  over : of what it is judged."""

    claim: Claim
    problem: str
    verdict: str
    why: str
    medians: tuple[float, float] | None = None
    found: statistics.Comparison | None = None
    several: bool = False
    over: str = ""

    @property
    def p(self) -> float | None:
        return self.found.p if self.found else None

    @property
    def a12(self) -> float | None:
        return self.found.a12 if self.found else None


def judge(published: Published, problems: list[Problem]) -> list[Judged]:
    """Every claim on every problem; p is Holm-corrected over the claims of a problem.

    A claim on what follows a problem is asked of that one; of the first where nothing followed.
    """
    judged = []
    known = {claim.metric for claim in published.claim if any(problem.has(claim.metric) for problem in problems)}
    for problem in problems:
        labels = set(problem.labels)
        asked = [claim for claim in published.claim if not claim.ablation or {claim.better, claim.worse} <= labels]
        follows = {claim.metric for claim in asked if claim.metric not in known and problem is problems[0]}
        asked = [claim for claim in asked if problem.has(claim.metric) or claim.metric in follows]
        told = [claim for claim in asked if claim.metric not in (follows if problem.traces else follows | {TO_SUCCESS})]
        able = [claim for claim in told if {claim.better, claim.worse} <= labels]
        pairs = [
            (problem.sample(claim.better, claim.metric), problem.sample(claim.worse, claim.metric)) for claim in able
        ]
        for claim, found in zip(able, statistics.compare_pairs(pairs), strict=True):
            judged.append(_judged(claim, problem, found))
        judged += [
            Judged(claim, problem.name, UNDECIDED, f"{claim.better} or {claim.worse} was not run")
            for claim in told
            if claim not in able
        ]
        judged += [
            Judged(claim, problem.name, UNDECIDED, NOT_STAGED if claim.metric in follows else ABSENT)
            for claim in asked
            if claim not in told
        ]
    return judged


def _judged(claim: Claim, problem: Problem, found: statistics.Comparison) -> Judged:
    ours, theirs = (problem.sample(label, claim.metric).blocks for label in (claim.better, claim.worse))
    medians = problem.middle(claim.better, claim.metric), problem.middle(claim.worse, claim.metric)
    verdict, why = VERDICTS.get(found.verdict, UNDECIDED), found.words
    if claim.metric == TO_SUCCESS and found.p is not None and np.mean(np.isinf(ours) & np.isinf(theirs)) > 0.5:
        verdict, why = UNDECIDED, "neither comes to the best known in most of them"
        found = replace(found, practical=None)  # never there is not equally fast
    return Judged(claim, problem.name, verdict, why, medians, found, problem.several, problem.counted)


def tested(judged: Sequence[Judged]) -> list[Judged]:
    """Those with enough blocks for a test; all of them where none has enough."""
    enough = [found for found in judged if found.p is not None]
    return enough or list(judged)


def section(judged: Sequence[Judged]) -> Section | None:
    """How the claims are judged; None without a claim."""
    if not judged:
        return None
    how = (
        "An instance is a block: the rig with other constants, noise and drive, the same for both. A claim holds, or "
        "does not, where a Wilcoxon signed-rank test over the instances’ medians tells the two apart "
        f"(p\u00a0<\u00a0{statistics.LEVEL} after Holm’s correction over the claims of a problem). It makes no "
        "difference where the Bayesian signed-rank test finds both within 1\u202f% of each other with a probability of "
        "0.95; of fitness, the relative RMS is asked. Values equal to rounding (10⁻⁶) are ties. A12 is how often the "
        "one said to be better is better in the same instance; 0.5 is a coin’s toss; its 95\u202f% interval is a "
        "bootstrap over instances. Where a study has one instance, trials that share their first points are the "
        "blocks, and the verdict holds in this instance only."
    )
    ablations = table([found for found in judged if found.claim.ablation], ABLATIONS)
    blocks: list[Block] = [Bullets(sentences(judged)), how, *([ablations] if ablations else [])]
    return Section("claims", "The claims in words, and how they are judged", blocks)


def table(judged: Sequence[Judged], caption: str = CLAIMS) -> Table | None:
    """A row a claim and problem on which it can be judged; without statistics where there are too few blocks."""
    able = [found for found in judged if found.medians]
    if not able:
        return None
    shown = tested(able)
    enough = shown[0].p is not None
    few = dict.fromkeys(f"“{found.problem}” ({found.over})" for found in able if found not in shown)
    rows: list[list[str | Cell]] = []
    for found in shown:
        assert found.medians
        tone = {HOLDS: "good", FAILS: "bad"}.get(found.verdict, "quiet")
        medians = " : ".join(metric_text(found.claim.metric, median) for median in found.medians)
        row: list[str | Cell] = [_said(found.claim), found.problem, Cell(found.verdict, tone, strong=True), medians]
        rows.append([*row, *(_statistics(found) if enough else []), found.over])
    header = ["Claim", "Problem", "Here", "Medians, first : second"]
    header += ["A12 (95 %)", "p", "Equivalent"] if enough else []
    least = f"{statistics.ENOUGH} instances, or trials of one instance, are needed"
    note = "" if enough else f"Too few to test: {least}."
    if few:
        note = f"Not tested, as {least}: {listed(list(few))}."
    return Table(caption, [*header, "Over"], rows, note)


def _statistics(found: Judged) -> list[str | Cell]:
    if found.found is None or found.p is None:
        return [NONE, NONE, NONE]
    practical = found.found.practical
    interval = f"{share(found.a12)} ({share(found.found.low)} to {share(found.found.high)})"
    return [interval, probability(found.p), share(practical.equivalent) if practical else NONE]


def _said(claim: Claim) -> str:
    return f"{claim.says} ({claim.where})"


def in_words(judged: Sequence[Judged]) -> str:
    """One sentence: which of the paper's claims hold, and how far that reaches. Empty without a claim."""
    papers = tested([found for found in judged if not found.claim.ablation and found.medians])
    if not papers:
        return ""
    over = listed(list(dict.fromkeys(found.over for found in papers)))
    if all(found.p is None for found in papers):
        few = f"{statistics.ENOUGH} instances, or trials of one instance, are needed"
        return f"The paper’s claims cannot be judged on {over}: {few}."
    where = f"over {over}" if any(found.several for found in papers) else f"in this instance ({over})"
    claims, problems = (
        len(set(names)) for names in zip(*((each.claim.says, each.problem) for each in papers), strict=True)
    )
    holding = [f"“{found.claim.says}” (on {found.problem})" for found in papers if found.verdict == HOLDS]
    rest = [told for verdict in (EQUIVALENT, FAILS, UNDECIDED) if (told := _rest(papers, verdict))]
    count = f"{len(papers)} judgement{'s' * (len(papers) != 1)}"
    if not holding:
        on = f"any of the {problems} problems" if problems > 1 else f"“{papers[0].problem}”"
        return f"None of the paper’s {claims} claims holds on {on}, {where}: of {count}, {listed(rest)}."
    hold = f"{len(holding)} hold{'s' * (len(holding) == 1)}: {listed(holding, 3)}"
    return (
        f"Of {count} on the paper’s {claims} claims, {where}, {hold}{'; ' * bool(rest)}{listed(rest) if rest else ''}."
    )


def _rest(papers: Sequence[Judged], verdict: str) -> str:
    """How many ended so, as a clause; empty where none did."""
    count = sum(found.verdict == verdict for found in papers)
    one = count == 1
    clause = {
        EQUIVALENT: "makes no difference in practice" if one else "make no difference in practice",
        FAILS: "is contradicted" if one else "are contradicted",
    }.get(verdict, "cannot be told")
    return f"{count} {clause}" if count else ""


def sentences(judged: Sequence[Judged]) -> list[str]:
    """A sentence a claim: where it holds, where not, where nobody can tell."""
    return [_sentence(judged, says) for says in dict.fromkeys(found.claim.says for found in judged)]


def _sentence(judged: Sequence[Judged], says: str) -> str:
    parts = []
    about = tested([found for found in judged if found.claim.says == says])
    for found in about:
        within = "" if found.several or found.p is None else " in this instance"
        numbers = ""
        if found.verdict in (HOLDS, FAILS):
            effect = statistics.magnitude(found.a12 or 0.0)
            numbers = f" ({p_equals(found.p)}, A12 = {share(found.a12)}, {effect} effect)"
        elif found.why:
            numbers = f" ({found.why})"
        verdict = found.why if found.why == statistics.SAME else f"{_here(found.verdict)}{within}{numbers}"
        parts.append(f"on “{found.problem}” {verdict}")
    asked = "We asked whether" if about[0].claim.ablation else "The paper says:"
    return f"{asked} {says}. Here, {listed(parts)}."


def _here(verdict: str) -> str:
    known = {
        HOLDS: "this holds",
        FAILS: "this does not hold; the contrary does",
        EQUIVALENT: "this makes no difference in practice",
    }
    return known.get(verdict, "we cannot tell")
