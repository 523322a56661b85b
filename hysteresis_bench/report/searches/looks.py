"""Which optimizers have a colour, the same one on every problem and in every figure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from hysteresis_bench import registry
from hysteresis_bench.report.shared.text import listed
from hysteresis_bench.report.shared.theme import MUTED, SERIES
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.study_file import Study

SHOWN = 6
"""Optimizers that get a colour; more lines than this cannot be told apart."""


@dataclass(frozen=True)
class Look:
    """Of an optimizer's lines and points."""

    colour: str
    dash: str = "-"


def floors(study: Study) -> list[str]:
    """Labels of the optimizers that everybody must beat, as they learn nothing from what they evaluate."""
    return [spec.name for spec in study.optimizer if spec.plugin == registry.RANDOM_SEARCH]


def choose(
    problems: Sequence[Problem], reference: str, papers: Sequence[str], *, floor: Sequence[str] = ()
) -> dict[str, Look]:
    """The optimizers that are drawn, with their look.

    The reference, the paper's, and then the best of each problem by median, in turn; the first of `floor` dotted.
    """
    present = {label for problem in problems for label in problem.labels}
    wanted = [label for label in (reference, *papers) if label in present]
    dotted = [label for label in floor if label in present and label not in wanted][:1]
    depth = max((len(problem.ranked) for problem in problems), default=0)
    turns = [problem.ranked[place] for place in range(depth) for problem in problems if place < len(problem.ranked)]
    best = [label for label in dict.fromkeys(turns) if label not in (*wanted, *dotted)]
    wanted = list(dict.fromkeys(wanted))[:SHOWN]
    coloured = wanted + best[: max(0, SHOWN - len(wanted) - len(dotted))]
    looks = {label: Look(colour) for label, colour in zip(coloured, SERIES, strict=False)}
    if reference in looks:
        looks[reference] = Look(looks[reference].colour, "--")
    return looks | {label: Look(MUTED, ":") for label in dotted}


def in_words(looks: Mapping[str, Look], reference: str, papers: Sequence[str], *, floor: Sequence[str]) -> str:
    """Who has a colour, and why."""
    ours = [label for label in papers if label in looks and label != reference]
    dotted = [label for label in floor if label in looks]
    rest = [label for label in looks if label not in (reference, *dotted, *ours)]
    parts = [f"the reference {reference}"] if reference in looks else []
    parts += [f"the paper's {listed(ours)}"] if ours else []
    parts += ["random search, the floor that everybody must beat"] if dotted else []
    parts += (
        [f"the best of each problem by median fitness, in turn, as far as colours reach: {listed(rest)}"]
        if rest
        else []
    )
    return f"In colour: {'; '.join(parts)}. All the others are in the tables and in grey."
