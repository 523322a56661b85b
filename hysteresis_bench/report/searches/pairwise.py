"""Everybody against everybody: how often one is better than another, and where a test tells the two apart."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.shared.theme import INK, SERIES, Picture, picture
from hysteresis_bench.report.trials.problem import Problem

MOST_OPTIMIZERS = 14
"""Optimizers in a map, best median first: more cannot be read."""
SHADES = 101
"""Of the colour map."""


def pairwise(folder: Path, name: str, problem: Problem) -> Picture | None:
    """A heat map of A12, bold where a test tells two apart; None where there are too few blocks or optimizers."""
    labels = problem.ranked[:MOST_OPTIMIZERS]
    if problem.blocks < statistics.ENOUGH or len(labels) < 3:
        return None
    shares, apart = matrices(problem, labels)

    def draw(figure: Any) -> None:
        import seaborn
        from matplotlib.colors import ListedColormap, to_rgba

        better, worse = SERIES[:2]
        steps = np.linspace(-1.0, 1.0, SHADES)
        # opacities of two colours of the palette: a dark page has its own
        shades = ListedColormap([to_rgba(better if step > 0 else worse, 0.7 * abs(step)) for step in steps])
        axes = figure.add_subplot()
        options: dict[str, Any] = {"cmap": shades, "vmin": 0.0, "vmax": 1.0, "cbar": False, "annot": True}
        options |= {"fmt": ".2f", "annot_kws": {"color": INK, "fontsize": 7}}
        seaborn.heatmap(shares, ax=axes, xticklabels=labels, yticklabels=labels, **options)
        told = apart[~np.isnan(shares)]
        for text, bold in zip(axes.texts, told, strict=True):
            text.set_fontweight("bold" if bold else "normal")
        axes.grid(visible=False)
        axes.tick_params(length=0)
        axes.set_xticks(axes.get_xticks(), labels, rotation=60, ha="right", rotation_mode="anchor")

    caption = f"{problem.name}. How often the row’s optimizer has a lower fitness than the column’s (A12) over "
    caption += f"{problem.counted}; blue: the row is better. Bold: the signed-rank test tells them apart "
    caption += f"and favours the same one (p < {statistics.LEVEL} after Holm’s correction over all pairs)."
    side = 1.6 + 0.3 * len(labels)
    alt = f"Everybody against everybody on {problem.name}; best median first: {', '.join(labels)}."
    return picture(folder, name, (side + 0.8, side), alt=alt, caption=caption, draw=draw)


def matrices(problem: Problem, labels: Sequence[str]) -> tuple[Array, Array]:
    """A12 of row against column, NaN on the diagonal, and whether the two are told apart; (labels, labels) each.

    Corrected over all pairs of the problem, also of those that are not shown: the shown ones are the best of all.
    """
    samples = [problem.sample(label) for label in labels]
    shares = np.full((len(labels), len(labels)), np.nan)
    apart = np.zeros(shares.shape, dtype=bool)
    for i, j in combinations(range(len(labels)), 2):
        shares[i, j] = statistics.mean_a12(samples[i].instances, samples[j].instances, statistics.TIE)
        shares[j, i] = 1.0 - shares[i, j]
        test = problem.tested[labels[i], labels[j]]
        found = statistics.Comparison(test.p, shares[i, j], favours=test.favours)
        apart[i, j] = apart[j, i] = found.significant and not found.at_odds
    return shares, apart
