"""The input that follows a trajectory, as a table and a figure."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.commands.control.use import Use
from hysteresis_bench.commands.terminal.as_json import say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_notes, say_path
from hysteresis_bench.control.trajectories.driven import forward_of
from hysteresis_bench.control.trajectories.trajectory import Followed, follow
from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.layout import Layout
from hysteresis_bench.data.trajectory_file import read_trajectory
from hysteresis_bench.errors import UserError
from hysteresis_bench.progress import Step
from hysteresis_bench.report.shared.papers import draw_tracking

TABLE, FIGURE = "feed-forward.csv", "tracking.svg"


def follow_reference(use: Use, reference: Path, layout: Layout, limit: float | None) -> None:
    """Write and tell the input for a wanted output.

    layout : what the reference's file does not say itself;  limit : of the input, to either side
    Raises UserError naming the file, and where no input is found.
    """
    fitted, folder = use.fitted, use.folder
    try:
        with use.told() as on_step:
            on_step(Step("the input for the trajectory"))
            forward, wanted = forward_of(fitted), read_trajectory(reference, fitted.units, layout)
            followed = follow(fitted, forward, wanted, limit=np.inf if limit is None else limit)
            on_step(Step("table and figure"))
            folder.mkdir(parents=True, exist_ok=True)
            _write(use, followed)
            drawn = folder / FIGURE if use.plot is None else use.plot
            _draw(use, drawn)
        _say(use, followed, limit, drawn)
    except ValueError as error:
        raise UserError(str(use.file), str(error)) from None


def _write(use: Use, followed: Followed) -> None:
    columns = {"time": followed.time, "input": followed.input, "output": followed.output}
    table = pd.DataFrame({f"{name} [{use.fitted.units[name]}]": values for name, values in columns.items()})
    table["at_limit"] = followed.cut.astype(int)
    write_table(use.folder / TABLE, table, digits=12)


def _draw(use: Use, path: Path) -> None:
    """Wanted output, the model's answer to the input that was written, and what is left."""
    wanted = read_data([use.folder / TABLE], output_needed=False, units=use.fitted.units)
    (record,), (answer,) = wanted.records, use.fitted.predict(wanted).records
    assert record.output is not None
    assert answer.output is not None
    columns = {"time": record.time, "input": record.input, "wanted": record.output, "reached": answer.output}
    draw_tracking(path, columns, use.fitted.units)


def _say(use: Use, followed: Followed, limit: float | None, drawn: Path) -> None:
    table = use.folder / TABLE
    if use.as_json:
        said = {
            "samples": followed.time.size,
            "at_limit": followed.cut.sum(),
            "left": followed.left,
            "missed": followed.missed,
        }
        say_json({**said, "notes": followed.notes, "feed_forward": table, "figure": drawn})
        return
    console = plain_console()
    say_notes(console, followed.notes)
    follows = f"By the model the output follows to {followed.left:.1g} of its range"
    if followed.cut.any():
        first = followed.time[int(np.argmax(followed.cut))]
        console.print(
            f"[yellow]note:[/] {int(followed.cut.sum())} of {followed.cut.size} samples need more than the limit of "
            f"{limit:g} and are cut, the first at time {first:g}; they are marked in the column at_limit.",
            highlight=False,
        )
        follows += f" where nothing is cut, and is off by up to {followed.missed:.2g} of it elsewhere"
    console.print(f"{follows}.", highlight=False)
    say_path(console, "feed-forward", table)
    say_path(console, "figure", drawn)
