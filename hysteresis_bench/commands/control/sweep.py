"""What a feed-forward is expected to leave over amplitude and frequency, as a table and a figure."""

from __future__ import annotations

import pandas as pd
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from hysteresis_bench.commands.control.use import Use
from hysteresis_bench.commands.terminal.as_json import say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_path
from hysteresis_bench.control.trajectories.sweep import sweep
from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.data.units import frequency_in
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.unseen.excited import AMPLITUDE, FREQUENCY
from hysteresis_bench.report.shared.papers import draw_sweep

TABLE, FIGURE = "sweep.csv", "sweep.svg"


def sweep_sines(use: Use, frequencies: tuple[float, ...], amplitudes: tuple[float, ...]) -> None:
    """Write and tell the errors along sines.

    frequencies, amplitudes : in the model's units; four shares of the fitted range for no amplitudes
    Raises UserError where no sine is reached.
    """
    fitted, table = use.fitted, use.folder / TABLE
    with use.told() as on_step:
        try:
            found = sweep(fitted, frequencies, amplitudes, on_step)
        except ValueError as error:
            raise UserError(str(use.file), str(error)) from None
    use.folder.mkdir(parents=True, exist_ok=True)
    write_table(table, found)
    drawn = use.folder / FIGURE if use.plot is None else use.plot
    draw_sweep(drawn, found, fitted.units)
    if use.as_json:
        files = {"table": table, "figure": drawn}
        say_json({"sweep": found.to_dict("records"), "fitted": _fitted_on(fitted), **files})
        return
    console = plain_console()
    _print(found, fitted, console)
    say_path(console, "table", table)
    say_path(console, "figure", drawn)


def _fitted_on(fitted: FittedModel) -> str:
    """On which inputs the model was fitted, as far as its file tells; in anything else it guesses."""
    known, units = fitted.data.get("excited") or {}, fitted.units
    if AMPLITUDE not in known:
        return "The model file does not keep how fast and how far the fitted inputs went; fit again to have it told."
    (small, large), unit = known[AMPLITUDE], "" if units["input"] == "1" else f" {units['input']}"
    told = f"Fitted on amplitudes of the input of {small:.3g} to {large:.3g}{unit}"
    if FREQUENCY not in known:
        return f"{told}; their time was only an index, so that no frequency was."
    slow, fast = known[FREQUENCY]
    return f"{told} and on {slow:.3g} to {frequency_in(units['time'], fast)}; beyond, the model guesses."


def _print(found: pd.DataFrame, fitted: FittedModel, console: Console) -> None:
    units = fitted.units
    spelled = {name: "" if unit == "1" else f" [{unit}]" for name, unit in units.items()}
    table = Table(title="feed-forward along sines, by the model", title_justify="left", box=None, pad_edge=False)
    headings = (f"amplitude{spelled['output']}", f"frequency [1/{units['time']}]", f"input{spelled['input']}")
    for heading in (*headings, "RMSE left", "RMSE expected", "share"):
        table.add_column(escape(heading), justify="right")
    table.add_column("unlike the fit")
    for row in found.dropna(subset="left").itertuples():
        numbers = (row.amplitude, row.frequency, row.input, row.left, row.expected)
        shown = [f"{number:.3g}" for number in numbers]
        share = f"{row.expected / row.amplitude:.1%}"
        table.add_row(*shown, share, row.beyond, style="yellow" if row.beyond else "")
    console.print(table)
    console.print(_fitted_on(fitted), highlight=False, markup=False)
    for reason, rows in found[found["left"].isna()].groupby("reason", sort=False):
        places = ", ".join(f"{row.amplitude:.3g} at {row.frequency:.3g}" for row in rows.itertuples())
        console.print(f"{places}: {reason}", highlight=False, markup=False)
