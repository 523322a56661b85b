"""The command `schema`: what a kind of file holds."""

from __future__ import annotations

import json

import click


@click.command()
@click.argument("kind", type=click.Choice(("study", "model", "diagnosis")))
def schema(kind: str) -> None:
    """Print the JSON schema of study files, model.json or diagnosis.json, for editors and programs."""
    from hysteresis_bench.schemas.forms import schema as shipped

    click.echo(json.dumps(shipped(kind), indent=1, ensure_ascii=False))
