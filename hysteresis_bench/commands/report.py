"""The command `report`: the page of a results folder, written again."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.terminal.console import plain_console, say_path


@click.command()
@click.argument("results", type=click.Path(path_type=Path, file_okay=False))
@click.option("--open", "open_it", is_flag=True, help="Open the report in a browser.")
def report(results: Path, open_it: bool) -> None:
    """Write the report of a results folder again."""
    from hysteresis_bench.diagnosis_study.results import STUDY
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.report.diagnosis_study.page import write_diagnosis_study_page
    from hysteresis_bench.report.study import write_report

    page = write_diagnosis_study_page(results) if is_diagnosis_study(results / STUDY) else write_report(results)
    say_path(plain_console(), "report", page)
    if open_it:
        click.launch(str(page))
