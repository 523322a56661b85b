"""The command `new-study`: a commented study file on data, ready to run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hysteresis_bench.commands.data.options import data_options, say_understood
from hysteresis_bench.commands.outputs import check_file, force_option
from hysteresis_bench.commands.terminal.as_json import json_option, say_json
from hysteresis_bench.commands.terminal.console import plain_console, say_notes, say_path
from hysteresis_bench.errors import UserError

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout
    from hysteresis_bench.signals import Dataset

SCHEMA = "study.schema.json"
TEMPLATE = """\
#:schema ./{schema}
# Which optimizer finds the parameters of {model} on {title}?
# Run it, and run it again to continue:  hysteresis-bench run {name}
title   = "Which optimizer finds the parameters of {model} on {title}?"
seed    = 1                 # the same file gives the same numbers, bit for bit
trials  = 3                 # of every optimizer; below 14 the report gives no p-values
budget  = 15050             # evaluations, the same for everyone and exactly kept
timeout = "10 min"          # a trial

[[problem]]
name     = "{stem}"
data     = [{data}]
{layout}model    = "{model}"        # see: hysteresis-bench list models
effects  = []               # around the model, innermost first; see: hysteresis-bench list effects
fitted   = [{fitted}]
held_out = [{held_out}]     # predicted at the end, never fitted
box      = "data"           # follows from the ranges of the records, as in `fit`
# bounds = {{ PARAMETER = [LOW, HIGH] }}    replaces parts of the box
# fixed  = {{ PARAMETER = VALUE }}          is known and not searched
# skip   = "2 s"                          leaves a switch-on transient out of the score
# settle = true                           repeats closed loops before they are scored
{optimizers}"""


@click.command("new-study")
@click.argument("data", type=click.Path(path_type=Path), nargs=-1, required=True)
@data_options
@click.option("--model", required=True, help="A registered model; see `list models`.")
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), help="The study file; default: NAME.toml.")
@json_option
@force_option
def new_study(data: Sequence[Path], layout: Layout, model: str, out: Path | None, as_json: bool, force: bool) -> None:
    """Write a commented study file on DATA ..., ready to `run`."""
    from hysteresis_bench import registry
    from hysteresis_bench.data.data_files import read_data
    from hysteresis_bench.schemas.forms import schema

    if model not in registry.names("models"):
        raise UserError("new-study", registry.faults("models", model, {}))
    path = out or Path(f"{data[0].stem}.toml")
    check_file(path, data, force)
    dataset, console = read_data(data, layout=layout), plain_console()
    files = [_beside(file, path) for file in data]
    path.write_text(_text(dataset, layout, files=files, path=path, model=model), encoding="utf-8")
    path.with_name(SCHEMA).write_text(json.dumps(schema("study"), indent=1) + "\n", encoding="utf-8")
    if as_json:
        say_json({"records": [dict(row) for row in dataset.understood], "notes": dataset.notes, "study": path})
        return
    say_understood(console, dataset)
    say_notes(console, dataset.notes)
    say_path(console, "study", path)


def _text(dataset: Dataset, layout: Layout, *, files: Sequence[Path], path: Path, model: str) -> str:
    from hysteresis_bench import registry

    names = list(dataset.names)
    held_out = names[-max(1, round(len(names) / 3)) :] if len(names) > 1 else []
    optimizers = dict.fromkeys((registry.SEARCH, registry.REFERENCE, registry.RANDOM_SEARCH))
    return TEMPLATE.format(
        schema=SCHEMA,
        model=model,
        title=", ".join(file.stem for file in files),
        name=path,
        stem=path.stem,
        data=_quoted([str(file.name if file.parent == path.parent else file) for file in files]),
        layout=_layout_line(layout),
        fitted=_quoted([name for name in names if name not in held_out]),
        held_out=_quoted(held_out),
        optimizers="".join(f'\n[[optimizer]]\nplugin = "{name}"\n' for name in optimizers),
    )


def _layout_line(layout: Layout) -> str:
    """What the files do not say, as a key of the problem; empty where they say it all."""
    said = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in asdict(layout).items() if value]
    return f"layout   = {{ {', '.join(said)} }}\n" if said else ""


def _beside(file: Path, study: Path) -> Path:
    """The file as a study in its folder names it."""
    return file if file.is_absolute() or study.parent == Path() else file.resolve()


def _quoted(texts: Sequence[str]) -> str:
    return ", ".join(json.dumps(text, ensure_ascii=False) for text in texts)
