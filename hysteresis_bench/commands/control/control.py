"""The command `control`: feed-forward for a user's trajectory, controllers compared on a rig."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.data.finite import finite
from hysteresis_bench.commands.data.options import reference_options
from hysteresis_bench.commands.outputs import check_folder, check_plot, force_option, plot_option
from hysteresis_bench.commands.terminal.as_json import json_option
from hysteresis_bench.commands.terminal.console import open_option

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout

existing_file, above_0 = click.Path(path_type=Path), click.FloatRange(min=0, min_open=True)
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
FOR_SEED = "--seed is of a --rig: nothing else of this command is random."
FOR_PAGE = "--open opens the page of a --rig; a --reference and a --sweep make none."
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
@click.option("--seed", type=int, help="Of all random numbers on the rig; default: 0.")
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
    seed: int | None,
    as_json: bool,
    open_page: bool,
    force: bool,
) -> None:
    """Use a fitted MODEL.json: the input that follows a trajectory (--reference), the error to expect over amplitude
    and frequency (--sweep), controllers on a rig (--rig)."""
    from hysteresis_bench.commands.control.use import Use
    from hysteresis_bench.data.layout import AS_THEY_SAY
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.fit.model_file import read_model

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
        FOR_SEED: (seed is not None, rig),
        FOR_PAGE: (open_page, rig),
        FOR_COLUMNS: (layout != AS_THEY_SAY, reference),
    }
    faults = [told for told, (given, heeded) in asked.items() if given and not heeded]
    if faults:
        raise UserError("control", faults)
    check_plot(plot, inputs, force)
    use = Use(read_model(model), model, out or Path(f"{model.stem}-control"), plot, as_json)
    check_folder(use.folder, FILES, FILES[0], inputs, force)
    if reference is not None:
        from hysteresis_bench.commands.control.follow import follow_reference

        follow_reference(use, reference, replace(layout, rate=rate if rig is None else None), voltage_limit)
    if sweep:
        from hysteresis_bench.commands.control.sweep import sweep_sines

        sweep_sines(use, sweep, () if amplitude is None else (amplitude,))
    if rig is not None:
        from hysteresis_bench.commands.control.rig import compare_on_rig

        compare_on_rig(use, rig, rate=rate, amplitude=amplitude, seed=seed or 0, open_page=open_page)
