"""The command line: arguments in, one call, tables and paths out."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.table import Table

from hysteresis_bench import registry
from hysteresis_bench.commands.console import plain_console
from hysteresis_bench.commands.control import control
from hysteresis_bench.commands.diagnose import diagnose
from hysteresis_bench.commands.fit import fit
from hysteresis_bench.errors import UserError, nearest

DONE, FAILED_TRIALS, USER_AT_FAULT = 0, 1, 2
KINDS: tuple[registry.Kind, ...] = ("models", "effects", "optimizers", "rigs")

existing_file = click.Path(path_type=Path)
folder = click.Path(path_type=Path, file_okay=False)


class Group(click.Group):
    """Tells a user's mistake in one message, without a traceback, and exits with 2."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        try:
            return super().main(*args, **kwargs)
        except UserError as error:
            Console(stderr=True, soft_wrap=True).print(f"[bold red]error:[/] {_escaped(str(error))}", highlight=False)
            sys.exit(USER_AT_FAULT)

    def resolve_command(self, context: click.Context, args: list[str]) -> Any:
        if args and self.get_command(context, args[0]) is None:
            raise UserError("hysteresis-bench", f'no command "{args[0]}". {nearest(args[0], self.commands)}')
        return super().resolve_command(context, args)


def _escaped(text: str) -> str:
    from rich.markup import escape

    return escape(text)


@click.group(cls=Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="hysteresis-bench")
def main() -> None:
    """Identify hysteresis models of actuators from measured data, settle which optimizer is worth using,
    and find what the model lacks."""


@main.command()
@click.argument("study", type=existing_file)
@click.option("--trials", type=click.IntRange(min=1), help="Trials of every optimizer; default: the study file's.")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes; default: all cores.")
@click.option("--out", type=folder, help="Results folder; default: results/NAME.")
def run(study: Path, trials: int | None, jobs: int | None, out: Path | None) -> None:
    """Run STUDY.toml, or continue it where it stopped; then write and print its report."""
    from hysteresis_bench import run_study
    from hysteresis_bench.commands.progress import progress_bar
    from hysteresis_bench.diagnosis_study.run import is_diagnosis_study
    from hysteresis_bench.report.paper.published import check_published_beside
    from hysteresis_bench.report.study import write_report
    from hysteresis_bench.report.study.closing_section import closing_in_words
    from hysteresis_bench.report.study.console import print_summary
    from hysteresis_bench.study.results import FINISHED

    console = plain_console()
    if is_diagnosis_study(study):
        sys.exit(_run_diagnosis_study(study, trials, jobs, out, console))
    check_published_beside(study)
    try:
        with progress_bar(console) as tell:
            results = run_study(study, trials=trials, jobs=jobs, out=out, tell=tell)
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
    _say_path(console, "report", page)
    unfinished = len(failed) or (results.closing and not results.closing.finished)
    sys.exit(FAILED_TRIALS if unfinished else DONE)


def _run_diagnosis_study(study: Path, trials: int | None, jobs: int | None, out: Path | None, console: Console) -> int:
    """A study of diagnosis; returns the exit code."""
    from hysteresis_bench.diagnosis_study.run import Told, read_cases, run_diagnosis_study
    from hysteresis_bench.report.diagnosis_study.page import answer, write_diagnosis_study_page

    def tell(step: Told) -> None:
        if step.case:
            said = (
                step.case.reason or f"hidden {step.case.hidden or 'nothing'}: claimed {step.case.claimed or 'nothing'}"
            )
            console.print(f"{step.done}/{step.total} {step.case.bench}, {step.case.number}: {said}", highlight=False)

    try:
        results_folder = run_diagnosis_study(study, trials=trials, jobs=jobs, out=out, tell=tell)
    except KeyboardInterrupt:
        raise UserError(str(study), "stopped. Nothing that finished is lost: run it again to continue.") from None
    for sentence in answer(results_folder):
        console.print(sentence, highlight=False)
    _say_path(console, "report", write_diagnosis_study_page(results_folder))
    return FAILED_TRIALS if any(case.status != "done" for case in read_cases(results_folder)) else DONE


