"""Quality against time: what an optimizer's own work costs, beside the evaluations that it asks for."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.shared.theme import Picture, legend, picture
from hysteresis_bench.report.trials.problem import Problem

POINTS = 160
"""Of a curve."""
SPAN = 1e3
"""From the longest trial's end back to what is drawn first: the first evaluations say little."""


def against_time(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look]) -> Picture:
    """Median of the best fitness so far over the best known, against the seconds of a trial."""
    shown = [label for label in problem.ranked if label in looks]
    curves = {label: curve(problem, label) for label in shown}

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for label, (seconds, ratios) in curves.items():
            axes.plot(seconds, ratios, color=looks[label].colour, linestyle=looks[label].dash, label=label)
        axes.set(xscale="log", yscale="log", xlabel="Time (s)", ylabel="Best fitness so far / best known")
        end = max((float(seconds[-1]) for seconds, _ in curves.values() if np.isfinite(seconds[-1])), default=1.0)
        axes.set_xlim(end / SPAN, 1.3 * end)
        seen = [ratios[(seconds >= end / SPAN) & np.isfinite(ratios)] for seconds, ratios in curves.values()]
        axes.set_ylim(0.97, 1.1 * max((float(each[0]) for each in seen if each.size), default=2.0))
        legend(axes, 2)

    caption = f"{problem.name}. Best fitness so far over the best known against time, both logarithmic: median over "
    caption += f"{problem.counted}. A trial’s CPU time is spread evenly over its evaluations; it holds the optimizer’s "
    caption += "own work."
    return picture(folder, name, (4.6, 3.4), alt=f"Fitness against time. {caption}", caption=caption, draw=draw)


def curve(problem: Problem, label: str) -> tuple[Array, Array]:
    """Seconds and medians, (POINTS,) each; inf before the first evaluation of most trials."""
    rows = problem.rows[label]
    spent = pd.to_numeric(rows["evaluations"]).to_numpy(dtype=float, na_value=np.nan)
    pace = pd.to_numeric(rows["seconds"]).to_numpy(dtype=float, na_value=np.nan) / spent
    usable = pace[np.isfinite(pace) & (pace > 0.0)]
    if not usable.size:
        return np.full(POINTS, np.nan), np.full(POINTS, np.nan)
    counts = np.geomspace(1.0, float(np.nanmax(spent)), POINTS)
    known = problem.known(label)
    best = problem.best_after(label, counts)
    over = np.divide(best, known[:, None], out=best.copy(), where=(known > 0.0)[:, None] & np.isfinite(known)[:, None])
    medians: Array = np.array([statistics.quantile(problem.per_block(label, column), 0.5) for column in over.T])
    return counts * float(np.median(usable)), np.maximum(medians, 1.0)
