"""Figures of a study's searches: convergence, all trials at a glance, runtime distribution."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import statistics
from hysteresis_bench.arrays import Array
from hysteresis_bench.report.searches.looks import Look
from hysteresis_bench.report.shared.theme import INK, MUTED, Picture, picture, spread_labels
from hysteresis_bench.report.trials.best_known import NEAR
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import TRIALS

EXCESSES = np.geomspace(0.01, 10.0, 25)
"""Targets of the runtime distribution: fitness within these shares above the best known."""

DOTS = 500
"""Trials of an optimizer that are drawn one by one: more lie on top of each other, and a page has to be loaded."""


def convergence(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look], budget: int) -> Picture:
    """Best fitness so far against evaluations: median and quartiles over the trials."""
    shown = [label for label in problem.ranked if label in looks]
    counts = np.unique(np.geomspace(1, budget, 240).astype(int))
    trials = max(len(problem.rows[label]) for label in shown)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        ends = {}
        for label in shown:
            best = problem.best_after(label, counts)
            best = np.maximum(best, problem.known(label)[:, None]) / _scale(problem, label)[:, None]
            quartiles = [_finite([statistics.quantile(column, q) for column in best.T]) for q in (0.25, 0.5, 0.75)]
            low, middle, high = quartiles
            look = looks[label]
            axes.plot(counts, middle, color=look.colour, linestyle=look.dash, zorder=3)
            axes.fill_between(counts, low, high, color=look.colour, alpha=0.16, linewidth=0)
            ends[label] = middle
        axes.set(xscale="log", yscale="log", xlim=(1, budget))
        _limit(axes, list(ends.values()), counts)
        _label_ends(axes, {label: values[-1] for label, values in ends.items()}, looks)
        ylabel = "Best fitness so far / best known" if problem.several else "Best fitness so far"
        axes.set(xlabel="Evaluations", ylabel=ylabel)

    ranked = ", ".join(shown)
    alt = f"Best fitness against evaluations on {problem.name}; lowest at the end first: {ranked}."
    caption = f"{problem.name}. Best fitness so far against evaluations, both logarithmic. Line: median over "
    caption += f"{trials} trial{'s' * (trials != 1)}; band: quartiles. Failed trials count as infinitely bad."
    caption += " Fitness is over the best known of the instance." if problem.several else ""
    return picture(folder, name, (4.6, 3.1), alt=alt, caption=caption, draw=draw)


def _scale(problem: Problem, label: str) -> Array:
    """(trials,): what fitness is drawn over, where instances differ in it."""
    known = problem.known(label)
    return np.where((known > 0.0) & np.isfinite(known), known, 1.0) if problem.several else np.ones(known.size)


def _finite(values: Sequence[float]) -> Array:
    found = np.array(values, dtype=float)
    return np.where(np.isfinite(found), found, np.nan)


def _limit(axes: Any, curves: list[Array], counts: Array) -> None:
    """Show from where the searches have begun to work: the first evaluations lie decades above."""
    settled = [value for curve in curves for value in curve[counts >= 20] if np.isfinite(value) and value > 0]
    if settled:
        low, high = min(settled), max(settled)
        margin = max((high / low) ** 0.06, 1.02)
        axes.set_ylim(low / margin, high * margin)


def _label_ends(axes: Any, ends: Mapping[str, float], looks: Mapping[str, Look]) -> None:
    low, high = np.log(axes.get_ylim())
    finite = {label: value for label, value in ends.items() if np.isfinite(value) and value > 0}
    places = [(np.log(value) - low) / (high - low) for value in finite.values()]
    _labels(axes, list(finite), places, looks)


def _labels(axes: Any, labels: Sequence[str], places: Sequence[float], looks: Mapping[str, Look]) -> None:
    """Names at the right end of their curves, moved apart, each with a thin line to its curve."""
    for label, place, height in zip(labels, places, spread_labels(places, 0.065), strict=True):
        colour = looks[label].colour
        axes.plot([1.005, 1.035], [place, height], color=colour, linewidth=0.7, transform=axes.transAxes, clip_on=False)
        axes.text(1.045, height, label, color=colour, va="center", transform=axes.transAxes)


def all_trials(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look]) -> Picture:
    """Every trial of every optimizer: fitness over the best known, one row an optimizer, best median on top."""
    ratios = {label: problem.ratios(label) for label in problem.ranked}
    over = all(known > 0.0 for known in problem.best.values())

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.grid(axis="y", visible=False)
        axes.set_xscale("log")
        finite = np.concatenate([values[np.isfinite(values) & (values > 0)] for values in ratios.values()])
        top = float(np.max(finite, initial=1.0)) * 1.15
        axes.axvline(NEAR, color=MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
        for row, (label, values) in enumerate(ratios.items()):
            colour = looks[label].colour if label in looks else INK
            shown = values[np.isfinite(values)]
            dots = _spread(shown)
            axes.plot(dots, np.full(dots.size, row), "o", color=colour, markersize=2.6, alpha=0.35, markeredgewidth=0)
            quartiles = [min(statistics.quantile(values, q), top) for q in (0.25, 0.75)]
            axes.plot(quartiles, [row, row], color=colour, linewidth=2.2, solid_capstyle="butt", alpha=0.8)
            median = statistics.quantile(values, 0.5)
            if np.isfinite(median):
                axes.plot([median], [row], "|", color=colour, markersize=9, markeredgewidth=1.8)
            failed = values.size - shown.size
            if failed:
                axes.annotate(f"{failed} failed", (1.01, row), xycoords=("axes fraction", "data"), va="center")
        axes.set_yticks(range(len(ratios)), list(ratios))
        for tick, label in zip(axes.get_yticklabels(), ratios, strict=True):
            tick.set_color(looks[label].colour if label in looks else INK)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        axes.set_ylim(len(ratios) - 0.4, -0.6)
        axes.set_xlim(float(np.min(finite, initial=1.0)) / 1.03, top)
        _plain_ticks(axes, top)
        axes.set_xlabel("Fitness / best known" if over else "Fitness")

    alt = f"All trials on {problem.name}. Best median first: {', '.join(ratios)}."
    caption = f"{problem.name}. Final fitness of every trial over the best known to the study on its instance. Dot: "
    caption += "a trial; bar: quartiles; tick: median; dotted: 1 % above the best known, where success begins."
    if any(np.isfinite(values).sum() > DOTS for values in ratios.values()):
        caption += f" Where there are more than {DOTS} trials, as many are drawn, evenly from the best to the worst."
    data = TRIALS if (folder / TRIALS).is_file() else ""
    size = (4.6, 0.9 + 0.185 * len(ratios))
    return replace(picture(folder, name, size, alt=alt, caption=caption, draw=draw), data=data)


def _spread(values: Array) -> Array:
    """DOTS of them at most, evenly from the smallest to the largest."""
    if values.size <= DOTS:
        return values
    even: Array = np.sort(values)[np.linspace(0, values.size - 1, DOTS).round().astype(int)]
    return even


def _plain_ticks(axes: Any, top: float) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    subs = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0) if top < 8 else (1.0, 2.0, 5.0) if top < 200 else (1.0,)
    axes.xaxis.set_major_locator(LogLocator(subs=subs, numticks=12))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def runtime(folder: Path, name: str, problem: Problem, *, looks: Mapping[str, Look], budget: int) -> Picture:
    """Share of targets reached against evaluations (ECDF over trials and targets), all optimizers."""
    counts = np.unique(np.geomspace(1, budget, 200).astype(int))
    curves = {}
    for label in problem.labels:
        hits = problem.reached(label, problem.known(label)[:, None] * (1.0 + EXCESSES))
        curves[label] = statistics.ecdf(hits, counts)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for label, curve in curves.items():
            if label not in looks:
                axes.step(counts, curve, color=MUTED, linewidth=0.7, alpha=0.45, where="post")
        shown = [label for label in looks if label in curves]
        for label in shown:
            look = looks[label]
            axes.step(counts, curves[label], color=look.colour, linestyle=look.dash, where="post", zorder=3)
        _labels(axes, shown, [float(curves[label][-1]) / 1.02 for label in shown], looks)
        axes.set(
            xscale="log", xlim=(1, budget), ylim=(0, 1.02), xlabel="Evaluations", ylabel="Share of targets reached"
        )

    alt = f"Share of targets reached against evaluations on {problem.name}, for all optimizers."
    caption = (
        f"{problem.name}. Runtime distribution: share of (trial, target) pairs reached after so many evaluations; "
    )
    caption += f"{EXCESSES.size} targets from 10 times above the best known fitness down to 1 % above it. Grey: the "
    caption += "optimizers without a colour."
    return picture(folder, name, (4.6, 3.1), alt=alt, caption=caption, draw=draw)