@main.command()
@click.argument("results", type=folder)
@click.option("--open", "open_it", is_flag=True, help="Open the report in a browser.")
def report(results: Path, open_it: bool) -> None:
    """Write the report of a results folder again."""
    from hysteresis_bench.diagnosis_study.run import STUDY, is_diagnosis_study
    from hysteresis_bench.report.diagnosis_study.page import write_diagnosis_study_page
    from hysteresis_bench.report.study import write_report

    told = results / STUDY
    page = write_diagnosis_study_page(results) if told.is_file() and is_diagnosis_study(told) else write_report(results)
    _say_path(plain_console(), "report", page)
    if open_it:
        click.launch(str(page))


@main.command()
@click.argument("model", type=existing_file)
@click.argument("data", type=existing_file, nargs=-1, required=True)
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
def predict(model: Path, data: Sequence[Path], out: Path) -> None:
    """Predict the output of DATA.csv ... with a fitted MODEL.json."""
    from hysteresis_bench import predict as predict_output
    from hysteresis_bench.data_files import write_csv

    write_csv(out, predict_output(model, *data))
    _say_path(plain_console(), "prediction", out)


@main.command()
@click.argument("rig")
@click.argument("experiment")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="The CSV to write.")
@click.option("--seed", type=int, default=0, show_default=True)
def measure(rig: str, experiment: str, out: Path, seed: int) -> None:
    """Take data from a virtual RIG (see `list rigs`)."""
    from hysteresis_bench.data_files import write_csv
    from hysteresis_bench.fit.search import generator

    faults = registry.faults("rigs", rig, {})
    if faults:
        raise UserError("measure", faults)
    bench = registry.build("rigs", rig)
    if experiment not in bench.experiments:
        known = nearest(experiment, bench.experiments)
        raise UserError("measure", f'rig {rig} has no experiment "{experiment}". {known}')
    write_csv(out, bench.measure(experiment, generator(seed, rig, experiment)))
    _say_path(plain_console(), "data", out)


@main.command("list")
@click.argument("what", required=False)
def list_plugins(what: str | None) -> None:
    """List models, effects, optimizers, rigs or studies; all of them without an argument."""
    known = (*KINDS, "studies")
    if what is not None and what not in known:
        raise UserError("list", f'there are no "{what}". {nearest(what, known)}')
    console = plain_console()
    for kind in KINDS:
        if what in (None, kind):
            _list_kind(kind, console)
    if what in (None, "studies"):
        _list_studies(console)


def _list_kind(kind: registry.Kind, console: Console) -> None:
    table = Table(title=kind, title_justify="left", box=None, pad_edge=False, title_style="bold", show_header=False)
    for name in registry.names(kind):
        plugin = registry.load(kind, name)
        summary = plugin.summary
        if kind == "rigs" and plugin.loaded is not None:
            summary += f" Experiments: {', '.join(plugin.loaded.experiments)}."  # type: ignore[attr-defined]
        table.add_row(f"  {name}", _escaped(summary), style="red" if plugin.fault else "")
    if kind == "effects":
        for name, models in registry.offered().items():
            effect = registry.load("models", models[0]).loaded.offers[name]  # type: ignore[union-attr]
            table.add_row(f"  {name}", _escaped(f"{registry.sentence(type(effect))} For {', '.join(models)}."))
    console.print(table)


def _list_studies(console: Console) -> None:
    import tomllib

    table = Table(
        title="studies", title_justify="left", box=None, pad_edge=False, title_style="bold", show_header=False
    )
    for path in sorted(Path("studies").glob("*.toml")):
        if path.name.endswith(".published.toml"):
            continue
        try:
            title = str(tomllib.loads(path.read_text(encoding="utf-8")).get("title", ""))
        except (OSError, tomllib.TOMLDecodeError) as error:
            title = f"broken: {error}"
        table.add_row(f"  {path}", _escaped(title))
    if not table.row_count:
        table.add_row("  none", "there is no folder studies/ here")
    console.print(table)


def _say_path(console: Console, what: str, path: Path) -> None:
    console.print(f"{what}: {path}", highlight=False, soft_wrap=True)


main.add_command(control)
main.add_command(diagnose)
main.add_command(fit)
