"""Where the good trials ended: parameters that differ among them are not told by the data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.shared.theme import MUTED, Picture, picture
from hysteresis_bench.report.trials.best_known import NEAR, metric_values
from hysteresis_bench.report.trials.problem import Problem

ENOUGH = 8
"""Trials below which a cloud says nothing."""
MOST_PARAMETERS = 6
"""Parameters of a grid: more panels cannot be read."""
DOTS = 120
"""Trials that are drawn: more lie on top of each other, and a page has to be loaded."""
OTHERS = "others"
PREFIX = "parameter."


def final_parameters(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look]) -> Picture | None:
    """A grid of every two parameters over the trials of the first instance within 1 % of the best known; None where
    there are fewer than ENOUGH, or one parameter, or all of them ended alike."""
    ended = good_trials(problem)
    names = [column for column in ended if column.startswith(PREFIX)][:MOST_PARAMETERS]
    if len(ended) < ENOUGH or len(names) < 2 or _all_alike(ended[names]):
        return None
    count, ended = len(ended), ended.iloc[np.unique(np.linspace(0, len(ended) - 1, DOTS).round().astype(int))]
    who = ended["optimizer"].where(ended["optimizer"].isin(list(looks)), OTHERS)
    palette = {label: looks[label].colour if label in looks else MUTED for label in dict.fromkeys(who)}

    def draw(figure: Any) -> None:
        import seaborn

        count = len(names)
        grid = figure.subplots(count, count, squeeze=False, sharex="col")
        for row, column in np.ndindex(count, count):
            axes, x, y = grid[row, column], names[column], names[row]
            if column > row:
                axes.set_visible(False)
                continue
            shown = {"data": ended, "x": x, "hue": who, "palette": palette, "legend": False, "ax": axes}
            if row == column:
                seaborn.histplot(**shown, bins=12, multiple="stack", linewidth=0, log_scale=_decades(ended[x]))
            else:
                seaborn.scatterplot(**shown, y=y, s=12, alpha=0.6, linewidth=0)
                axes.set_yscale("log" if _decades(ended[y]) else "linear")
                axes.set_ylim(_limits(ended[y]))
            axes.set_xlim(_limits(ended[x]))
            axes.set(xlabel=x.removeprefix(PREFIX) if row == count - 1 else "")
            axes.set(ylabel=y.removeprefix(PREFIX) if column == 0 and row else "")
            axes.tick_params(labelleft=column == 0 and row > 0, which="both")

    caption = f"{problem.name}: parameters of the {count} trials within {100 * (NEAR - 1):g}\u202f% of the best "
    caption += f"known{' on the first instance' if problem.several else ''}, whoever made them, over those of the best "
    caption += "one. A cloud that is wide in a parameter, or a line along two, is what these data do not tell. Colours "
    caption += "as in the other figures."
    caption += f" {DOTS} of them are drawn, evenly from the best to the worst." if count > DOTS else ""
    side = 1.15 * len(names) + 0.6
    return picture(folder, name, (side + 0.4, side), alt=f"Final parameters. {caption}", caption=caption, draw=draw)


def good_trials(problem: Problem) -> pd.DataFrame:
    """The rows of the first instance that came within 1 % of its best known: the optimizer, and the parameters that
    they searched, over those of the best one (as they are where that is 0); the best ones first."""
    first = problem.instances[0]
    rows = pd.concat([rows[rows["instance"] == first] for rows in problem.rows.values()], ignore_index=True)
    fitness = metric_values(rows, "fitness")
    order = np.argsort(fitness, kind="stable")
    good = rows.iloc[order[fitness[order] <= NEAR * problem.best[first]]]
    searched = [column for column in good if column.startswith(PREFIX) and good[column].notna().all()]
    values = good[searched].astype(float).loc[:, lambda each: each.nunique() > 1]
    best = rows.loc[int(np.argmin(fitness)), values.columns].astype(float)
    return good[["optimizer"]].join(values / best.where(best != 0.0, 1.0)).reset_index(drop=True)


def _all_alike(values: pd.DataFrame) -> bool:
    """Whether every parameter is the same within what an axis shows."""
    return bool(((values.min() > 0.99) & (values.max() < 1.01)).all())


def _limits(values: pd.Series) -> tuple[float, float]:
    """Of an axis; differences below 1 % look small."""
    low, high = min(float(values.min()), 0.99), max(float(values.max()), 1.01)
    if _decades(values):
        return low / 1.5, high * 1.5
    margin = 0.06 * (high - low)
    return low - margin, high + margin


def _decades(values: pd.Series) -> bool:
    return bool(values.min() > 0.0 and values.max() > 20.0 * values.min())
