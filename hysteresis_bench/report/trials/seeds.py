"""Single trials by their seeds: the best, the middle and the worst of every optimizer, to be run again."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.report.shared.blocks import Block, Cell, Paragraph, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import number
from hysteresis_bench.report.trials.problem import Problem

ANCHOR = "single"
PLACES = {"Best": 0.0, "Middle": 0.5, "Worst": 1.0}
"""Of a trial among those of an optimizer, by fitness over the best known of its instance."""


def anchor(problem: Problem, label: str) -> str:
    """Of an optimizer's row, which the table of all optimizers leads to."""
    place = problem.labels.index(label)
    return f"{ANCHOR}-{''.join(each if each.isalnum() else '-' for each in problem.name)}-{place}"


def section(problems: Sequence[Problem], folder: str) -> Section:
    """folder : of the results, as the command is told it"""
    how = (
        "Every trial is repeated by its seed, which trials.csv has of all of them: the command runs it once more, says "
        "whether it came to the same, and writes a page with the parameters found, the course of the search, the loops "
        "and what is left. Here the best, the middle and the worst trial of each, by fitness over the best known of "
        "the instance."
    )
    command = Paragraph(f"hysteresis-bench report {folder} --trial SEED", "code")
    tables: list[Block] = [_table(problem) for problem in problems]
    return Section(ANCHOR, "Single trials, each with its seed", [how, command, *tables])


def _table(problem: Problem) -> Table:
    header = ["Optimizer"]
    for name in PLACES:
        header += [f"{name}: over best known", *(["Instance"] if problem.several else []), "Seed"]
    rows = [_row(problem, label) for label in problem.ranked]
    return Table(f"{problem.name}: single trials", header, rows)


def _row(problem: Problem, label: str) -> list[str | Cell]:
    rows, ratios = problem.rows[label].reset_index(drop=True), problem.ratios(label)
    order = np.argsort(ratios, kind="stable")
    cells: list[str | Cell] = [Cell(label, anchor=anchor(problem, label))]
    for share in PLACES.values():
        place = int(order[round(share * (order.size - 1))])
        trial = rows.loc[place]
        cells.append(number(ratios[place], 4))
        cells += [str(trial["instance"])] if problem.several else []
        cells.append(Cell(str(trial["seed"]), "code"))
    return cells
