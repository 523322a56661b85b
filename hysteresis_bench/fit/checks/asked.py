"""What is wrong with the names that a fit or a diagnosis is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hysteresis_bench import registry


def asked_faults(model: str, settings: Mapping[str, Any], effects: Sequence[str]) -> list[str]:
    """A sentence on every fault of a model's name, its settings, and the effects around it."""
    faults = registry.faults("models", model, settings)
    for effect in dict.fromkeys(effects):
        faults += registry.effect_faults(effect, model)
        if effects.count(effect) > 1:
            faults.append(f'effect "{effect}" is given {effects.count(effect)} times; once is enough.')
    return faults
