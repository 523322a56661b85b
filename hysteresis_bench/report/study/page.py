"""The report of a study: its sections in their order, gathered from the results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from hysteresis_bench.errors import told
from hysteresis_bench.report.paper import audit, beside, claims, decisions
from hysteresis_bench.report.paper.claims_file import write_claims
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.report.searches import section as searches
from hysteresis_bench.report.searches.figures import all_trials
from hysteresis_bench.report.searches.looks import choose, floors
from hysteresis_bench.report.shared.blocks import Block, Details, Figures, inside
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.theme import Picture
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
from hysteresis_bench.report.trials import instances, seeds, targets
from hysteresis_bench.report.trials.compared import Compared
from hysteresis_bench.report.trials.latex import write_latex
from hysteresis_bench.study.results import Results

Part = Callable[[], Section | None]
FOLDED = {
    "budgets",
    "targets",
    "iterations",
    "searches",
    "signals",
    "held-out",
    "claims",
    seeds.ANCHOR,
    "instances",
    "run",
    "audit",
    "decisions",
    "definitions",
}
"""Anchors of the sections that are folded away."""
FIRST_SCREEN = 2
"""Pictures beside the answer: of the problems with the most optimizers."""
CONTENT = (KeyError, IndexError, ValueError, TypeError, AttributeError)
"""What a table or an object raises that has not the content it was written with."""


def write_tables(results: Results, compared: Compared, folder: Path) -> None:
    """The verdicts on claims as CSV, and the main tables for LaTeX.

    Raises UserError where the published file has faults.
    """
    judged = claims.judge(check_published(results.published), compared.everybody)
    main = [claims.table(judged), *(optimizers.table(problem, compared.summary) for problem in compared.here)]
    write_latex(folder, [table for table in main if table])
    write_claims(folder, judged)


def study_page(results: Results, compared: Compared, folder: Path) -> Page:
    """The whole page; its figures are written to the folder.

    Raises UserError where the published file has faults.
    """
    published = check_published(results.published)
    here, everybody, summary = compared.here, compared.everybody, compared.summary
    judged = claims.judge(published, everybody)
    reference = here[0].reference if here else results.study.reference
    looks = choose(here, reference, published.optimizers, floor=floors(results.study))
    drawn = sorted(searches.drawable(here), key=lambda each: -len(each[1].labels))
    pictures = [all_trials(folder, f"trials-{i}", problem, looks=looks) for i, problem in drawn]

    parts: list[Part] = [
        lambda: beside.section(published, results, everybody),
        lambda: optimizers.at_equal_evaluations(here, summary, reference, pictures[FIRST_SCREEN:]),
        lambda: optimizers.at_other_budgets(compared.others),
        lambda: targets.section(here, results.study.budget),
        lambda: optimizers.at_the_papers_iterations(results, compared, published.iterations),
        lambda: searches.section(results, here, published.optimizers, looks=looks, folder=folder),
        lambda: signals.section(results, here, published.optimizers, looks=looks, folder=folder),
        lambda: held_out.section(results, here, summary, published=published),
        lambda: stages.section(results, published, folder),
        lambda: determined.section(results, folder),
        lambda: closing_section.section(results, folder),
        lambda: claims.section(judged),
        lambda: seeds.section(everybody, folder.name),
        lambda: instances.section(results),
        lambda: run.section(results, here),
        lambda: audit.section(audit.audit(published)),
        lambda: decisions.section(published, results.study.notes),
        lambda: definitions.section(folder, results),
    ]
    sections, damages = whole(parts)
    return Page(
        results.study.title,
        "hysteresis-bench study",
        [_folded(section) if section.anchor in FOLDED else section for section in sections],
        [*words.answer(here, summary, judged), *how_it_closed(results), *_at_a_glance(judged, pictures[:FIRST_SCREEN])],
        warnings=[*results.damages, *damages],
        warned="What is not here",
        contents=True,
        files_kept=not results.kept_small,
    )


def _at_a_glance(judged: Sequence[claims.Judged], pictures: Sequence[Picture]) -> list[Block]:
    """What the first screen shows below the answer: the claims, and every trial."""
    table = claims.table([found for found in judged if not found.claim.ablation])
    return [*([table] if table else []), *([Figures(pictures)] if pictures else [])]


def _folded(section: Section) -> Section:
    """Behind a line that opens it and says what is there: details that a reader asks for."""
    return Section(section.anchor, section.heading, [Details(f"Show {inside(section.blocks)}", section.blocks)])


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
