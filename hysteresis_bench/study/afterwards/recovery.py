"""Where a rig knows its parameters: how far from the truth every trial ended.

A search that fits need not have found the truth: along what the output cannot see, anything fits. Two errors
are told, of what the output depends on, and of the parameters one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import pandas as pd

from hysteresis_bench.fit.identifiability.analysis import analyse
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.origin import Trial
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.results import FINISHED

SIX_DIGITS = 1e-6


def recovery(trials: pd.DataFrame, built: Built, traces: Mapping[Trial, Trace] | None = None) -> dict[str, Any] | None:
    """What is to be recovered, and a row a finished trial; None where the truth is not known.

    trials : of the first instance of this problem;  traces : for "evaluations", at which everything that
    acts was first within SIX_DIGITS of the truth for good (None where it never was). The truth is
    hidden["parameters"] of the data, by name, in units.
    """
    names = built.problem.space.names
    known: Mapping[str, float] = built.dataset.hidden.get("parameters", {})
    if not set(names) <= set(known):
        return None
    truth = {name: float(known[name]) for name in names}
    acting = analyse(built.problem, pd.Series(truth).to_numpy()).acting

    def error(found: Mapping[str, float]) -> float:
        sides = [(combination.value(found), combination.value(truth)) for combination in acting]
        return max(_errors(sides), default=0.0)

    def reached(trace: Trace | None) -> int | None:
        """A trace falls, its error need not: the first entry from which on none is outside counts."""
        if trace is None:
            return None
        outside = [error(dict(zip(names, map(float, point), strict=True))) > SIX_DIGITS for point in trace.points]
        first = len(outside) - outside[::-1].index(True) if any(outside) else 0
        return int(trace.evaluations[first]) if first < len(outside) else None

    rows = []
    for _, trial in trials[trials["status"].isin(FINISHED)].iterrows():
        found = {name: float(trial[f"parameter.{name}"]) for name in names}
        rows.append(
            {
                "optimizer": trial["optimizer"],
                "trial": int(trial["trial"]),
                "relative_rms": float(trial["relative_rms"]),
                "combinations": error(found),
                "parameters": max(_errors([(found[name], truth[name]) for name in names])),
                "evaluations": reached(
                    (traces or {}).get((str(trial.get("problem")), trial["optimizer"], FIRST, int(trial["trial"])))
                ),
            }
        )
    return {"combinations": [str(combination) for combination in acting], "trials": rows}


def _errors(sides: list[tuple[float, float]]) -> Iterator[float]:
    """Relative errors of (found, true), absolute ones where the truth is 0."""
    return (abs(found - true) / (abs(true) or 1.0) for found, true in sides)
