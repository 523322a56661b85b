"""Controllers compared on a virtual rig, as a page."""

from __future__ import annotations

from hysteresis_bench import control as control_on_rig
from hysteresis_bench.commands.control.use import Use
from hysteresis_bench.commands.terminal.as_json import say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_page
from hysteresis_bench.report.control.page import print_control, write_control
from hysteresis_bench.report.fit.folder import MODEL


def compare_on_rig(
    use: Use, rig: str, *, rate: float | None, amplitude: float | None, seed: int, open_page: bool
) -> None:
    """Write and tell the comparison.  rate, amplitude, seed : as of `hysteresis_bench.control`, which raises"""
    with use.told() as on_step:
        comparison = control_on_rig(use.file, rig, rate=rate, amplitude=amplitude, seed=seed, on_step=on_step)
    called = use.file.resolve().parent.name if use.file.name == MODEL else use.file.stem
    page = write_control(use.folder, comparison, f"{use.fitted.model} ({called})")
    if use.as_json:
        scores = comparison.scores.to_dict("records")
        say_json({"scores": scores, "tuning": comparison.tuning, "warnings": comparison.warnings, "page": page})
        return
    console = plain_console()
    print_control(comparison, console)
    say_page(console, page, open_page)
