"""The command `control`: feed-forward for a user's trajectory, controllers compared on a rig."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.data.finite import finite
from hysteresis_bench.commands.data.options import reference_options
from hysteresis_bench.commands.outputs import check_folder, check_plot, force_option, plot_option
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import open_option, plain_console, say_notes, say_page, say_path

if TYPE_CHECKING:
    import pandas as pd
    from rich.console import Console

    from hysteresis_bench.control.trajectories.trajectory import Followed
    from hysteresis_bench.data.layout import Layout
    from hysteresis_bench.fit.model_file import FittedModel
    from hysteresis_bench.progress import OnStep

existing_file, above_0 = click.Path(path_type=Path), click.FloatRange(min=0, min_open=True)
FEED_FORWARD, TRACKING, SWEEP, SWEPT = "feed-forward.csv", "tracking.svg", "sweep.csv", "sweep.svg"
FILES = ("control.html", "control.csv", "responses.csv")
AMPLITUDE_HELP = "Of the references; default: 2. Of a --sweep; default: four shares of the fitted range."
RATE_HELP = "Samples a second on the rig, default: 10000; or of a --reference that has no column of time."
OUT_HELP = "Folder, where earlier results of this command are replaced; default: NAME-control."
SWEEP_HELP = "Expected error of a feed-forward along sines of these frequencies and several amplitudes, by the model."

FOR_FIGURE = "--plot draws what --reference or --sweep makes; give one of them, too."
FOR_ONE = "--json tells a --reference, a --sweep or a --rig, and one of them alone."
FOR_LIMIT = "--voltage-limit cuts the input of a --reference; a rig has a limit of its own, and a --sweep has none."
FOR_AMPLITUDE = "--amplitude is of a --sweep or a --rig; a --reference goes as far as it says itself."
FOR_RATE = "--rate is of a --rig, or of a --reference that has no column of time; a --sweep needs none."
FOR_COLUMNS = "--time, --output, --delimiter, --decimal and --sheet say how a --reference is read; give one."


def _frequencies(context: click.Context, option: click.Parameter, text: str | None) -> tuple[float, ...]:
    try:
        found = tuple(float(part) for part in text.split(",")) if text else ()
    except ValueError:
        found = (0.0,)
    if not all(one > 0.0 for one in found):
        raise click.BadParameter(f"{text} should read F,F,... such as 1,10,100: frequencies above 0.")
    return found


@click.command()
@click.argument("model", type=existing_file)
@click.option("--rig", metavar="NAME", help="Compare controllers on this virtual rig; see `list rigs`.")
@click.option("--reference", type=existing_file, help="CSV with time and the wanted output: make the input for it.")
@click.option("--sweep", callback=_frequencies, metavar="F,F,...", help=SWEEP_HELP)
@reference_options
@click.option("--rate", type=above_0, callback=finite, help=RATE_HELP)
@click.option("--amplitude", type=above_0, callback=finite, help=AMPLITUDE_HELP)
@click.option("--voltage-limit", type=above_0, callback=finite, help="Cut the input of --reference here.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help=OUT_HELP)
@plot_option
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@json_option
@open_option
@force_option
def control(
    model: Path,
    rig: str | None,
    reference: Path | None,
    sweep: tuple[float, ...],
    layout: Layout,
    rate: float | None,
    amplitude: float | None,
    voltage_limit: float | None,
    out: Path | None,
    plot: Path | None,
    seed: int,
    as_json: bool,
    open_page: bool,
    force: bool,
) -> None:
    """Use a fitted MODEL.json: the input that follows a trajectory (--reference), the error to expect over amplitude
    and frequency (--sweep), controllers on a rig (--rig)."""
    import numpy as np

    from hysteresis_bench import control as control_on_rig
    from hysteresis_bench.control.trajectories.driven import forward_of
    from hysteresis_bench.control.trajectories.trajectory import follow
    from hysteresis_bench.data.layout import AS_THEY_SAY
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.fit.model_file import read_model
    from hysteresis_bench.progress import Step
    from hysteresis_bench.report.control.page import print_control, write_control
    from hysteresis_bench.report.fit.folder import MODEL

    inputs = [model, *([reference] if reference else [])]
    if not (rig or reference or sweep):
        raise UserError(
            "control",
            "give --rig NAME to compare controllers, --reference CSV for a feed-forward, or --sweep F,F,... for the "
            "error to expect.",
        )
    asked = {
        FOR_FIGURE: (plot is not None, bool(reference) != bool(sweep)),
        FOR_ONE: (as_json, sum(map(bool, (rig, reference, sweep))) == 1),
        FOR_LIMIT: (voltage_limit is not None, reference),
        FOR_AMPLITUDE: (amplitude is not None, rig or sweep),
        FOR_RATE: (rate is not None, rig or reference),
        FOR_COLUMNS: (layout != AS_THEY_SAY, reference),
    }
    faults = [told for told, (given, heeded) in asked.items() if given and not heeded]
    if faults:
        raise UserError("control", faults)
    check_plot(plot, inputs, force)
    fitted = read_model(model)
    folder = out or Path(f"{model.stem}-control")
    check_folder(folder, FILES, FILES[0], inputs, force)
    if reference is not None:
        layout = replace(layout, rate=rate if rig is None else None)
        try:
            with _told(folder) as on_step:
                on_step(Step("the input for the trajectory"))
                followed = follow(fitted, forward_of(fitted), reference, voltage_limit or np.inf, layout=layout)
                on_step(Step("table and figure"))
                drawn = _write_followed(fitted, followed, folder, plot)
            _say_followed(followed, voltage_limit, folder / FEED_FORWARD, drawn, as_json=as_json)
        except ValueError as error:
            raise UserError(str(model), str(error)) from None
    if sweep:
        amplitudes = () if amplitude is None else (amplitude,)
        drawn = folder / SWEPT if plot is None else plot
        _sweep(fitted, model, sweep, amplitudes, folder=folder, drawn=drawn, as_json=as_json)
    if rig is not None:
        with _told(folder) as on_step:
            comparison = control_on_rig(model, rig, rate=rate, amplitude=amplitude, seed=seed, on_step=on_step)
        called = model.resolve().parent.name if model.name == MODEL else model.stem
        page = write_control(folder, comparison, f"{fitted.model} ({called})")
        if as_json:
            scores = comparison.scores.to_dict("records")
            say_json({"scores": scores, "tuning": comparison.tuning, "warnings": comparison.warnings, "page": page})
            return
        console = plain_console()
        print_control(comparison, console)
        say_page(console, page, open_page)


@contextmanager
def _told(folder: Path) -> Iterator[OnStep]:
    """Tells the steps of what runs inside, and where it is stopped that nothing was written."""
    from hysteresis_bench.commands.terminal.steps import steps_told

    kept = f"nothing was written to {folder}"
    with told_when_stopped("control", lambda: kept, "Run it again to begin anew."), steps_told("control") as on_step:
        yield on_step


def _write_followed(fitted: FittedModel, followed: Followed, folder: Path, plot: Path | None) -> Path:
    """Returns the figure."""
    import pandas as pd

    from hysteresis_bench.data.csv_files import write_table

    columns = {"time": followed.time, "input": followed.input, "output": followed.output}
    table = pd.DataFrame({f"{name} [{fitted.units[name]}]": values for name, values in columns.items()})
    table["at_limit"] = followed.cut.astype(int)
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / FEED_FORWARD, table, digits=12)
    drawn = folder / TRACKING if plot is None else plot
    _draw_tracking(fitted, folder, drawn)
    return drawn


def _say_followed(followed: Followed, limit: float | None, table: Path, drawn: Path, *, as_json: bool) -> None:
    import numpy as np

    if as_json:
        said = {
            "samples": followed.time.size,
            "at_limit": followed.cut.sum(),
            "left": followed.left,
            "missed": followed.missed,
        }
        files = {"feed_forward": table, "figure": drawn}
        say_json({**said, "notes": followed.notes, **files})
        return
    console = plain_console()
    say_notes(console, followed.notes)
    if followed.cut.any():
        first = followed.time[int(np.argmax(followed.cut))]
        console.print(
            f"[yellow]note:[/] {int(followed.cut.sum())} of {followed.cut.size} samples need more than the limit of "
            f"{limit:g} and are cut, the first at time {first:g}; they are marked in the column at_limit.",
            highlight=False,
        )
    follows = f"By the model the output follows to {followed.left:.1g} of its range"
    where = (
        f" where nothing is cut, and is off by up to {followed.missed:.2g} of it elsewhere"
        if followed.cut.any()
        else ""
    )
    console.print(f"{follows}{where}.", highlight=False)
    say_path(console, "feed-forward", table)
    say_path(console, "figure", drawn)


def _sweep(
    fitted: FittedModel,
    model: Path,
    frequencies: tuple[float, ...],
    amplitudes: tuple[float, ...],
    *,
    folder: Path,
    drawn: Path,
    as_json: bool,
) -> None:
    from hysteresis_bench.control.trajectories.sweep import sweep
    from hysteresis_bench.data.csv_files import write_table
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.report.shared.papers import draw_sweep

    with _told(folder) as on_step:
        try:
            found = sweep(fitted, frequencies, amplitudes, on_step)
        except ValueError as error:
            raise UserError(str(model), str(error)) from None
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / SWEEP, found)
    draw_sweep(drawn, found, fitted.units)
    if as_json:
        files = {"table": folder / SWEEP, "figure": drawn}
        say_json({"sweep": found.to_dict("records"), "fitted": _fitted_on(fitted), **files})
        return
    console = plain_console()
    _print_sweep(found, fitted, console)
    say_path(console, "table", folder / SWEEP)
    say_path(console, "figure", drawn)


def _fitted_on(fitted: FittedModel) -> str:
    """On which inputs the model was fitted, as far as its file tells; in anything else it guesses."""
    from hysteresis_bench.data.units import frequency_in
    from hysteresis_bench.fit.unseen.excited import AMPLITUDE, FREQUENCY

    known, units = fitted.data.get("excited") or {}, fitted.units
    if AMPLITUDE not in known:
        return "The model file does not keep how fast and how far the fitted inputs went; fit again to have it told."
    (small, large), unit = known[AMPLITUDE], "" if units["input"] == "1" else f" {units['input']}"
    told = f"Fitted on amplitudes of the input of {small:.3g} to {large:.3g}{unit}"
    if FREQUENCY not in known:
        return f"{told}; their time was only an index, so that no frequency was."
    slow, fast = known[FREQUENCY]
    return f"{told} and on {slow:.3g} to {frequency_in(units['time'], fast)}; beyond, the model guesses."


def _print_sweep(found: pd.DataFrame, fitted: FittedModel, console: Console) -> None:
    from rich.markup import escape
    from rich.table import Table

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


def _draw_tracking(fitted: FittedModel, folder: Path, path: Path) -> None:
    """Wanted output, the model's answer to the input that was written, and what is left."""
    from hysteresis_bench.data.data_files import read_data
    from hysteresis_bench.report.shared.papers import draw_tracking

    wanted = read_data([folder / FEED_FORWARD], output_needed=False, units=fitted.units)
    (record,), (answer,) = wanted.records, fitted.predict(wanted).records
    assert record.output is not None
    assert answer.output is not None
    columns = {"time": record.time, "input": record.input, "wanted": record.output, "reached": answer.output}
    draw_tracking(path, columns, fitted.units)
