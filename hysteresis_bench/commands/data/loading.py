"""The records that a question is asked of; where they are at fault, so is told what else is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hysteresis_bench.errors import UserError

if TYPE_CHECKING:
    from hysteresis_bench.data.layout import Layout
    from hysteresis_bench.signals import Dataset


def loaded(
    command: str, data: Sequence[Path], held_out: Sequence[str], layout: Layout, *, others: Callable[[], Sequence[str]]
) -> Dataset:
    """As of `hysteresis_bench.load`.  others : sentences on what else of the command is at fault

    Raises UserError telling all of it at once.
    """
    from hysteresis_bench import load

    try:
        return load(*data, held_out=held_out, layout=layout)
    except UserError as error:
        if not (told := others()):
            raise
        raise UserError(command, [*(f"{error.where}: {fault}" for fault in error.faults), *told]) from None


def model_faults(
    model: str, effects: Sequence[str], asked: Mapping[str, Any], optimizer: str | None = None
) -> list[str]:
    """A sentence on every fault of a model's name, its settings and parameters, the effects around it, and a search.

    asked : settings, bounds and fixed values, as of `parameters.model_options`
    """
    from hysteresis_bench import registry
    from hysteresis_bench.fit.checks.asked import asked_faults, parameter_faults

    faults = asked_faults(model, asked["settings"], effects)
    if faults := faults + (registry.faults("optimizers", optimizer, {}) if optimizer else []):
        return faults
    return parameter_faults(registry.build("models", model, asked["settings"]), asked["bounds"], asked["fixed"])
