"""The report of a study: its sections in their order, gathered from the results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd

from hysteresis_bench.errors import told
from hysteresis_bench.report.paper import audit, beside, claims, decisions
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.report.searches import section as searches
from hysteresis_bench.report.searches.looks import choose, floors
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.stages import section as stages
from hysteresis_bench.report.study import (
    closing_section,
    definitions,
    determined,
    held_out,
    optimizers,
    run,
    signals,
    words,
)
from hysteresis_bench.report.trials.summary import problems
from hysteresis_bench.study.results import Results

Part = Callable[[], Section | None]
CONTENT = (KeyError, IndexError, ValueError, TypeError, AttributeError)
"""What a table or an object raises that has not the content it was written with."""


def study_page(results: Results, summary: pd.DataFrame, folder: Path) -> Page:
    """The whole page; its figures are written to the folder. summary : of summarise(results)

    Raises UserError where the published file has faults.
    """
    published = check_published(results.published)
    here, everybody = problems(results), problems(results, any_budget=True)
    judged = claims.judge(published, everybody)
    reference = here[0].reference if here else results.study.reference
    looks = choose(here, reference, published.optimizers, floor=floors(results.study))

    parts: list[Part] = [
        lambda: run.section(results, here),
        lambda: beside.section(published, results, everybody),
        lambda: claims.section(judged),
        lambda: optimizers.at_equal_evaluations(here, summary, reference, looks=looks, folder=folder),
        lambda: optimizers.at_other_budgets(results),
        lambda: optimizers.at_the_papers_iterations(results, here, published.iterations),
        lambda: searches.section(results, here, published.optimizers, looks=looks, folder=folder),
        lambda: signals.section(results, here, published.optimizers, looks=looks, folder=folder),
        lambda: held_out.section(results, here, summary, published=published),
        lambda: stages.section(results, published, folder),
        lambda: determined.section(results, folder),
        lambda: audit.section(audit.audit(published)),
        lambda: closing_section.section(results, folder),
        lambda: decisions.section(published, results.study.notes),
        lambda: definitions.section(folder),
    ]
    sections, damages = whole(parts)
    return Page(
        results.study.title,
        "hysteresis-bench study",
        sections,
        [*words.answer(here, summary, judged), *how_it_closed(results)],
        warnings=[*results.damages, *damages],
        warned="What is not here",
        contents=True,
    )


def whole(parts: Sequence[Part]) -> tuple[list[Section], list[str]]:
    """The sections that can be written, and a sentence on each that cannot: a file may hold what nobody wrote there."""
    sections, damages = [], []
    for part in parts:
        try:
            section = part()
        except CONTENT as error:
            reason = f"what it is made of is damaged ({told(error)}); run the study again to rebuild it"
            damages.append(f"A section is left out: {reason}.")
        else:
            sections += [section] if section else []
    return sections, damages


def how_it_closed(results: Results) -> list[str]:
    """What the diagnosis at the end came to."""
    try:
        return [closing_section.closing_in_words(results.closing)] if results.closing else []
    except CONTENT:  # its section says so
        return []
