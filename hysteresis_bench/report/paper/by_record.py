"""Error record by record: how a fit made on some records predicts the others."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.shared.page import Cell, Table, listed, number, percent
from hysteresis_bench.report.shared.signal_figures import Units, named
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, picture

LARGEST = "max_error"


def by_record(problem: str, responses: pd.DataFrame, labels: Sequence[str], published: Published) -> Table | None:
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
    if told := [f"{label} within {percent(value)}" for label, value in printed.items() if label in labels]:
        note += f" The paper says, on its own actuator: {listed(told)}; in the colour of good where ours is, too."
    header = ["Record", "Role", "Best trial of", "RMSE", "Relative RMS", "Largest error"]
    return Table(f"{problem}: error record by record", header, rows, note)


def measured_loops(
    folder: Path, name: str, responses: pd.DataFrame, units: Units, problem: str, most: int = len(SERIES)
) -> Picture | None:
    """The measured loops of all records in one figure; None where there is only one record, or too many.

    responses : of one problem
    """
    one = responses[responses["optimizer"] == responses["optimizer"].iloc[0]]
    records = list(one.groupby(["record", "role"], sort=False))
    if not 1 < len(records) <= most:
        return None

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for ((record, _), part), colour in zip(records, SERIES, strict=False):
            axes.plot(part["input"], part["output"], color=colour, linewidth=1.0, label=record)
        axes.axhline(0, color=MUTED, linewidth=0.5)
        axes.set(xlabel=named("Input", units, "input"), ylabel=named("Output", units, "output"))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=2, borderaxespad=0, handlelength=1.4)

    caption = f"{problem}: measured, all records."
    return picture(folder, name, (3.4, 3.6), f"Measured hysteresis loops of all records. {caption}", caption, draw)
