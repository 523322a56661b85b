"""Where a rig knows its parameters: how far from the truth every trial ended.

A search that fits need not have found the truth: along what the output cannot see, anything fits. Two errors
are told, of what the output depends on, and of the parameters one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import pandas as pd

from hysteresis_bench.identifiability import analyse
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.results import FINISHED


def recovery(trials: pd.DataFrame, built: Built) -> dict[str, Any] | None:
    """What is to be recovered, and a row a finished trial; None where the truth is not known.

    trials : of this problem. The truth is hidden["parameters"] of the data, by name, in units.
    """
    names = built.problem.space.names
    known: Mapping[str, float] = built.dataset.hidden.get("parameters", {})
    if not set(names) <= set(known):
        return None
    truth = {name: float(known[name]) for name in names}
    acting = analyse(built.problem, pd.Series(truth).to_numpy()).acting
    rows = []
    for _, trial in trials[trials["status"].isin(FINISHED)].iterrows():
        found = {name: float(trial[f"parameter.{name}"]) for name in names}
        sides = [(combination.value(found), combination.value(truth)) for combination in acting]
        rows.append(
            {
                "optimizer": trial["optimizer"],
                "trial": int(trial["trial"]),
                "relative_rms": float(trial["relative_rms"]),
                "combinations": max(_errors(sides), default=0.0),
                "parameters": max(_errors([(found[name], truth[name]) for name in names])),
            }
        )
    return {"combinations": [str(combination) for combination in acting], "trials": rows}


def _errors(sides: list[tuple[float, float]]) -> Iterator[float]:
    """Relative errors of (found, true), absolute ones where the truth is 0."""
    return (abs(found - true) / (abs(true) or 1.0) for found, true in sides)
