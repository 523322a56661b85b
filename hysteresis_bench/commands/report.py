"""The command `report`: the page of a results folder, written again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import open_option, plain_console, say_page, say_path


@click.command()
@click.argument("results", type=click.Path(path_type=Path, file_okay=False))
@click.option(
    "--ioh", type=click.Path(path_type=Path, file_okay=False), help="Also write the searches for IOHprofiler."
)
@click.option("--trial", metavar="SEED", help="Run one trial again, by its seed in trials.csv, and write its page.")
@click.option(
    "--keep",
    type=click.Path(path_type=Path, file_okay=False),
    help="Copy what is small to a folder: a new one, or the same study's.",
)
@json_option
@open_option
def report(
    results: Path, ioh: Path | None, trial: str | None, keep: Path | None, as_json: bool, open_page: bool
) -> None:
    """Write the report of a results folder again, or the index of a folder of such folders."""
    if keep:
        results = _kept(results, keep)
    page = _page(results, trial)
    if ioh:
        from hysteresis_bench.report.trials.ioh import write_ioh
        from hysteresis_bench.study.results import read_results

        write_ioh(read_results(results), ioh)
    if as_json:
        say_json({"summary": summary_of(results), "report": page})
    elif ioh:
        say_path(plain_console(), "searches", ioh)
    say_page(plain_console(aside=as_json), page, open_page, "report")


def _page(results: Path, trial: str | None) -> Path:
    """Of one trial, of an index, of a study of diagnosis or of a study: what the others need is not loaded."""
    if trial is not None:
        from hysteresis_bench.report.trial.page import write_trial_page

        return write_trial_page(results, trial)
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.report.index.page import is_index, write_index
    from hysteresis_bench.study.results import STUDY

    if is_index(results):
        return write_index(results)
    if is_diagnosis_study(results / STUDY):
        from hysteresis_bench.report.diagnosis_study.page import write_diagnosis_study_page

        return write_diagnosis_study_page(results)
    from hysteresis_bench.report.study import write_report

    return write_report(results)


def _kept(results: Path, folder: Path) -> Path:
    """The folder that what is small was copied to."""
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.study.afterwards.keep import check_kept, keep_small
    from hysteresis_bench.study.results import STUDY, read_results

    check_kept(results, folder)
    if is_diagnosis_study(results / STUDY):
        from hysteresis_bench.diagnosis_study.results import keep_tables

        return keep_tables(results, folder)
    from hysteresis_bench.report.paper.published import check_published

    read = read_results(results)
    return keep_small(read, folder, check_published(read.published).optimizers)


def summary_of(results: Path) -> list[dict[str, Any]]:
    """The rows of a study's summary; none where nothing finished, or for a study of diagnosis."""
    from hysteresis_bench.data.csv_files import read_table
    from hysteresis_bench.study.results import SUMMARY

    file = results / SUMMARY
    return read_table(file).to_dict("records") if file.is_file() else []
