"""The section on how the searches went: convergence, runtime distribution, parameters by iteration."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from hysteresis_bench.report.searches.against_time import against_time
from hysteresis_bench.report.searches.figures import convergence, runtime
from hysteresis_bench.report.searches.final_parameters import final_parameters
from hysteresis_bench.report.searches.looks import Look, floors, in_words
from hysteresis_bench.report.searches.pairwise import pairwise
from hysteresis_bench.report.searches.parameters_by_iteration import parameters_by_iteration
from hysteresis_bench.report.shared.blocks import Block, Figures, Heading
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import Results


def section(
    results: Results, problems: Sequence[Problem], papers: Sequence[str], *, looks: Mapping[str, Look], folder: Path
) -> Section | None:
    """papers : the optimizers of the paper, whose parameters are drawn, too;  None where every trial failed, or the
    course of the searches was not kept and the trials alone have nothing to show."""
    drawn = drawable(problems)
    blocks: list[Block] = []
    if drawn and results.traces:
        blocks += _courses(results, drawn, papers, looks=looks, folder=folder)
    against = [pairwise(folder, f"pairwise-{i}", problem) for i, problem in drawn]
    if pictures := [picture for picture in against if picture]:
        blocks += [Heading("Everybody against everybody"), Figures(pictures)]
    ended = [final_parameters(folder, f"ended-{i}", problem, looks=looks) for i, problem in drawn]
    if pictures := [picture for picture in ended if picture]:
        blocks += [Heading("Where the good trials ended"), Figures(pictures)]
    moved = [
        parameters_by_iteration(results, problem.name, label, folder=folder, name=f"parameters-{i}-{j}")
        for i, problem in enumerate(problems, 1)
        for j, label in enumerate(each for each in papers if each != problem.reference)
    ]
    if pictures := [picture for picture in moved if picture]:
        blocks += [Heading("Parameters by iteration"), Figures(pictures, "large")]
    return Section("searches", "How the searches went", blocks) if blocks else None


def _courses(
    results: Results,
    drawn: Sequence[tuple[int, Problem]],
    papers: Sequence[str],
    *,
    looks: Mapping[str, Look],
    folder: Path,
) -> Iterator[Block]:
    """Convergence, runtime distribution, quality against time."""
    budget = results.study.budget
    yield in_words(looks, drawn[0][1].reference, papers, floor=floors(results.study))
    yield Figures([convergence(folder, f"convergence-{i}", each, looks=looks, budget=budget) for i, each in drawn])
    yield Figures([runtime(folder, f"runtime-{i}", each, looks=looks, budget=budget) for i, each in drawn])
    yield Figures([against_time(folder, f"time-{i}", each, looks=looks) for i, each in drawn])


def drawable(problems: Sequence[Problem]) -> list[tuple[int, Problem]]:
    """Problems with a trial that has a result, with their numbers in the names of figures."""
    return [(i, problem) for i, problem in enumerate(problems, 1) if not problem.failed]
