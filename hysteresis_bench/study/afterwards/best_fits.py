"""What a study computes once its trials are in: the best fits' responses, and what the data determine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.accuracy import response_table, simulated
from hysteresis_bench.fit.identifiability.analysis import analyse, profile
from hysteresis_bench.fit.least_squares import polish
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.afterwards.recovery import recovery
from hysteresis_bench.study.origin import Trial
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.results import FINISHED, RESPONSE_COLUMNS
from hysteresis_bench.study.study_file import Study

PROFILE_POINTS = 13
DRIVE = "voltage"
"""A column of records in which the input is measured, too: what the drive was told."""


def responses(trials: pd.DataFrame, built: Mapping[str, Built]) -> pd.DataFrame:
    """What the best trial of every optimizer answers on every record of every problem."""
    parts = []
    for problem, optimizer, values in _best(trials, built, by_optimizer=True):
        system, dataset = built[problem].problem.system, built[problem].dataset
        table = response_table(dataset, {"simulated": simulated(system, dataset.records, values)})
        table = table.assign(problem=problem, optimizer=optimizer)[list(RESPONSE_COLUMNS)]
        if all(DRIVE in record.columns for record in dataset.records):
            table[DRIVE] = np.concatenate([record.columns[DRIVE][record.scored] for record in dataset.records])
        parts.append(table)
    return pd.concat(parts) if parts else pd.DataFrame()


def identifiability(
    study: Study, trials: pd.DataFrame, built: Mapping[str, Built], *, traces: Mapping[Trial, Trace]
) -> dict[str, Any]:
    """Per problem, at the polished best of all trials: rank, standard errors, sentences, profiles.

    An absent number (a parameter that the data cannot tell) is None. Where the truth is known, "recovery" says
    how far from it every trial ended.
    """
    profiled = {spec.name: spec.profile for spec in study.problem}
    found: dict[str, Any] = {}
    for problem, _, best in _best(trials, built, by_optimizer=False):
        of = built[problem].problem
        values = polish(of, best)
        try:
            analysis = analyse(of, values)
        except ValueError as error:
            found[problem] = {"fault": str(error)}
            continue
        found[problem] = {
            "names": list(analysis.names),
            "units": [parameter.unit_in(built[problem].dataset.units) for parameter in of.space.parameters],
            "values": analysis.values.tolist(),
            "standard_errors": _absent(analysis.standard_errors),
            "rank": analysis.rank,
            "determined": analysis.determined,
            "singular_values": analysis.singular_values.tolist(),
            "effective_samples": analysis.effective_samples,
            "sentences": list(analysis.sentences()),
            "profiles": [_profile(of, name, values) for name in profiled[problem]],
        }
    for problem in found:
        if recovered := recovery(trials[trials["problem"] == problem], built[problem], traces):
            found[problem]["recovery"] = recovered
    return found


def _profile(of: Any, name: str, values: Array) -> dict[str, Any]:
    """The likelihood ratio over a fifth of the (scaled) box on either side of the optimum."""
    row = of.space.names.index(name)
    middle = of.space.to_unit(values[:, None])
    points = np.repeat(middle, PROFILE_POINTS, axis=1)
    points[row] = np.clip(np.linspace(middle[row, 0] - 0.2, middle[row, 0] + 0.2, PROFILE_POINTS), 0.0, 1.0)
    grid = np.unique(of.space.from_unit(points)[row])
    found = profile(of, name, grid, values=values)
    return {"name": name, "grid": found.grid.tolist(), "ratio": found.ratio.tolist()}


def best_of(trials: pd.DataFrame, names: Sequence[str]) -> tuple[str, Array]:
    """The optimizer and the parameters, (dimension,) in units, of the trial with the lowest fitness."""
    best = trials.loc[trials["fitness"].idxmin()]
    return best["optimizer"], best[[f"parameter.{name}" for name in names]].to_numpy(dtype=float)


def _best(trials: pd.DataFrame, built: Mapping[str, Built], by_optimizer: bool) -> Iterator[tuple[str, str, Array]]:
    """(problem, optimizer, values) of the trial with the lowest fitness, a problem or an optimizer of it."""
    finished = trials[trials["status"].isin(FINISHED) & trials["problem"].isin(list(built))]
    for key, rows in finished.groupby(["problem", "optimizer"] if by_optimizer else ["problem"], sort=False):
        yield key[0], *best_of(rows, built[key[0]].problem.space.names)


def _absent(numbers: Array) -> list[float | None]:
    return [float(number) if np.isfinite(number) else None for number in numbers]
