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
from hysteresis_bench.data.data_files import LARGEST
from hysteresis_bench.data.units import MEASURED, in_units, same_unit
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.fit.accuracy import Accuracy, accuracy
from hysteresis_bench.fit.json_values import number_of, value_of
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import AS_IT_IS, Preparation, preparation_of
from hysteresis_bench.fit.unseen.aliases import alias_told, steps
from hysteresis_bench.fit.unseen.between_samples import few_told
from hysteresis_bench.fit.unseen.excited import excited, ranges
from hysteresis_bench.fit.unseen.interval import Interval, interval_of
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import UNITLESS, Dataset, Record

SCHEMA, READABLE = 2, (1, 2)
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
    interval : how far predictions may be off, None in files of before it was kept
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
    interval: Interval | None = None

    @property
    def system(self) -> System:
        """Raises ValueError where a plugin is missing or its settings are wrong."""
        model = registry.build("models", self.model, self.settings)
        return System(model, registry.build_effects(model, self.effects, self.effect_settings), self.fixed)

    @property
    def values(self) -> Array:
        """(dimension,) in the system's order."""
        return np.array([self.parameters[parameter.name].value for parameter in self.system.parameters])

    def predict(self, dataset: Dataset, level: int = 90) -> Dataset:
        """The records in the model's units, prepared as for the fit, their output replaced by the prediction.

        `notes` tell what was done; leading samples that the fit did not score are history.
        level : percent, of the columns output_low and output_high beside it, where the model keeps an interval
        Raises UserError where units do not convert, or where the response is not finite.
        """
        system, values, known = self.system, self.values[:, None], self.in_own_units(dataset)
        if faults := self.preparation.faults(known.records):
            raise UserError("predict", faults)

        def predicted(record: Record) -> Record:
            ready = self.preparation(record)
            try:
                output = system.respond(ready, values)[-record.time.size :, 0]
            except ValueError as error:  # such as a column that is not there
                raise UserError(record.name, f"{error}.") from None
            if not np.all(np.isfinite(output)):
                raise UserError(record.name, "the model's response to this record is not finite.")
            skipped = self.preparation.skipped(record).history
            around = self.interval.around(output, level, record.output is not None) if self.interval else {}
            units = {**record.units, **dict.fromkeys(("output", *around), self.units["output"])}
            return replace(record, output=output, history=skipped, units=units, columns={**record.columns, **around})

        ready, left = known.map(predicted), self.error.get("fitted", {}).get("rmse", np.inf)
        few = [few_told(system, self.preparation(record), values[:, 0], left) for record in known.records]
        few += [alias_told(system, self.data.get("steps"), record) for record in known.records]
        notes = [*known.notes, *self.preparation.words(known.records, self.units["time"]), *filter(None, few)]
        if self.schema < SCHEMA:
            notes.append(f"The model file is of schema {self.schema}, which does not tell whether loops were settled.")
        return replace(ready, notes=tuple(notes))

    def errors(self, dataset: Dataset) -> dict[str, Accuracy]:
        """How well each measured record is predicted, prepared as for the fit; records without output are left out."""
        known = self.in_own_units(dataset)
        return {
            record.name: accuracy(self.system, [self.preparation(record)], self.values)
            for record in known.records
            if record.output is not None and self.preparation.skipped(record).history < record.time.size
        }

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
    """The model of a problem at `values` (dimension,), ready to predict and to be written, without an interval.

    errors : (dimension,) standard errors, inf where the data cannot tell
    dataset : as the model sees it, prepared;  model, settings : the model's name and its settings
    """
    system, units = problem.system, dataset.units
    offsets = np.array([[float(o[0]) for o in system.offsets(r, values[:, None])] for r in dataset.fitted])
    own = zip(system.effects, offsets.T, strict=True)
    remembered = {name: effect.remembered(list(each)) for (name, effect), each in own}
    asked = {"fitted": dataset.fitted, "held_out": dataset.held_out}
    error = {role: accuracy(system, records, values).as_dict() for role, records in asked.items() if records}
    known = [float(error) if np.isfinite(error) else None for error in errors]
    return FittedModel(
        model,
        settings,
        tuple(remembered),
        {name: asdict(effect) for name, effect in remembered.items()},  # type: ignore[call-overload]
        units,
        {
            parameter.name: Estimate(float(value), error, parameter.unit_in(units))
            for parameter, value, error in zip(problem.space.parameters, values, known, strict=True)
        },
        system.fixed,
        preparation,
        {
            **{role: [record.name for record in records] for role, records in asked.items()},
            "ranges": ranges(dataset.fitted, preparation),
            "excited": excited(dataset.fitted),
            "steps": steps(dataset.fitted),
        },
        error,
        {"hysteresis-bench": version("hysteresis-bench"), "python": platform.python_version()},
    )


def write_model(path: Path, fitted: FittedModel) -> None:
    """Write model.json."""
    path.write_text(json.dumps(content_of(fitted), indent=1, allow_nan=False) + "\n", encoding="utf-8")


def read_model(path: Path) -> FittedModel:
    """Read model.json. Raises UserError naming what is missing or wrong."""
    try:
        if path.exists() and not path.is_file():
            raise UserError(str(path), "cannot be read: it is no file.")
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid JSON, so no model.json of `fit` or `diagnose`: {error}.") from None
    return model_of(content, str(path))


