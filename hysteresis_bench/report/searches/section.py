"""The section on how the searches went: convergence, runtime distribution, parameters by iteration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
    course of the searches was not kept."""
    drawn = drawable(problems)
    if not drawn or not results.traces:
        return None
    budget, reference = results.study.budget, problems[0].reference
    blocks: list[Block] = [
        in_words(looks, reference, papers, floor=floors(results.study)),
        Figures([convergence(folder, f"convergence-{i}", problem, looks=looks, budget=budget) for i, problem in drawn]),
        Figures([runtime(folder, f"runtime-{i}", problem, looks=looks, budget=budget) for i, problem in drawn]),
        Figures([against_time(folder, f"time-{i}", problem, looks=looks) for i, problem in drawn]),
    ]
    moved = [
        parameters_by_iteration(results, problem.name, label, folder=folder, name=f"parameters-{i}-{j}")
        for i, problem in enumerate(problems, 1)
        for j, label in enumerate(each for each in papers if each != problem.reference)
    ]
    against = [pairwise(folder, f"pairwise-{i}", problem) for i, problem in drawn]
    if pictures := [picture for picture in against if picture]:
        blocks += [Heading("Everybody against everybody"), Figures(pictures)]
    ended = [final_parameters(folder, f"ended-{i}", problem, looks=looks) for i, problem in drawn]
    if pictures := [picture for picture in ended if picture]:
        blocks += [Heading("Where the good trials ended"), Figures(pictures)]
    if pictures := [picture for picture in moved if picture]:
        blocks += [Heading("Parameters by iteration"), Figures(pictures, "large")]
    return Section("searches", "How the searches went", blocks)


def drawable(problems: Sequence[Problem]) -> list[tuple[int, Problem]]:
    """Problems with a trial that has a result, with their numbers in the names of figures."""
    return [(i, problem) for i, problem in enumerate(problems, 1) if not problem.failed]
