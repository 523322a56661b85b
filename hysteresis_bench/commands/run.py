"""The command `run`: a study, or a study of diagnosis, run or continued; then its report."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.outputs import check_results, force_option
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import open_option, plain_console, say_notes, say_page, say_path
from hysteresis_bench.errors import UserError

if TYPE_CHECKING:
    from rich.console import Console

    from hysteresis_bench.study.results import Results

DONE, FAILED_TRIALS = 0, 1


@click.command()
@click.argument("study", type=click.Path(path_type=Path))
@click.option("--trials", type=click.IntRange(min=1), help="Trials of every optimizer; default: the study file's.")
@click.option("--instances", type=click.IntRange(min=1), help="Instances of every rig; default: the study file's.")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes; default: all cores.")
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Results folder, begun or continued; default: runs/NAME.",
)
@click.option("--retry", is_flag=True, help="Do again what was killed from outside, ran out of memory or never began.")
@click.option("--scheduler", metavar="ADDRESS", help="Run the trials on the workers of this Dask scheduler.")
@click.option("--shard", metavar="I/N", help="Run the I-th of N parts only; `merge` puts them together.")
@json_option
@open_option
@force_option
def run(
    study: Path,
    trials: int | None,
    instances: int | None,
    jobs: int | None,
    out: Path | None,
    retry: bool,
    scheduler: str | None,
    shard: str | None,
    as_json: bool,
    open_page: bool,
    force: bool,
) -> None:
    """Run STUDY.toml, or continue it where it stopped; then write and print its report."""
    from hysteresis_bench.commands.terminal.progress import progress_bar
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.report.paper.published import check_published_beside
    from hysteresis_bench.report.study import write_report
    from hysteresis_bench.study.execution.shards import Shard
    from hysteresis_bench.study.results import read_results
    from hysteresis_bench.study.run import Progress, RunOptions, default_folder
    from hysteresis_bench.study_diagnosis import run_with_diagnosis

    console = plain_console(aside=as_json)
    part = Shard.read(shard) if shard else None
    folder = out or default_folder(study, part)
    check_results(folder, force)
    if is_diagnosis_study(study):
        if retry or scheduler or shard or instances:
            none = "is a study of diagnosis: it has no --retry, --scheduler, --shard or --instances."
            raise UserError(str(study), none)
        code, page = _run_diagnosis_study(study, trials, jobs, out, console, as_json)
        say_page(console, page, open_page, "report")
        sys.exit(code)
    check_published_beside(study)
    reached = [Progress(0, 0, None)]

    def kept() -> str:
        return f"{reached[-1].done} of {reached[-1].total} trials are kept in {folder}"

    with told_when_stopped(study, kept), progress_bar(console) as on_progress:

        def keep(progress: Progress) -> None:
            say_notes(console, progress.notes)
            reached[-1] = progress
            on_progress(progress)

        options = RunOptions(retry, scheduler, part, instances)
        run_with_diagnosis(study, trials=trials, jobs=jobs, out=folder, options=options, on_progress=keep)
        page = folder if part else write_report(folder)
    if part:
        say_path(console, f"{kept()}; for `merge`, part {part}", folder)
        if as_json:
            say_json({"trials": reached[-1].done, "of": reached[-1].total, "results": folder})
        return
    code = _report(read_results(folder), page, console, as_json)
    say_page(console, page, open_page, "report")
    sys.exit(code)


def _report(results: Results, page: Path, console: Console, as_json: bool) -> int:
    """Print it; returns the exit code."""
    from hysteresis_bench.commands.report import summary_of
    from hysteresis_bench.report.study.console import print_summary
    from hysteresis_bench.report.study.page import how_it_closed
    from hysteresis_bench.study.execution.pool import MACHINE
    from hysteresis_bench.study.results import FINISHED

    failed = results.trials[~results.trials["status"].isin(FINISHED)]
    several = results.trials["instance"].nunique() > 1
    if as_json:
        columns = ["problem", "optimizer", "instance", "trial", "status", "reason"]
        say_json({"summary": summary_of(results.folder), "failed": failed[columns].to_dict("records"), "report": page})
    else:
        print_summary(results, console)
    for row in failed.itertuples():
        which = f"instance {row.instance} · trial {row.trial}" if several else f"trial {row.trial}"
        told = f"{row.problem} · {row.optimizer} · {which}: {row.status}: {row.reason}"
        console.print(told, highlight=False, markup=False)
    for told in results.mixed:
        console.print(told, highlight=False, markup=False)
    if failed["status"].isin(MACHINE).any():
        console.print("What the machine failed at is done again by `run --retry`.", highlight=False)
    for told in how_it_closed(results):
        console.print(told, highlight=False, markup=False)
    unfinished = len(failed) or (results.closing and not results.closing.finished)
    return FAILED_TRIALS if unfinished else DONE


def _run_diagnosis_study(
    study: Path, trials: int | None, jobs: int | None, out: Path | None, console: Console, as_json: bool
) -> tuple[int, Path]:
    """A study of diagnosis; returns the exit code and the page."""
    from hysteresis_bench.commands.terminal.steps import steps_told
    from hysteresis_bench.diagnosis_study.results import read_cases
    from hysteresis_bench.diagnosis_study.run import CaseProgress, run_diagnosis_study
    from hysteresis_bench.progress import Step
    from hysteresis_bench.report.diagnosis_study.page import answer, write_diagnosis_study_page

    kept = "every case that finished is kept"
    with told_when_stopped(study, lambda: kept), steps_told("run") as on_step:

        def on_progress(progress: CaseProgress) -> None:
            on_step(Step("cases", progress.done, progress.total))
            if case := progress.case:
                ended = case.reason or f"hidden {case.hidden or 'nothing'}: claimed {case.claimed or 'nothing'}"
                console.print(f"{progress.done}/{progress.total} {case.bench}, {case.number}: {ended}", highlight=False)

        results_folder = run_diagnosis_study(study, trials=trials, jobs=jobs, out=out, on_progress=on_progress)
    for sentence in answer(results_folder):
        console.print(sentence, highlight=False)
    page = write_diagnosis_study_page(results_folder)
    if as_json:
        say_json({"answer": answer(results_folder), "report": page})
    return (FAILED_TRIALS if any(case.status != "done" for case in read_cases(results_folder)) else DONE), page
