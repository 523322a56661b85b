"""The report of a study: its sections in their order, gathered from the results."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pandas as pd

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


def study_page(results: Results, summary: pd.DataFrame, folder: Path) -> Page:
    """The whole page; its figures are written to the folder. summary : of summarise(results)

    Raises UserError where the published file has faults.
    """
    published = check_published(results.published)
    here, everybody = problems(results), problems(results, any_budget=True)
    judged = claims.judge(published, everybody)
    reference = here[0].reference if here else results.study.reference
    looks = choose(here, reference, published.optimizers, floor=floors(results.study))

    def sections() -> Iterator[Section | None]:
        yield run.section(results, here)
        yield beside.section(published, results, everybody)
        yield claims.section(judged)
        yield optimizers.at_equal_evaluations(here, summary, reference, looks=looks, folder=folder)
        yield optimizers.at_other_budgets(results)
        yield optimizers.at_the_papers_iterations(results, here, published.iterations)
        yield searches.section(results, here, published.optimizers, looks=looks, folder=folder)
        yield signals.section(results, here, published.optimizers, looks=looks, folder=folder)
        yield held_out.section(results, here, summary, published=published)
        yield stages.section(results, published, folder)
        yield determined.section(results, folder)
        yield audit.section(audit.audit(published))
        yield closing_section.section(results, folder)
        yield decisions.section(published, results.study.notes)
        yield definitions.section(folder)

    ends = [closing_section.closing_in_words(results.closing)] if results.closing else []
    return Page(
        results.study.title,
        "hysteresis-bench study",
        [section for section in sections() if section],
        [*words.answer(here, summary, judged), *ends],
        warnings=results.damages,
        warned="What is not here",
        contents=True,
    )
