"""What a command prints with --json: one value on standard output, in place of its tables."""

from __future__ import annotations

import json
import math
from typing import Any

import click

json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON in place of tables.")


def say_json(content: Any) -> None:
    """Print it; numbers that are not finite are null, paths are texts."""
    click.echo(json.dumps(_plain(content), indent=1, ensure_ascii=False))


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if isinstance(value, (str, int, bool, type(None))) else str(value)
