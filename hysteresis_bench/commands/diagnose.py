"""The command `diagnose`: what the model lacks, in the terminal and as files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hysteresis_bench.commands.data.loading import loaded, model_faults
from hysteresis_bench.commands.data.options import data_options, models_option, preparation_options, say_understood
from hysteresis_bench.commands.data.parameters import model_options
from hysteresis_bench.commands.outputs import check_folder, check_plot, force_option, plot_option
from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.as_json import json_option
from hysteresis_bench.commands.terminal.console import (
    open_option,
    plain_console,
    say_notes,
    say_page,
    say_path,
)

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from hysteresis_bench.data.layout import Layout
    from hysteresis_bench.diagnosis.findings.result import Diagnosis
    from hysteresis_bench.diagnosis_study.advised import Bench
    from hysteresis_bench.signals import Dataset

OUT_HELP = "Folder, where earlier results of this command are replaced; default: NAME-diagnosis."
SHOWN = 8
"""Tests and sentences of a kind that still fit a terminal; the files have all."""


@click.command()
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@click.option("--model", default="", help="A registered model; default: the law is found from the data.")
@models_option("Where the law is sought.")
@click.option("--held-out", multiple=True, metavar="RECORD", help="A record that is only predicted.")
@click.option("--effect", "effects", multiple=True, help="An effect known to act; may be repeated.")
@model_options
@preparation_options
@click.option("--measure", metavar="RIG", help="Carry the advised experiment out on this virtual rig, diagnose again.")
@click.option("--accept-terms", is_flag=True, help="Add what describes the remaining residual to the model.")
@click.option("--jobs", type=click.IntRange(min=1), help="Processes; default: all cores, at most 4.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help=OUT_HELP)
@click.option("--seed", type=int, default=0, show_default=True, help="Of all random numbers.")
@plot_option
@json_option
@open_option
@force_option
def diagnose(
    data: Sequence[Path],
    layout: Layout,
    model: str,
    models: Sequence[str],
    held_out: Sequence[str],
    effects: Sequence[str],
    asked: dict[str, Any],
    prepared: dict[str, Any],
    measure: str | None,
    accept_terms: bool,
    jobs: int | None,
    out: Path | None,
    seed: int,
    plot: Path | None,
    as_json: bool,
    open_page: bool,
    force: bool,
) -> None:
    """Find what the model lacks in DATA ...: the missing effect, the error before and after.

    With --measure RIG the experiment that would tell tied effects apart is carried out on a virtual rig, and its record
    is fitted with the others. A run that was stopped goes on where it was when it is called again.
    """
    from dataclasses import replace
    from functools import partial

    from hysteresis_bench import diagnose as find
    from hysteresis_bench.commands.data.journal import journal
    from hysteresis_bench.commands.terminal.steps import steps_told
    from hysteresis_bench.diagnosis.findings.diagnosis_file import DIAGNOSIS, MODEL, RESPONSES, write_diagnosis
    from hysteresis_bench.diagnosis.laws.comparison import law_faults
    from hysteresis_bench.diagnosis.question import DiagnosisOptions
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.report.diagnosis.for_papers import draw_diagnosis
    from hysteresis_bench.report.diagnosis.page import FILE, write_diagnosis_page

    if model and models:
        raise UserError("diagnose", "--models is where the law is sought, and --model names it; give one of them.")
    folder = out or Path(f"{data[0].stem}-diagnosis")
    check_folder(folder, (DIAGNOSIS, MODEL, RESPONSES, FILE), FILE, data, force)
    check_plot(plot, data, force)
    bench = _bench(measure, seed, prepared) if measure else None
    others = partial(model_faults, model, effects, asked) if model else partial(law_faults, models, effects)
    dataset, console = loaded("diagnose", data, held_out, layout, others=others), plain_console()
    if not as_json:
        say_understood(console, dataset)
        say_notes(console, dataset.notes)
    if bench:
        bench.check(dataset)
        check_folder(folder, (f"{bench.record_name(dataset)}.csv",), FILE, data, force)
    options = DiagnosisOptions(seed, None, **prepared, accept_terms=accept_terms, laws=models)
    with journal(folder, (dataset.records, held_out, model, effects, asked, options)) as kept:
        say_notes(plain_console(aside=True), kept.notes)
        with told_when_stopped("diagnose", kept.words), steps_told("diagnose") as on_step:
            options = replace(options, jobs=jobs, on_step=on_step, kept=kept)
            found = find(dataset, model, effects, **asked, options=options)
            if bench:
                more = partial(find, model=model, effects=effects, **asked, options=options)
                found = _measured(dataset, found, bench, more)
        path = write_diagnosis(folder, found, [*data, *_written(folder, found)])
        page = write_diagnosis_page(path.parent)
    if plot is not None:
        draw_diagnosis(plot, folder)
    if as_json:
        click.echo(path.read_text(encoding="utf-8"), nl=False)
        return
    print_diagnosis(found, console)
    say_path(console, "diagnosis", path)
    if plot is not None:
        say_path(console, "figure", plot)
    say_page(console, page, open_page)


def _bench(name: str, seed: int, prepared: dict[str, Any]) -> Bench:
    """Raises UserError for what is no rig that plays drives, and for records that do not begin at rest, as rigs do."""
    from hysteresis_bench import registry
    from hysteresis_bench.diagnosis_study.advised import Bench, driven_rig
    from hysteresis_bench.errors import UserError

    faults = registry.faults("rigs", name, {})
    if prepared["settle"] or prepared["skip"]:
        faults.append("--settle and --skip are for records that do not begin at rest; a rig's does. Leave them out.")
    if faults:
        raise UserError("--measure", faults)
    try:
        return Bench(driven_rig(name), name, (seed, name))
    except ValueError as error:
        raise UserError("--measure", str(error)) from None


def _measured(dataset: Dataset, found: Diagnosis, bench: Bench, again: Callable[[Dataset], Diagnosis]) -> Diagnosis:
    """With the advised experiment; without, and told why, where there is none."""
    from hysteresis_bench.diagnosis_study.advised import measured, nothing_to_measure

    if nothing := nothing_to_measure(found):
        say_notes(plain_console(aside=True), [nothing])
        return found
    return measured(dataset, found, bench, again)


def _written(folder: Path, found: Diagnosis) -> list[Path]:
    """The file of what was measured, where something was."""
    from hysteresis_bench.data.data_files import write_csv
    from hysteresis_bench.signals import Dataset

    if found.measured is None:
        return []
    path = folder / f"{found.measured.record.name}.csv"
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(path, Dataset((found.measured.record,)))
    return [path]


def candidates_table(found: Diagnosis) -> Table:
    """Every effect that these records can show, by its whole name however narrow the terminal."""
    from rich.table import Column, Table

    rows = [row for row in found.candidates if row.applicable]
    first = Column("effect", no_wrap=True, min_width=max((len(row.effect) for row in rows), default=0))
    last = Column("tied with", overflow="fold")
    table = Table(first, "", "sure", "RMSE", "left out", "p", last, box=None, pad_edge=False)
    for row in rows:
        mark = "adopted" if row.adopted else "stand-in" if row.stand_in else "at its bound" if row.at_bound else ""
        told = one.probability if (one := found.certainty.get(row.effect)) else None
        sure = "" if told is None else f"{told:.0%}"
        numbers = sure, f"{row.rmse:.4g}", f"{row.cv_rmse:.4g}", f"{row.p:.2g}"
        table.add_row(row.effect, mark, *numbers, ", ".join(row.tied_with), style="bold" if row.adopted else "")
    return table


def print_diagnosis(found: Diagnosis, console: Console) -> None:
    """The verdict, before and after, the candidates, the tests in words, the advice."""
    from rich.markup import escape
    from rich.table import Table

    from hysteresis_bench.data.units import rounded
    from hysteresis_bench.report.fit.folder import MODEL, spared, spared_words
    from hysteresis_bench.report.shared.text import sentence

    colour = {"effect-found": "green", "no-effect-needed": "green", "unexplained-residual": "yellow"}[found.verdict]
    if found.laws is not None:
        console.print(f"law  [bold]{found.model_name}[/], chosen by the data", highlight=False)
    console.print(f"[bold {colour}]{found.verdict}[/]  {escape(found.headline)}", highlight=False)
    console.print(escape(sentence(found.memory.words)), highlight=False, style="dim")
    if found.ceiling is not None:
        console.print(escape(found.ceiling.words), highlight=False)
    if found.measured:
        console.print(f"Before: {escape(found.measured.headline)}", highlight=False, style="dim")
        say_notes(console, found.measured.notes)
        console.print(escape(found.measured.words), highlight=False, style="bold")

    table = Table("", "fitted", "held out", title="RMSE", title_justify="left", box=None, pad_edge=False)
    for label, stage in (("before", found.before), ("after", found.after)):
        table.add_row(label, f"{stage.fitted.rmse:.4g}", f"{stage.held_out.rmse:.4g}" if stage.held_out else "")
    table.add_row("noise", f"{found.noise.floor:.4g}", "")
    console.print(table)

    console.print(candidates_table(found))
    for row in (row for row in found.candidates if not row.applicable):
        console.print(f"{row.effect}: not applicable: {escape(row.reason)}", highlight=False, style="dim")

    table = Table("parameter", "value", "standard error", "unit", box=None, pad_edge=False)
    left_out = spared(found.model)
    for name, estimate in found.model.parameters.items():
        if name in left_out:
            continue
        error = "not determined" if estimate.standard_error is None else rounded(estimate.standard_error)
        table.add_row(name, f"{estimate.value:.5g}", error, escape(estimate.unit))
    console.print(table)
    if left_out:
        console.print(spared_words(left_out, MODEL), highlight=False)

    for family in found.families:
        console.print(escape(family.sentence), highlight=False)
    telling = sorted((test for test in found.after.tests if test.significant), key=lambda test: -test.share)
    for test in telling[:SHOWN]:
        console.print(escape(f"{test.record}: {test.words}."), highlight=False)
    if found.equation is not None and found.equation.terms:
        said = f"A description, not physics: {found.equation} ({found.equation.share:.0%} of its variance)."
        console.print(escape(said), highlight=False)
    for warning in found.warnings:
        console.print(f"[yellow]{escape(warning)}[/]", highlight=False)
    if found.advice:
        console.print(escape(found.advice.words), highlight=False, style="bold")
