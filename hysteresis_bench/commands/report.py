"""The command `report`: the page of a results folder, written again."""

from __future__ import annotations

from pathlib import Path

import click

from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_path


@click.command()
@click.argument("results", type=click.Path(path_type=Path, file_okay=False))
@click.option("--open", "open_it", is_flag=True, help="Open the report in a browser.")
@json_option
def report(results: Path, open_it: bool, as_json: bool) -> None:
    """Write the report of a results folder again."""
    from hysteresis_bench.data.csv_files import read_table
    from hysteresis_bench.diagnosis_study.results import STUDY
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.report.diagnosis_study.page import write_diagnosis_study_page
    from hysteresis_bench.report.study import write_report

    page = write_diagnosis_study_page(results) if is_diagnosis_study(results / STUDY) else write_report(results)
    if as_json:
        summary = results / "summary.csv"
        table = read_table(summary).to_dict("records") if summary.is_file() else []
        say_json({"summary": table, "report": page})
    else:
        say_path(plain_console(), "report", page)
    if open_it:
        click.launch(str(page))
