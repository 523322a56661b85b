"""Numbers on a command line that are finite: click's own types and ranges let nan and inf through."""

from __future__ import annotations

import math

import click


def finite(context: click.Context, option: click.Parameter, value: float | None) -> float | None:
    """An option's callback: the number, or None where none is given. Raises BadParameter for nan and inf."""
    if value is not None and not math.isfinite(value):
        raise click.BadParameter(f"{value} is not a finite number.", context, option)
    return value