def content_of(fitted: FittedModel) -> dict[str, Any]:
    """What model.json holds."""
    own: dict[str, Any] = {}
    of_effects: dict[str, dict[str, Any]] = {name: {} for name in fitted.effects}
    for name, estimate in fitted.parameters.items():
        effect, _, parameter = name.rpartition(".")
        (of_effects[effect] if effect else own)[parameter] = asdict(estimate)
    return {
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
        "interval": fitted.interval and fitted.interval.as_dict(),
        "created_by": dict(fitted.created_by),
    }


def model_of(content: Any, where: str) -> FittedModel:
    """Of what model.json holds. Raises UserError naming what is missing or wrong.  where : it stands, for errors"""
    schema = content.get("schema") if isinstance(content, dict) else None
    if type(schema) is not int or schema not in READABLE:
        raise UserError(where, f"is not a fitted model of schema {READABLE[0]} or {SCHEMA}: its schema is {schema!r}.")
    try:
        fitted = _fitted(content)
        parameters, estimates = fitted.system.parameters, fitted.parameters
    except (KeyError, TypeError, OverflowError) as error:
        raise UserError(where, f"is not a fitted model of schema {schema}: {error} is missing or wrong.") from None
    except ValueError as error:
        raise UserError(where, f"{error}") from None
    faults = [f'parameter "{p.name}" is missing.' for p in parameters if p.name not in estimates]
    faults += [f'the unit of "{name}" is missing.' for name in MEASURED if name not in fitted.units]
    units = {**UNITLESS, **fitted.units}
    faults += [r for p in parameters if p.name in estimates and (r := _refused(p, estimates[p.name], units))]
    if faults := [*faults, *fitted.system.refusals(), *_unknown(fitted)]:
        raise UserError(where, faults)
    return fitted


def _refused(parameter: Parameter, estimate: Estimate, units: Mapping[str, str]) -> str:
    """Why a parameter cannot have this value in this unit, or an empty string."""
    if abs(estimate.value) > LARGEST:
        return f"{parameter.name} = {estimate.value:g} is too large to work with."
    if not same_unit(estimate.unit, expected := parameter.unit_in(units)):
        return f'{parameter.name} is in "{estimate.unit}"; with these units it must be in "{expected}".'
    return parameter.refuses(estimate.value)


def _unknown(fitted: FittedModel) -> list[str]:
    """A sentence on every parameter that the model has not, and every setting of an effect that the file has not."""
    known = [q.name for q in replace(fitted.system, fixed={}).parameters]
    named = (*fitted.parameters, *fitted.fixed)
    found = [f'there is no parameter "{name}". {nearest(name, known)}' for name in named if name not in known]
    found += [f'parameter "{name}" is both found and fixed.' for name in fitted.fixed if name in fitted.parameters]
    for name, effect in fitted.system.effects:
        settings = registry.settings_of(type(effect)) if fitted.schema == SCHEMA else {}
        missing = [setting for setting in settings if setting not in fitted.effect_settings[name]]
        found += [f'effect {name}: its setting "{setting}" is missing.' for setting in missing]
    return found


def _fitted(content: Mapping[str, Any]) -> FittedModel:
    """Raises KeyError, TypeError, OverflowError or ValueError for what is missing or of the wrong kind."""
    if content["schema"] < SCHEMA:
        content = _upgraded(content)
    effects = value_of(content, "effects", list)
    names = tuple(value_of(effect, "effect", str) for effect in effects)
    if len(set(names)) < len(names):
        raise ValueError("an effect stands there twice; it can act once.")
    prepared, units = value_of(content, "preparation", dict), value_of(content, "units", dict)
    groups = [("", content), *((f"{name}.", effect) for name, effect in zip(names, effects, strict=True))]
    return FittedModel(
        value_of(content, "model", str),
        value_of(content, "settings", dict),
        names,
        {name: value_of(effect, "settings", dict) for name, effect in zip(names, effects, strict=True)},
        {name: value_of(units, name, str) for name in units},
        {
            f"{prefix}{name}": _estimate(one, f"{prefix}{name}")
            for prefix, group in groups
            for name, one in value_of(group, "parameters", dict).items()
        },
        {name: number_of(content["fixed"], name) for name in value_of(content, "fixed", dict)},
        preparation_of({"steps": 1, **prepared}),
        value_of(content, "data", dict),
        value_of(content, "error", dict),
        value_of(content, "created_by", dict),
        content["schema"],
        interval_of(content.get("interval")),
    )


def _upgraded(content: Mapping[str, Any]) -> dict[str, Any]:
    """What schema 1 did not ask for, added."""
    absent: dict[str, Any] = {"fixed": {}, "preparation": {}, "data": {}, "error": {}, "created_by": {}}
    effects = [{"settings": {}, **effect} for effect in value_of(content, "effects", list)]
    prepared = {**asdict(AS_IT_IS), **value_of({**absent, **content}, "preparation", dict)}
    return {**absent, **content, "effects": effects, "preparation": prepared}


def _estimate(content: Any, name: str) -> Estimate:
    try:
        error = None if content["standard_error"] is None else number_of(content, "standard_error")
        return Estimate(number_of(content, "value"), error, value_of(content, "unit", str))
    except (KeyError, TypeError) as lacking:
        raise ValueError(f'parameter "{name}": of value, standard_error, unit {lacking} is missing or wrong.') from None
