"""How the parameters of the best so far moved during a search, trial by trial."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.report.shared.text import whole
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.results import Results

COLUMNS = 3
MOST_TRIALS = 8
"""Trials shown: more lines than this cannot be followed."""


def parameters_by_iteration(results: Results, problem: str, label: str, *, folder: Path, name: str) -> Picture | None:
    """Fitness and parameters of the best so far, a panel each, a line a trial; None where there is no trace."""
    traces = [trace for key, trace in sorted(results.traces.items()) if key[:3] == (problem, label, FIRST)]
    traces = [trace for trace in traces[:MOST_TRIALS] if trace.points.size]
    analysis = results.identifiability.get(problem, {})
    if not traces or "names" not in analysis:
        return None
    spec = next(spec for spec in results.study.optimizer if spec.name == label)
    cost = results.provenance.get("optimizers", {}).get(label, {}).get("evaluations_per_iteration")
    end = results.study.budget_of(spec)
    drawn = moving(folder, name, traces, names=analysis["names"], units=analysis["units"], end=end, cost=cost)
    return replace(drawn, caption=f"{problem}, {label}. {drawn.caption}")


def moving(
    folder: Path,
    name: str,
    traces: Sequence[Trace],
    *,
    names: Sequence[str],
    units: Sequence[str],
    end: int,
    cost: int | None,
) -> Picture:
    """A panel for fitness and for every parameter, a line a trial.

    end : evaluations at which the lines end;  cost : evaluations of an iteration, None where there are none
    """
    panels = ["Fitness", *(f"{each}{_unit(unit)}" for each, unit in zip(names, units, strict=True))]
    height = -(-len(panels) // COLUMNS)

    def draw(figure: Any) -> None:
        axes = figure.subplots(height, COLUMNS, sharex=True, squeeze=False).ravel()
        for index, (panel, title) in enumerate(zip(axes, panels, strict=False)):
            for number, trace in enumerate(traces):
                values = trace.losses if index == 0 else trace.points[:, index - 1]
                when = np.append(trace.evaluations, end) / (cost or 1)
                colour = SERIES[number % len(SERIES)]
                panel.step(when, np.append(values, values[-1]), where="post", color=colour, linewidth=1.0)
            panel.set_title(title, fontweight="normal")
            panel.tick_params(axis="x", labelbottom=index + COLUMNS >= len(panels))
            everything = np.concatenate([line.get_ydata() for line in panel.lines])
            if everything.min() > 0 and everything.max() > 20 * everything.min():
                panel.set_yscale("log")
                panel.tick_params(axis="y", which="minor", labelleft=False)
        for panel in axes[len(panels) :]:
            panel.set_visible(False)
        figure.supxlabel("Iterations" if cost else "Evaluations", fontsize=8.5, color=MUTED)

    iteration = f"; an iteration is {whole(cost)} evaluations" if cost else ""
    several = ", a colour a trial" if len(traces) > 1 else ""
    caption = f"Fitness and parameters of the best so far{several}{iteration}."
    if len(traces) > 1:
        caption += " Where fitness ends alike and a parameter does not, the data do not tell that parameter."
    size = (7.4, 0.5 + 1.45 * height)
    return picture(folder, name, size, alt=f"Search. {caption}", caption=caption, draw=draw)


def _unit(unit: str) -> str:
    return "" if unit in ("1", "") else f" ({unit})"
