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
MOST = 6
"""Parameters of a grid: more panels cannot be read."""
OTHERS = "others"
PREFIX = "parameter."


def final_parameters(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look]) -> Picture | None:
    """A grid of every two parameters over the trials of the first instance within 1 % of the best known; None where
    there are fewer than ENOUGH, or one parameter."""
    ended = good_trials(problem)
    names = [column for column in ended if column.startswith(PREFIX)][:MOST]
    if len(ended) < ENOUGH or len(names) < 2:
        return None
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
                axes.tick_params(labelleft=False)
            else:
                seaborn.scatterplot(**shown, y=y, s=12, alpha=0.6, linewidth=0)
                axes.set_yscale("log" if _decades(ended[y]) else "linear")
            axes.set(xlabel=x.removeprefix(PREFIX) if row == count - 1 else "")
            axes.set(ylabel=y.removeprefix(PREFIX) if column == 0 and row else "")
            axes.tick_params(labelleft=column == 0 and row > 0, which="both")

    caption = f"{problem.name}: parameters of the {len(ended)} trials within {100 * (NEAR - 1):g}\u202f% of the best "
    caption += f"known{' on the first instance' if problem.several else ''}, whoever made them. A cloud that is wide "
    caption += "in a parameter, or a line along two, is what these data do not tell. Colours as in the other figures."
    side = 1.15 * len(names) + 0.6
    return picture(folder, name, (side + 0.4, side), alt=f"Final parameters. {caption}", caption=caption, draw=draw)


def good_trials(problem: Problem) -> pd.DataFrame:
    """The rows of the first instance that came within 1 % of its best known, with the parameters that they searched."""
    first = problem.instances[0]
    rows = pd.concat([rows[rows["instance"] == first] for rows in problem.rows.values()], ignore_index=True)
    good = rows[metric_values(rows, "fitness") <= NEAR * problem.best[first]]
    searched = [column for column in good if column.startswith(PREFIX) and good[column].notna().all()]
    values = good[searched].astype(float)
    return good[["optimizer"]].join(values.loc[:, values.nunique() > 1]).reset_index(drop=True)


def _decades(values: pd.Series) -> bool:
    return bool(values.min() > 0.0 and values.max() > 20.0 * values.min())
