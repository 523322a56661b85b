"""Which of the paper's claims hold in our trials, and what our own ablations say of its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import statistics
from hysteresis_bench.report.paper.published import Claim, Published
from hysteresis_bench.report.shared.blocks import Block, Bullets, Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, listed, p_equals, probability, sentence, share
from hysteresis_bench.report.trials.metrics import TO_SUCCESS, metric_text
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.statistics.comparison import SURE

HOLDS, FAILS, EQUIVALENT, UNDECIDED = "holds", "does not hold", "makes no difference", "cannot tell"
NEVER, NEITHER = "neither arrives", "neither comes to the best known in most of them"
"""What a table shows in the place of UNDECIDED where this is why; the verdict in claims.csv is UNDECIDED."""
VERDICTS = {"better": HOLDS, "worse": FAILS, "equivalent": EQUIVALENT}
NEITHER_OF = "neither of the two comes to the best known"
MANY = {
    HOLDS: ("holds", "hold"),
    FAILS: ("does not hold", "do not hold"),
    EQUIVALENT: ("makes no difference in practice", "make no difference in practice"),
}
"""What one claim does, and what several do."""
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


READING = (
    "A12 is how often the one said to be better is better in the same instance, ties half; its interval is of this "
    "claim alone. p is corrected after Holm over all claims of the problem: an interval without 0.5 may stand beside a "
    f"p above {statistics.LEVEL}. Equivalent is the probability that both are within 1\u202f% of each other; this is "
    f"asked first, and from {SURE} a claim {EQUIVALENT}, whatever p is. {sentence(NEVER)[:-1]}: {NEITHER_OF} "
    f"in most instances, or trials of one, so that nothing can be compared, and Equivalent is {NONE}. "
    f"Where we cannot tell though p is below {statistics.LEVEL}, the signed-rank test favours one and A12 does not."
)
"""How the columns of a table of claims are read."""


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
        verdict, why = UNDECIDED, NEITHER
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
        "0.95; of fitness, the relative RMS is asked. Values equal to rounding (10⁻⁶) are ties. An A12 of 0.5 is a "
        "coin’s toss; its 95\u202f% interval is told under Definitions. Where a study has one instance, trials that "
        "share their first points are the blocks, and the verdict holds in this instance only."
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
        verdict = Cell(in_a_table(found.verdict, found.why), tone, strong=True)
        row: list[str | Cell] = [_said(found.claim), found.problem, verdict, medians]
        rows.append([*row, *(_statistics(found) if enough else []), found.over])
    header = ["Claim", "Problem", "Here", "Medians, first : second"]
    header += ["A12 (95 %)", "p", "Equivalent"] if enough else []
    least = f"{statistics.ENOUGH} instances, or trials of one instance, are needed"
    notes = [f"Not tested, as {least}: {listed(list(few))}."] if few else []
    notes = [*notes, READING] if enough else notes or [f"Too few to test: {least}."]
    return Table(caption, [*header, "Over"], rows, " ".join(notes))


def in_a_table(verdict: str, why: str) -> str:
    """A verdict with its reason, where this is that nobody arrives."""
    return NEVER if (verdict, why) == (UNDECIDED, NEITHER) else verdict


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
    rest = [told for verdict in (EQUIVALENT, UNDECIDED, FAILS) if (told := _rest(papers, verdict))]
    count = f"{len(papers)} judgement{'s' * (len(papers) != 1)}"
    if not holding:
        on = f"any of the {problems} problems" if problems > 1 else f"“{papers[0].problem}”"
        return f"None of the paper’s {claims} claims holds on {on}, {where}: of {count}, {'; '.join(rest)}."
    hold = f"{len(holding)} hold{'s' * (len(holding) == 1)}: {listed(holding, 3)}"
    return f"Of {count} on the paper’s {claims} claims, {where}, {'; '.join([hold, *rest])}."


def _rest(papers: Sequence[Judged], verdict: str) -> str:
    """How many ended so, as a clause, with their names where the contrary was found; empty where none did."""
    ended = [found for found in papers if found.verdict == verdict]
    if not ended:
        return ""
    if verdict == FAILS:
        names = [f"“{found.claim.says}” (on {found.problem})" for found in ended]
        return f"{len(ended)} {how_many(verdict, len(ended))}, as the contrary does: {listed(names, 3)}"
    return f"{len(ended)} {how_many(verdict, len(ended), [found.why for found in ended])}"


def how_many(verdict: str, count: int, why: Sequence[str] = ()) -> str:
    """What so many claims do, after their number.  why : of each, where that is known"""
    if verdict in MANY:
        return MANY[verdict][count > 1]
    never = sum(reason == NEITHER for reason in why)
    whom = "" if never == count else f"in {never} of them "
    return f"cannot be told{f', {whom}because {NEITHER_OF}' * bool(never)}"


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
        verdict = (
            found.why
            if found.why in (statistics.SAME, statistics.AT_ODDS)
            else f"{_here(found.verdict)}{within}{numbers}"
        )
        parts.append(f"on “{found.problem}” {verdict}")
    asked = "We asked whether this holds:" if about[0].claim.ablation else "The paper says:"
    return f"{asked} {says}. Here, {listed(parts)}."


def _here(verdict: str) -> str:
    known = {
        HOLDS: "this holds",
        FAILS: "this does not hold; the contrary does",
        EQUIVALENT: "this makes no difference in practice",
    }
    return known.get(verdict, "we cannot tell")
