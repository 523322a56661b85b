"""The command `run`: a study, or a study of diagnosis, run or continued; then its report."""

from __future__ import annotations

import sys
from pathlib import Path

import click
from rich.console import Console

from hysteresis_bench.commands.console import plain_console, say_path
from hysteresis_bench.commands.outputs import check_results, force_option
from hysteresis_bench.errors import UserError

DONE, FAILED_TRIALS = 0, 1


@click.command()
@click.argument("study", type=click.Path(path_type=Path))
@click.option("--trials", type=click.IntRange(min=1), help="Trials of every optimizer; default: the study file's.")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes; default: all cores.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="Results folder; default: runs/NAME.")
@force_option
def run(study: Path, trials: int | None, jobs: int | None, out: Path | None, force: bool) -> None:
    """Run STUDY.toml, or continue it where it stopped; then write and print its report."""
    from hysteresis_bench import run_study
    from hysteresis_bench.commands.progress import progress_bar
    from hysteresis_bench.diagnosis_study.study_file import is_diagnosis_study
    from hysteresis_bench.report.paper.published import check_published_beside
    from hysteresis_bench.report.study import write_report
    from hysteresis_bench.report.study.closing_section import closing_in_words
    from hysteresis_bench.report.study.console import print_summary
    from hysteresis_bench.study.results import FINISHED
    from hysteresis_bench.study.run import default_folder

    console = plain_console()
    check_results(out or default_folder(study), force)
    if is_diagnosis_study(study):
        sys.exit(_run_diagnosis_study(study, trials, jobs, out, console))
    check_published_beside(study)
    try:
        with progress_bar(console) as on_progress:
            results = run_study(study, trials=trials, jobs=jobs, out=out, on_progress=on_progress)
    except KeyboardInterrupt:
        raise UserError(str(study), "stopped. Nothing that finished is lost: run it again to continue.") from None
    page = write_report(results.folder)
    print_summary(results, console)
    failed = results.trials[~results.trials["status"].isin(FINISHED)]
    for row in failed.itertuples():
        console.print(
            f"{row.problem} · {row.optimizer} · trial {row.trial}: {row.status}: {row.reason}", highlight=False
        )
    if results.closing:
        console.print(closing_in_words(results.closing), highlight=False, markup=False)
    say_path(console, "report", page)
    unfinished = len(failed) or (results.closing and not results.closing.finished)
    sys.exit(FAILED_TRIALS if unfinished else DONE)


def _run_diagnosis_study(study: Path, trials: int | None, jobs: int | None, out: Path | None, console: Console) -> int:
    """A study of diagnosis; returns the exit code."""
    from hysteresis_bench.diagnosis_study.results import read_cases
    from hysteresis_bench.diagnosis_study.run import CaseProgress, run_diagnosis_study
    from hysteresis_bench.report.diagnosis_study.page import answer, write_diagnosis_study_page

    def on_progress(progress: CaseProgress) -> None:
        if case := progress.case:
            ended = case.reason or f"hidden {case.hidden or 'nothing'}: claimed {case.claimed or 'nothing'}"
            console.print(f"{progress.done}/{progress.total} {case.bench}, {case.number}: {ended}", highlight=False)

    try:
        results_folder = run_diagnosis_study(study, trials=trials, jobs=jobs, out=out, on_progress=on_progress)
    except KeyboardInterrupt:
        raise UserError(str(study), "stopped. Nothing that finished is lost: run it again to continue.") from None
    for sentence in answer(results_folder):
        console.print(sentence, highlight=False)
    say_path(console, "report", write_diagnosis_study_page(results_folder))
    return FAILED_TRIALS if any(case.status != "done" for case in read_cases(results_folder)) else DONE
