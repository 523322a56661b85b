"""Does a fitted parameter lie at an edge of its box?"""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd


def at_edges(parameters: pd.DataFrame, linear: Sequence[str]) -> list[str]:
    """A sentence a parameter that does. A weight of 0 is no edge: that part of a sum is not there."""
    off = parameters["name"].isin(linear) & (parameters["value"].abs() <= 1e-12 * parameters["value"].abs().max())
    return [
        f"{row.name} lies at the edge of its box ({row.value:.4g}): the optimum may lie outside, and its standard "
        f"error means little."
        for row in parameters[parameters["at_bound"] & ~off].itertuples(index=False)
    ]
