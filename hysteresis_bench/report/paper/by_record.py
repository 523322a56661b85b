"""Error record by record: how a fit made on some records predicts the others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import listed, number, percent

LARGEST = "max_error"


def by_record(problem: str, responses: pd.DataFrame, labels: Sequence[str], *, published: Published) -> Table | None:
    """Errors of the best trials of `labels`, a row a record; None where there is only one record.

    responses : of this problem. A largest error that the paper prints is named beside ours.
    """
    here = responses[responses["optimizer"].isin(labels)]
    if here["record"].nunique() < 2:
        return None
    printed = {result.optimizer: result.value for result in published.result if result.metric == LARGEST}
    rows: list[list[str | Cell]] = []
    for (record, role), of_record in here.groupby(["record", "role"], sort=False):
        for label in labels:
            part = of_record[of_record["optimizer"] == label]
            if part.empty:
                continue
            measured = part["output"].to_numpy(dtype=float)
            error = part["simulated"].to_numpy(dtype=float) - measured
            scale = float(np.max(np.abs(measured))) or 1.0
            rmse, largest = float(np.sqrt(np.mean(error**2))), float(np.max(np.abs(error)))
            limit = printed.get(label)
            tone = "" if limit is None else "good" if largest / scale <= limit else "bad"
            row = [str(record), str(role), label, number(rmse), percent(rmse / scale)]
            rows.append([*row, Cell(percent(largest / scale), tone)])
    note = "Errors are over the largest |output| of the record itself."
    if limits := [f"{label} within {percent(value)}" for label, value in printed.items() if label in labels]:
        note += f" The paper says, on its own actuator: {listed(limits)}; in the colour of good where ours is, too."
    header = ["Record", "Role", "Best trial of", "RMSE", "Relative RMS", "Largest error"]
    return Table(f"{problem}: error record by record", header, rows, note)
