"""One trial of a study: what it found, how the search went, what is left, and the command that repeats it."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.fit.least_squares import at_bound
from hysteresis_bench.report.searches.parameters_by_iteration import moving
from hysteresis_bench.report.shared.blocks import Block, Cell, Figures, Paragraph, Table
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.signal_figures import errors, loop
from hysteresis_bench.report.shared.text import NONE, number, percent, unit_cell, whole
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture
from hysteresis_bench.report.trials.best_known import best_known, metric_values
from hysteresis_bench.study.afterwards.once_more import OnceMore, trial_once_more
from hysteresis_bench.study.results import TRIALS, read_results

TRIAL_PAGES = "trials"
"""The folder of these pages, in that of the results."""


def write_trial_page(folder: Path, seed: str) -> Path:
    """Run a trial of a results folder once more and write its page; returns it. seed : of trials.csv, or its beginning

    Raises UserError where no trial, or more than one, has such a seed, it has no result, or its data are not there.
    """
    results = read_results(folder)
    again = trial_once_more(results, seed)
    kept = again.kept
    rows = results.trials[results.trials["problem"] == kept["problem"]]
    best = best_known(rows)[int(kept["instance"])]
    pages = folder / TRIAL_PAGES
    pages.mkdir(exist_ok=True)
    title = f"{kept['optimizer']} on “{kept['problem']}”: instance {kept['instance']}, trial {kept['trial']}"
    sections = [
        Section("search", "How the search went", list(_search(pages, again, best, results.provenance))),
        Section("parameters", "What it found", [_parameters(again)]),
        Section("signals", "Measured and simulated", list(_signals(pages, again))),
    ]
    answer: list[Block] = [*_answer(again, rows, best), "The command that repeats it:", _command(folder, again)]
    name = f"{kept['seed']}.html"
    return Page(title, f"hysteresis-bench trial of {results.study.title}", sections, answer).write(pages / name)


def _answer(again: OnceMore, rows: pd.DataFrame, best: float) -> Iterator[str]:
    kept = again.kept
    held = "" if pd.isna(kept["held_out_rmse"]) else f", held-out RMSE {number(kept['held_out_rmse'])}"
    yield (
        f"Fitness {number(kept['fitness'], 7)} after {whole(kept['evaluations'])} evaluations: relative RMS "
        f"{percent(kept['relative_rms'], 4)}, largest error {percent(kept['max_error'], 4)}{held}."
    )
    mine = rows[(rows["optimizer"] == kept["optimizer"]) & (rows["instance"] == kept["instance"])]
    place = int(np.sum(metric_values(mine, "fitness") < kept["fitness"])) + 1
    over = f": this is {number(kept['fitness'] / best, 5)} times as much" if best > 0.0 else ""
    yield (
        f"Of the {len(mine)} trials of {kept['optimizer']} on this instance it is number {place}. The best known of "
        f"anybody on it is {number(best, 7)}{over}."
    )
    if again.same:
        yield f"Run once more for this page, it came to the fitness in {TRIALS} again, to the last bit."
    else:
        yield (
            f"Run once more for this page, it came to {number(again.outcome.fitness, 7)} after "
            f"{whole(again.outcome.evaluations)} evaluations, which is not what {TRIALS} has: versions or processors "
            "differ, and a search that depends on the last bit goes another way. The search below is the new one, the "
            "parameters and the errors are the kept ones."
        )


def _command(folder: Path, again: OnceMore) -> Paragraph:
    return Paragraph(f"hysteresis-bench report {shlex.quote(str(folder))} --trial {again.kept['seed']}", "code")


def _search(folder: Path, again: OnceMore, best: float, made: Any) -> Iterator[Block]:
    trace, kept = again.outcome.trace, again.kept
    if trace is None:
        yield "No simulation of the search was finite this time."
        return
    spent = int(again.outcome.evaluations or 0)
    ends = np.append(trace.evaluations, spent)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.step(ends, np.append(trace.losses, trace.losses[-1]), where="post", color=SERIES[0])
        axes.axhline(best, color=MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.set(xscale="log", yscale="log", xlabel="Evaluations", ylabel="Best fitness so far")
        settled = trace.losses[trace.evaluations >= 20]
        top = float(settled[0] if settled.size else trace.losses[0])
        if min(best, top) > 0.0:
            axes.set_ylim(0.95 * min(best, trace.losses[-1]), 1.1 * top)

    caption = f"Best fitness so far against evaluations, both logarithmic; {trace.losses.size} improvements. Dotted: "
    caption += "the best known to the study on the instance."
    name = f"{kept['seed']}-convergence"
    curve = picture(folder, name, (4.6, 3.1), alt=f"Convergence. {caption}", caption=caption, draw=draw)
    space = again.built.problem.space
    units = [parameter.unit_in(again.built.dataset.units) for parameter in space.parameters]
    cost = made.get("optimizers", {}).get(kept["optimizer"], {}).get("evaluations_per_iteration")
    panels = moving(folder, f"{kept['seed']}-parameters", [trace], names=space.names, units=units, end=spent, cost=cost)
    yield Figures([curve])
    yield Figures([panels], "large")


def _parameters(again: OnceMore) -> Table:
    space, units = again.built.problem.space, again.built.dataset.units
    values = again.kept[[f"parameter.{name}" for name in space.names]].to_numpy(dtype=float)
    rows: list[list[str | Cell]] = []
    for parameter, value, edge in zip(space.parameters, values, at_bound(space, values), strict=True):
        box = f"{number(parameter.lower)} to {number(parameter.upper)}"
        stuck = Cell("at a bound", "bad") if edge else Cell(NONE, "quiet")
        unit = unit_cell(parameter.unit_in(units))
        rows.append([parameter.name, number(value, 7), unit, box, parameter.scaling, stuck])
    return Table("Parameters", ["Parameter", "Value", "Unit", "Box", "Scaling", "Bound"], rows)


def _signals(folder: Path, again: OnceMore) -> Iterator[Block]:
    units, who = again.built.dataset.units, str(again.kept["optimizer"])
    loops: list[Picture] = []
    residuals: list[Picture] = []
    for place, ((record, role), rows) in enumerate(again.responses.groupby(["record", "role"], sort=False), 1):
        parts, where = {who: (rows, SERIES[0])}, f"{record} ({role})"
        name = f"{again.kept['seed']}-{place}"
        loops.append(loop(folder, f"{name}-loop", parts, units=units, caption=f"{where}."))
        caption = f"{where}: simulated minus measured."
        residuals.append(errors(folder, f"{name}-errors", parts, units=units, caption=caption))
    yield Figures(loops, "small")
    yield Figures(residuals)
