"""Settings of a model, bounds and known values of its parameters, as they are written on a command line."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import click

from hysteresis_bench.commands.data.options import packing
from hysteresis_bench.errors import UserError

Value = TypeVar("Value")

OPTIONS = (
    click.option(
        "--set", "settings", multiple=True, metavar="NAME=VALUE", help="A setting of the model, such as plays=20."
    ),
    click.option("--bounds", multiple=True, metavar="P=LO:HI", help="Search box of a parameter."),
    click.option("--fix", "fixed", multiple=True, metavar="P=VALUE", help="A parameter that is known."),
)


def _asked(settings: Sequence[str], bounds: Sequence[str], fixed: Sequence[str]) -> dict[str, Any]:
    return {"settings": _settings(settings), "bounds": _pairs(bounds), "fixed": _values(fixed)}


model_options = packing(OPTIONS, ("settings", "bounds", "fixed"), "asked", _asked)
"""What is asked of a model, as `asked`: arguments of `fit` and of `diagnose`."""


def _pairs(texts: Sequence[str]) -> dict[str, tuple[float, float]]:
    """P=LO:HI ..."""

    def interval(text: str) -> tuple[float, float]:
        low, _, high = text.partition(":")
        return float(low), float(high)

    return _by_name(texts, interval, "--bounds", "PARAMETER=LOW:HIGH, such as a=0.1:10")


def _values(texts: Sequence[str]) -> dict[str, float]:
    """P=VALUE ..."""
    return _by_name(texts, float, "--fix", "PARAMETER=VALUE, such as n=1")


def _settings(texts: Sequence[str]) -> dict[str, Any]:
    """NAME=VALUE ..., values as in a study file: a number, true or false, or a word."""
    return _by_name(texts, _setting, "--set", "NAME=VALUE, such as plays=20")


def _setting(text: str) -> Any:
    import tomllib

    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _by_name(texts: Sequence[str], read: Callable[[str], Value], option: str, form: str) -> dict[str, Value]:
    found: dict[str, Value] = {}
    faults = []
    for text in texts:
        name, _, value = text.partition("=")
        if name.strip() in found:
            faults.append(f'"{name.strip()}" is given twice.')
        try:
            found[name.strip()] = read(value)
        except ValueError:
            faults.append(f'"{text}" should read {form}.')
    if faults:
        raise UserError(option, faults)
    return found
