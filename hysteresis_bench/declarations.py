"""What a plugin's class must say of itself before it can be used."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping
from typing import Any

from hysteresis_bench.contracts import Acts, Effect, Family, Model, Property
from hysteresis_bench.errors import nearest
from hysteresis_bench.parameters import Parameter

WORDS = {"acts": typing.get_args(Acts), "family": typing.get_args(Family)}
"""What an effect may say of itself."""
PROPERTIES = typing.get_args(Property)
"""What a model may say of itself."""


def declaration_faults(plugin: Any, contract: type) -> list[str]:
    """What is wrong with the class, a sentence each; empty when nothing is. contract : of contracts.py"""
    if not (isinstance(plugin, type) and issubclass(plugin, contract)):
        return [f"{getattr(plugin, '__qualname__', plugin)!s} does not keep the contract {contract.__name__}"]
    undeclared = [attribute for attribute in contract.__annotations__ if not hasattr(plugin, attribute)]
    if missing := sorted({*getattr(plugin, "__abstractmethods__", ()), *undeclared}):
        return [f"{plugin.__name__} lacks {', '.join(missing)}"]
    found = _settings_faults(plugin)
    if contract in (Model, Effect) and not _are_parameters(plugin.parameters):  # type: ignore[attr-defined]
        found.append(f"{plugin.__name__}: parameters must be a tuple of Parameter")
    for attribute in ("offers", "mistaken_for"):
        if not isinstance(getattr(plugin, attribute, {}), Mapping):
            found.append(f"{plugin.__name__}: {attribute} must be a mapping of names")
    for attribute, known in WORDS.items() if contract is Effect else ():
        if (word := getattr(plugin, attribute)) not in known:
            found.append(f'{plugin.__name__}: no {attribute} "{word}". {nearest(str(word), known)}')
    for word in getattr(plugin, "properties", ()) if contract is Model else ():
        if word not in PROPERTIES:
            found.append(f'{plugin.__name__}: no property "{word}". {nearest(str(word), PROPERTIES)}')
    return found


def _settings_faults(plugin: type) -> list[str]:
    if "__dataclass_fields__" not in vars(plugin):
        return [f"{plugin.__name__} is no @dataclass(frozen=True), so its settings cannot be told"]
    needed = [
        field.name
        for field in dataclasses.fields(plugin)
        if field.init and field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    ]
    return [f"{plugin.__name__}: the setting {name} has no default" for name in needed]


def _are_parameters(parameters: object) -> bool:
    return isinstance(parameters, tuple) and all(isinstance(one, Parameter) for one in parameters)
