"""The command `control`: feed-forward for a user's trajectory, controllers compared on a rig."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench.fit.model_file import FittedModel

existing_file = click.Path(path_type=Path)
FEED_FORWARD = "feed-forward.csv"


@click.command()
@click.argument("model", type=existing_file)
@click.option("--rig", help="Compare controllers on this virtual rig; see `list rigs`.")
@click.option("--reference", type=existing_file, help="CSV with time and the wanted output: make the input for it.")
@click.option("--rate", type=click.FloatRange(min=0, min_open=True), help="Samples a second; default: 10000.")
@click.option("--amplitude", type=click.FloatRange(min=0, min_open=True), help="Of the references; default: 2.")
@click.option("--voltage-limit", type=click.FloatRange(min=0, min_open=True), help="Cut the input of --reference here.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="Folder; default: NAME-control.")
@click.option("--seed", type=int, default=0, show_default=True)
def control(
    model: Path,
    rig: str | None,
    reference: Path | None,
    rate: float | None,
    amplitude: float | None,
    voltage_limit: float | None,
    out: Path | None,
    seed: int,
) -> None:
    """Use a fitted MODEL.json: the input that follows a trajectory (--reference), controllers on a rig (--rig)."""
    from rich.console import Console

    from hysteresis_bench.errors import UserError
    from hysteresis_bench.fit.model_file import read_model

    if rig is None and reference is None:
        raise UserError("control", "give --rig NAME to compare controllers, or --reference CSV for a feed-forward.")
    fitted, console = read_model(model), Console(soft_wrap=False)
    folder = out or Path(f"{model.stem}-control")
    try:
        if reference is not None:
            _write_feed_forward(fitted, reference, voltage_limit, folder, console)
        if rig is not None:
            options = {"rate": rate, "amplitude": amplitude, "seed": seed}
            _compare(fitted, model.stem, rig, {key: value for key, value in options.items() if value}, folder, console)
    except ValueError as error:
        raise UserError(str(model), str(error)) from None


def _write_feed_forward(fitted: FittedModel, path: Path, limit: float | None, folder: Path, console: Console) -> None:
    import numpy as np
    import pandas as pd

    from hysteresis_bench.control.feed_forward import feed_forward
    from hysteresis_bench.control.references import read_trajectory

    forward = feed_forward(fitted)
    time, wanted = read_trajectory(path)
    voltage, cut = forward.input_for(wanted, np.inf if limit is None else limit)
    headings = [f"{name} [{fitted.units[name]}]" for name in ("time", "input", "output")]
    table = pd.DataFrame(dict(zip(headings, (time, voltage, wanted), strict=True)))
    table["at_limit"] = cut.astype(int)
    folder.mkdir(parents=True, exist_ok=True)
    table.to_csv(folder / FEED_FORWARD, index=False, float_format="%.12g")
    if cut.any():
        first = time[int(np.argmax(cut))]
        console.print(
            f"[yellow]note:[/] {int(cut.sum())} of {cut.size} samples need more than the limit of {limit:g} and are "
            f"cut, the first at time {first:g}; they are marked in the column at_limit.",
            highlight=False,
        )
    if forward.linear:
        console.print("The static inverse: the linear section's dynamics are left to feedback.", highlight=False)
    if forward.ignored:
        console.print(f"[yellow]note:[/] not inverted: {', '.join(forward.ignored)}.", highlight=False)
    console.print(f"feed-forward: {folder / FEED_FORWARD}", highlight=False, soft_wrap=True)


def _compare(fitted: FittedModel, name: str, rig: str, options: dict[str, Any], folder: Path, console: Console) -> None:
    from hysteresis_bench import registry
    from hysteresis_bench.contracts import SteppedRig
    from hysteresis_bench.control.comparison import compare
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.report.control.page import print_control, write_control

    faults = registry.faults("rigs", rig, {})
    if faults:
        raise UserError("control", faults)
    bench = registry.build("rigs", rig)
    if not isinstance(bench, SteppedRig):
        loaded = {each: registry.load("rigs", each).loaded for each in registry.names("rigs")}
        able = [each for each, one in loaded.items() if one and issubclass(one, SteppedRig)]
        raise UserError("control", f"rig {rig} cannot be run sample by sample. These can: {', '.join(able) or 'none'}.")
    comparison = compare(fitted, bench, rig, **options)
    page = write_control(folder, comparison, f"{fitted.model} ({name})")
    print_control(comparison, console)
    console.print(f"page: {page}", highlight=False, soft_wrap=True)
