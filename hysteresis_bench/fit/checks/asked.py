"""What is wrong with the names and the values that a fit or a diagnosis is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.contracts import Model
from hysteresis_bench.errors import nearest
from hysteresis_bench.parameters import Parameter


def asked_faults(model: str, settings: Mapping[str, Any], effects: Sequence[str]) -> list[str]:
    """A sentence on every fault of a model's name, its settings, and the effects around it."""
    return registry.faults("models", model, settings) + around_faults(model, effects)


def around_faults(model: str, effects: Sequence[str]) -> list[str]:
    """A sentence on every fault of the effects around a model; model : "" for whichever."""
    faults = []
    for effect in dict.fromkeys(effects):
        faults += registry.effect_faults(effect, model)
        if effects.count(effect) > 1:
            faults.append(f'effect "{effect}" is given {effects.count(effect)} times; once is enough.')
    return faults


def parameter_faults(model: Model, bounds: Mapping[str, tuple[float, float]], fixed: Mapping[str, float]) -> list[str]:
    """A sentence on every bound or value whose parameter neither the model nor any effect has, or cannot have."""
    known: dict[str, Parameter] = {one.name: one for one in model.parameters}
    for name in {*registry.names("effects"), *registry.offered()}:
        declared = None if registry.effect_faults(name, "") else registry.effect(name)
        known |= {f"{name}.{one.name}": one for one in (declared.parameters if declared else ())}
    faults = []
    for what, names in (("bounds", bounds), ("fixed", fixed)):
        faults += [f'{what}: no parameter "{name}". {nearest(name, known)}' for name in names if name not in known]
    for name, (low, high) in bounds.items():
        if name in known:
            faults += [f"bounds {fault}" for fault in known[name].bounded(low, high).faults()]
    reasons = (known[name].refuses(value) for name, value in fixed.items() if name in known)
    return faults + [f"fixed {reason}" for reason in reasons if reason]
