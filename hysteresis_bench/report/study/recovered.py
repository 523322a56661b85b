"""Who found a known truth, and who only fits: every optimizer's distance from the parameters behind the data."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import number, percent, whole

RECOVERED = 1e-4
"""Largest relative error of anything that acts on the output, at which the truth counts as found."""
CLOSE = 0.01
"""The same, at which the truth counts as nearly found."""
FITS = 0.01
"""Relative RMS below which an output counts as fitted."""


def recovered(problem: str, recovery: Mapping[str, Any]) -> Table:
    """recovery : the problem's "recovery" in the identifiability file. Closest median first."""
    frame = pd.DataFrame(recovery["trials"])
    rows: list[tuple[float, list[str | Cell]]] = []
    for label, trials in frame.groupby("optimizer", sort=False):
        acting = trials["combinations"].to_numpy()
        found = int(np.sum(acting <= RECOVERED))
        fit = float(trials["relative_rms"].median())
        row: list[str | Cell] = [
            str(label),
            _verdict(found, acting, fit),
            f"{found} of {len(trials)}",
            percent(fit),
            number(acting.min(), 2),
            number(float(np.median(acting)), 2),
            number(float(trials["parameters"].median()), 2),
            whole(trials["evaluations"].astype(float).fillna(np.inf).median()),
        ]
        rows.append((float(np.median(acting)), row))
    note = f"What acts on the output: {', '.join(recovery['combinations'])}. Found: every one of them within "
    note += f"{number(RECOVERED)} of the truth in every trial; nearly: within {percent(CLOSE)} in half of them. Only "
    note += f"fitted: neither, and yet a relative RMS below {percent(FITS)}."
    header = ["Optimizer", "The truth is", "Trials that found it", "Relative RMS, median"]
    header += ["Error of what acts, best", "Error of what acts, median", "Error of the worst single parameter, median"]
    header += ["Evaluations to six digits, median"]
    ordered = [row for _, row in sorted(rows, key=lambda pair: pair[0])]
    return Table(f"{problem}: who finds the known truth (relative errors)", header, ordered, note)


def _verdict(found: int, acting: Array, fit: float) -> Cell:
    if found == acting.size:
        return Cell("found", "good line", strong=True)
    if found:
        return Cell("found at times", "line")
    if np.median(acting) <= CLOSE:
        return Cell("nearly found", "line")
    return Cell("only fitted", "bad line") if fit < FITS else Cell("neither found nor fitted", "quiet line")
