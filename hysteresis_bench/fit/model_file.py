"""A fitted model: how it is made of a fit, what it predicts, and model.json, which `predict` and `control` read."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.data.data_files import LARGEST
from hysteresis_bench.data.units import MEASURED, in_units
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.accuracy import Accuracy, accuracy
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import AS_IT_IS, Preparation
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Dataset, Record

SCHEMA = 2
READABLE = (1, 2)
"""Schema 1 kept of the preparation only input_offset and flip."""


@dataclass(frozen=True)
class Estimate:
    """A parameter's value with its standard error (None where the data cannot tell), in `unit`."""

    value: float
    standard_error: float | None
    unit: str


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
    preparation: Preparation = AS_IT_IS
    data: Mapping[str, Any] = field(default_factory=dict)
    error: Mapping[str, Any] = field(default_factory=dict)
    created_by: Mapping[str, str] = field(default_factory=dict)
    schema: int = SCHEMA

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
        """The records in the model's units, prepared as for the fit, their output replaced by the prediction.

        `notes` tell what was done; leading samples that the fit did not score are history.
        Raises UserError where units do not convert, or where the response is not finite.
        """
        system, values, known = self.system, self.values[:, None], self.in_own_units(dataset)

        def predicted(record: Record) -> Record:
            ready = self.preparation(record)
            output = system.respond(ready, values)[-record.time.size :, 0]
            if not np.all(np.isfinite(output)):
                raise UserError(record.name, "the model's response to this record is not finite.")
            skipped = self.preparation.skipped(record).history
            return replace(record, output=output, history=skipped, units={**record.units, **self._output_unit})

        notes = [*known.notes, *self.preparation.words(known.records, self.units["time"])]
        if self.schema < SCHEMA:
            notes.append(f"The model file is of schema {self.schema}, which does not tell whether loops were settled.")
        return replace(known.map(predicted), notes=tuple(notes))

    def errors(self, dataset: Dataset) -> dict[str, Accuracy]:
        """How well each measured record is predicted, prepared as for the fit; records without output are left out."""
        known = self.in_own_units(dataset)
        return {
            record.name: accuracy(self.system, [self.preparation(record)], self.values)
            for record in known.records
            if record.output is not None and self.preparation.skipped(record).history < record.time.size
        }

    @property
    def _output_unit(self) -> dict[str, str]:
        return {"output": self.units["output"]}

    def in_own_units(self, dataset: Dataset) -> Dataset:
        """The records in the model's units. Raises UserError where units do not convert."""
        return in_units(dataset, self.units, "the records", "the model's")


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
        {
            "fitted": [record.name for record in dataset.fitted],
            "held_out": [record.name for record in dataset.held_out],
            "ranges": _ranges(dataset.fitted, preparation),
        },
        error,
        {"hysteresis-bench": version("hysteresis-bench"), "python": platform.python_version()},
    )


def _ranges(records: Sequence[Record], preparation: Preparation) -> dict[str, list[float]]:
    """Of input and output as they were measured; records : as the model sees them."""
    inputs = [preparation.measured_input(float(edge(r.input))) for r in records for edge in (np.min, np.max)]
    outputs = [float(edge(r.measured)) for r in records for edge in (np.min, np.max)]
    return {"input": [min(inputs), max(inputs)], "output": [min(outputs), max(outputs)]}


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
        if path.exists() and not path.is_file():
            raise UserError(str(path), "cannot be read: it is no file.")
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid JSON: {error}.") from None
    schema = content.get("schema") if isinstance(content, dict) else None
    if type(schema) is not int or schema not in READABLE:
        known = " or ".join(map(str, READABLE))
        raise UserError(str(path), f"is not a fitted model of schema {known}: its schema is {schema!r}.")
    try:
        fitted = _fitted(content)
        parameters = fitted.system.parameters
    except (AttributeError, KeyError, TypeError) as error:
        raise UserError(str(path), f"is not a fitted model of schema {schema}: {error} is missing or wrong.") from None
    except ValueError as error:
        raise UserError(str(path), f"{error}") from None
    estimates = fitted.parameters
    faults = [f'parameter "{p.name}" is missing.' for p in parameters if p.name not in estimates]
    faults += [r for p in parameters if p.name in estimates and (r := _refused(p, estimates[p.name].value))]
    faults += fitted.system.refusals()
    faults += [f'the unit of "{name}" is missing.' for name in MEASURED if not isinstance(fitted.units.get(name), str)]
    if faults:
        raise UserError(str(path), faults)
    return fitted


def _refused(parameter: Parameter, value: float) -> str:
    too_large = f"{parameter.name} = {value:g} is too large to work with." if abs(value) > LARGEST else ""
    return parameter.refuses(value) or too_large


def _fitted(content: Mapping[str, Any]) -> FittedModel:
    """Raises AttributeError, KeyError, TypeError or ValueError for what is missing or of the wrong kind."""
    groups = [("", content["parameters"]), *((f"{one['effect']}.", one["parameters"]) for one in content["effects"])]
    estimates = {prefix + name: Estimate(**numbers) for prefix, group in groups for name, numbers in group.items()}
    return FittedModel(
        content["model"],
        content["settings"],
        tuple(effect["effect"] for effect in content["effects"]),
        {effect["effect"]: effect.get("settings", {}) for effect in content["effects"]},
        dict(content["units"]),
        {name: replace(estimate, value=float(estimate.value)) for name, estimate in estimates.items()},
        {name: float(value) for name, value in content.get("fixed", {}).items()},
        Preparation(**content.get("preparation", {})),
        dict(content.get("data", {})),
        dict(content.get("error", {})),
        dict(content.get("created_by", {})),
        content["schema"],
    )
