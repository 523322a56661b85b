"""A fitted model: how it is made of a fit, what it predicts, and model.json, which `predict` and `control` read."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.signals import Dataset, Record

SCHEMA = 1
LARGEST = 1e100
"""Beyond which no parameter of anything lies."""


@dataclass(frozen=True)
class Estimate:
    """A parameter's value with its standard error (None where the data cannot tell), in `unit`."""

    value: float
    standard_error: float | None
    unit: str


@dataclass(frozen=True)
class Preparation:
    """What is done to an input before a model sees it: `input_offset` is subtracted, `flip` changes the sign."""

    input_offset: float = 0.0
    flip: bool = False

    def __call__(self, record: Record) -> Record:
        sign = -1.0 if self.flip else 1.0
        return replace(record, input=sign * (record.input - self.input_offset))


@dataclass(frozen=True, eq=False)
class FittedModel:
    """A model with effects, its parameters found; `predict` is what it is for.

    parameters : by the system's names, "effect.parameter" for an effect's
    """

    model: str
    settings: Mapping[str, Any]
    effects: tuple[str, ...]
    effect_settings: Mapping[str, Mapping[str, Any]]
    units: Mapping[str, str]
    parameters: Mapping[str, Estimate]
    fixed: Mapping[str, float] = field(default_factory=dict)
    preparation: Preparation = Preparation()
    data: Mapping[str, Any] = field(default_factory=dict)
    error: Mapping[str, Any] = field(default_factory=dict)
    created_by: Mapping[str, str] = field(default_factory=dict)

    @property
    def system(self) -> System:
        """Raises ValueError where a plugin is missing or its settings are wrong."""
        model = registry.build("models", self.model, self.settings)
        return System(model, registry.build_effects(model, self.effects, self.effect_settings), self.fixed)

    @property
    def values(self) -> Array:
        """(dimension,) in the system's order."""
        return np.array([self.parameters[parameter.name].value for parameter in self.system.parameters])

    def predict(self, dataset: Dataset) -> Dataset:
        """The records with their output replaced by the prediction. Raises UserError where that is not finite."""
        system, values = self.system, self.values[:, None]

        def predicted(record: Record) -> Record:
            units = {**record.units, "output": self.units["output"]}
            output = system.respond(self.preparation(record), values)[:, 0]
            if not np.isfinite(output).all():
                raise UserError(record.name, "the model's prediction is not finite: its parameters are no model of it.")
            return replace(record, output=output, units=units)

        return dataset.map(predicted)


def fitted_model(
    problem: Problem,
    values: Array,
    errors: Array,
    *,
    dataset: Dataset,
    model: str,
    settings: Mapping[str, Any],
    preparation: Preparation,
) -> FittedModel:
    """The model of a problem at `values` (dimension,), ready to predict and to be written.

    errors : (dimension,) standard errors, inf where the data cannot tell
    dataset : as the model sees it, prepared;  model, settings : the model's name and its settings
    """
    system, units = problem.system, dataset.units
    offsets = np.array([[float(o[0]) for o in system.offsets(r, values[:, None])] for r in dataset.fitted])
    remembered = {
        name: effect.remembered(list(offsets[:, index])) for index, (name, effect) in enumerate(system.effects)
    }
    error = {"fitted": accuracy(system, dataset.fitted, values).as_dict()}
    if dataset.held_out:
        error["held_out"] = accuracy(system, dataset.held_out, values).as_dict()
    return FittedModel(
        model,
        settings,
        tuple(remembered),
        {name: asdict(effect) for name, effect in remembered.items()},  # type: ignore[call-overload]
        units,
        {
            parameter.name: Estimate(
                float(value), float(error) if np.isfinite(error) else None, parameter.unit_in(units)
            )
            for parameter, value, error in zip(problem.space.parameters, values, errors, strict=True)
        },
        system.fixed,
        preparation,
        {"fitted": [r.name for r in dataset.fitted], "held_out": [r.name for r in dataset.held_out]},
        error,
        {"hysteresis-bench": version("hysteresis-bench"), "python": platform.python_version()},
    )


def write_model(path: Path, fitted: FittedModel) -> None:
    """Write model.json."""
    own: dict[str, Any] = {}
    of_effects: dict[str, dict[str, Any]] = {name: {} for name in fitted.effects}
    for name, estimate in fitted.parameters.items():
        effect, _, parameter = name.rpartition(".")
        (of_effects[effect] if effect else own)[parameter] = asdict(estimate)
    content = {
        "schema": SCHEMA,
        "model": fitted.model,
        "settings": dict(fitted.settings),
        "units": dict(fitted.units),
        "parameters": own,
        "effects": [
            {"effect": name, "settings": dict(fitted.effect_settings.get(name, {})), "parameters": of_effects[name]}
            for name in fitted.effects
        ],
        "fixed": dict(fitted.fixed),
        "preparation": asdict(fitted.preparation),
        "data": dict(fitted.data),
        "error": dict(fitted.error),
        "created_by": dict(fitted.created_by),
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n", encoding="utf-8")


def read_model(path: Path) -> FittedModel:
    """Read model.json. Raises UserError naming what is missing or wrong."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid JSON: {error}.") from None
    if not isinstance(content, dict) or content.get("schema") != SCHEMA:
        found = content.get("schema") if isinstance(content, dict) else None
        raise UserError(str(path), f"is not a fitted model of schema {SCHEMA}: its schema is {found!r}.")
    try:
        estimates = {name: Estimate(**numbers) for name, numbers in content["parameters"].items()}
        for effect in content["effects"]:
            for name, numbers in effect["parameters"].items():
                estimates[f"{effect['effect']}.{name}"] = Estimate(**numbers)
        fitted = FittedModel(
            content["model"],
            content["settings"],
            tuple(effect["effect"] for effect in content["effects"]),
            {effect["effect"]: effect.get("settings", {}) for effect in content["effects"]},
            content["units"],
            estimates,
            content.get("fixed", {}),
            Preparation(**content.get("preparation", {})),
            content.get("data", {}),
            content.get("error", {}),
            content.get("created_by", {}),
        )
        missing = [p.name for p in fitted.system.parameters if p.name not in estimates]
        numbers = {**{name: estimate.value for name, estimate in estimates.items()}, **fitted.fixed}
        wrong = [f"{name} = {value} is no number to predict with." for name, value in numbers.items() if _wild(value)]
    except (KeyError, TypeError) as error:
        raise UserError(str(path), f"is not a fitted model of schema {SCHEMA}: {error} is missing or wrong.") from None
    except ValueError as error:
        raise UserError(str(path), f"{error}") from None
    if missing or wrong:
        raise UserError(str(path), [f'parameter "{name}" is missing.' for name in missing] + wrong)
    return fitted


def _wild(value: float) -> bool:
    """NaN, infinite, or so large that it only overflows."""
    return not abs(value) < LARGEST
