"""The study file: TOML in, a checked study out; all faults are told at once, with the nearest known name."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PositiveInt, ValidationError, model_validator

from hysteresis_bench import registry
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.loss import LOSSES
from hysteresis_bench.parameters import Scaling

SECONDS = {"s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0}


def duration(text: Any) -> float:
    """ "10 min" -> 600.0 seconds; a bare number is seconds. Raises ValueError."""
    match = re.fullmatch(r"\s*([0-9.]+)\s*(s|sec|min|h)?\s*", str(text))
    if not match or float(match[1]) <= 0:
        raise ValueError(f'{text!r} is not a time such as "90 s", "10 min" or "1 h"')
    return float(match[1]) * SECONDS[match[2] or "s"]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class OptimizerSpec(_Strict):
    """One optimizer of a study; `label` tells two of the same plugin apart; `budget` overrides the study's."""

    plugin: str
    label: str = ""
    settings: dict[str, Any] = {}
    budget: PositiveInt | None = None

    @property
    def name(self) -> str:
        return self.label or self.plugin


class ProblemSpec(_Strict):
    """One problem: where the data come from, what is fitted, and in which box.

    fitted, held_out : experiments of the rig, or names of records (of the data: all where none is named)
    bounds : replaces the model's own box, parameter by parameter; "data" derives the rest from the data
    fixed : parameters that are known: not searched
    profile : parameters whose profile likelihood the report shows
    optimizers : labels of those that run on this problem; all where none is named
    """

    name: str
    model: str
    settings: dict[str, Any] = {}
    effects: list[str] = []
    rig: str | None = None
    rig_settings: dict[str, Any] = {}
    data: list[str] = []
    fitted: list[str] = []
    held_out: list[str] = []
    scaling: Scaling | None = None
    loss: str = "rmse"
    box: Literal["model", "data"] = "model"
    bounds: dict[str, tuple[float, float]] = {}
    fixed: dict[str, float] = {}
    profile: list[str] = []
    optimizers: list[str] = []
    skip: Annotated[float, BeforeValidator(duration)] | None = None
    settle: bool = False

    @model_validator(mode="after")
    def one_source(self) -> ProblemSpec:
        if (self.rig is None) == (not self.data):
            raise ValueError('name either a rig = "..." or data = ["a.csv"], not both or none')
        if self.rig and not self.fitted:
            raise ValueError('fitted = ["..."] must name at least one experiment of the rig')
        return self


class StageSpec(_Strict):
    """The linear section behind a static one, fitted after a problem has found the static one.

    after : the problem; its rig or data are the stage's too
    optimizers : labels whose best trial is taken further; the best trial of all is added
    model, settings : the whole; what it does not share with `fit` is held at what the trial found
    fit : gain, damping and stiffness of the linear section, by the model's names and in its order
    fitted, check : experiments or records to fit and to check the whole model on
    beside : a problem that finds all parameters at once, for comparison
    control : labels whose staged model is put to work in closed loop on the problem's rig
    """

    name: str
    after: str
    optimizers: list[str] = []
    model: str
    settings: dict[str, Any] = {}
    fit: tuple[str, str, str]
    fitted: list[str] = Field(min_length=1)
    check: list[str] = []
    beside: str | None = None
    control: list[str] = []


class Study(_Strict):
    """A checked study. `reference` is the optimizer that the others are compared with."""

    title: str
    seed: int
    trials: PositiveInt = 3
    budget: PositiveInt = 15050
    timeout: Annotated[float, BeforeValidator(duration)] = 600.0
    reference: str = "pso"
    published: str | None = None
    notes: list[str] = []
    problem: list[ProblemSpec] = Field(min_length=1)
    optimizer: list[OptimizerSpec] = Field(min_length=1)
    stage: list[StageSpec] = []

    @property
    def labels(self) -> list[str]:
        return [spec.name for spec in self.optimizer]

    def budget_of(self, spec: OptimizerSpec) -> int:
        return spec.budget or self.budget

    def identity(self) -> dict[str, Any]:
        """What makes it the same study: all but the trials, the optimizers, and what follows the trials."""
        afterwards: dict[str, Any] = {"trials": True, "optimizer": True, "stage": True}
        return self.model_dump(mode="json", exclude=afterwards | {"problem": {"__all__": {"optimizers"}}})


def read_study(path: Path) -> tuple[Study, str]:
    """A study and its text. Raises UserError telling every fault of the file."""
    try:
        text = path.read_text(encoding="utf-8")
        raw = tomllib.loads(text)
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid TOML: {error}.") from error
    return check_study(raw, str(path)), text


def check_study(raw: dict[str, Any], where: str) -> Study:
    """A study from parsed TOML. Raises UserError telling every fault, of form and of content."""
    try:
        study = Study.model_validate(raw)
    except ValidationError as error:
        raise UserError(where, [_sentence(fault) for fault in error.errors()] + _plugin_faults(raw)) from None
    found = _plugin_faults(raw) + _doubles(study)
    if found:
        raise UserError(where, found)
    return study


def _place(location: tuple[int | str, ...]) -> str:
    """("optimizer", 1, "settings") -> [[optimizer]] 2 settings."""
    words: list[str] = []
    for index, part in enumerate(location):
        if isinstance(part, int):
            words[-1] = f"[[{words[-1]}]] {part + 1}" if index == 1 else f"{words[-1]} {part + 1}"
        else:
            words.append(str(part))
    return " ".join(words)


def _sentence(fault: Any) -> str:
    location = fault["loc"]
    if fault["type"] == "extra_forbidden":
        owners: dict[str, type[BaseModel]] = {
            "problem": ProblemSpec,
            "optimizer": OptimizerSpec,
            "stage": StageSpec,
        }
        owner = owners.get(str(location[0]), Study)
        known = owner.model_fields if len(location) > 1 or owner is Study else Study.model_fields
        place = _place(location[:-1])
        return f'{place + ": " if place else ""}no key "{location[-1]}". {nearest(str(location[-1]), known)}'
    message = fault["msg"].removeprefix("Value error, ")
    return f"{_place(location)}: {message[0].lower() + message[1:]}."


def _plugin_faults(raw: dict[str, Any]) -> list[str]:
    """Unknown plugins, settings, parameters and losses, wherever the file's form lets them be read."""
    found = []
    for number, spec in enumerate(_tables(raw, "optimizer"), 1):
        if isinstance(spec.get("plugin"), str):
            faults = registry.faults("optimizers", spec["plugin"], spec.get("settings", {}))
            found += [f"[[optimizer]] {number}: {fault}" for fault in faults]
    for number, spec in enumerate(_tables(raw, "problem"), 1):
        found += [f"[[problem]] {number}: {fault}" for fault in _problem_faults(spec) + _label_faults(spec, raw)]
    for number, spec in enumerate(_tables(raw, "stage"), 1):
        found += [f"[[stage]] {number}: {fault}" for fault in _stage_faults(spec, raw)]
    return found


def _tables(raw: dict[str, Any], key: str) -> list[dict[str, Any]]:
    value = raw.get(key, [])
    return [entry for entry in value if isinstance(entry, dict)] if isinstance(value, list) else []


def _problem_faults(spec: dict[str, Any]) -> list[str]:
    found = []
    if isinstance(spec.get("model"), str):
        faults = registry.faults("models", spec["model"], spec.get("settings", {}))
        found += faults or _bound_faults(spec)
    for effect in spec.get("effects", []):
        found += registry.effect_faults(effect, str(spec.get("model")))
    if isinstance(spec.get("rig"), str):
        faults = registry.faults("rigs", spec["rig"], spec.get("rig_settings", {}))
        found += faults
        if not faults:
            rig = registry.build("rigs", spec["rig"], spec.get("rig_settings", {}))
            for key in ("fitted", "held_out"):
                for experiment in spec.get(key, []):
                    if experiment not in rig.experiments:
                        known = nearest(str(experiment), rig.experiments)
                        found.append(f'{key}: rig {spec["rig"]} has no experiment "{experiment}". {known}')
    if spec.get("loss", "rmse") not in LOSSES:
        found.append(f'no loss "{spec["loss"]}". {nearest(str(spec["loss"]), LOSSES)}')
    return found


def _listed(spec: dict[str, Any], key: str) -> list[str]:
    value = spec.get(key, [])
    return [str(entry) for entry in value] if isinstance(value, list) else []


def _label_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    labels = [str(each.get("label") or each.get("plugin")) for each in _tables(raw, "optimizer")]
    wanted = [label for label in _listed(spec, "optimizers") if label not in labels]
    return [f'optimizers: no optimizer "{label}" in this study. {nearest(label, labels)}' for label in wanted]


def _stage_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    problems = {str(each.get("name")): each for each in _tables(raw, "problem")}
    found = _label_faults(spec, raw)
    for key in ("after", "beside"):
        if key in spec and spec[key] not in problems:
            found.append(f'{key}: no problem "{spec[key]}". {nearest(str(spec[key]), problems)}')
    for label in set(_listed(spec, "control")) - set(_listed(spec, "optimizers")):
        found.append(f'control: "{label}" is not among the optimizers of this stage.')
    if spec.get("control") and not problems.get(str(spec.get("after")), {}).get("rig"):
        found.append(f'control: "{spec.get("after")}" has no rig to control.')
    source = {key: value for key, value in problems.get(str(spec.get("after")), {}).items() if key.startswith("rig")}
    found += _problem_faults(source | {"fitted": _listed(spec, "fitted"), "held_out": _listed(spec, "check")})
    names, known = _parameter_names(spec), _parameter_names(problems.get(str(spec.get("after")), {}))
    if not names:
        return found + registry.faults("models", str(spec.get("model")), spec.get("settings", {}))
    fit = _listed(spec, "fit")
    found += [
        f'fit: {spec["model"]} has no parameter "{name}". {nearest(name, names)}' for name in fit if name not in names
    ]
    if sorted(fit, key=[*names, *fit].index) != fit:
        found.append(f"fit: name the parameters in the model's order: {', '.join(names)}.")
    for name in names:
        if known and name not in (*fit, *known):
            found.append(f'{name} of {spec["model"]} is neither in fit nor found by "{spec["after"]}".')
    return found


def _parameter_names(spec: dict[str, Any]) -> list[str]:
    """The parameters of a problem's or a stage's model; none where it cannot be built."""
    model, settings = spec.get("model"), spec.get("settings", {})
    if not isinstance(model, str) or registry.faults("models", model, settings):
        return []
    return [parameter.name for parameter in registry.build("models", model, settings).parameters]


def _bound_faults(spec: dict[str, Any]) -> list[str]:
    model = registry.build("models", spec["model"], spec.get("settings", {}))
    parameters = {parameter.name: parameter for parameter in model.parameters}
    found = []
    for key in ("bounds", "fixed", "profile"):
        values = spec.get(key, {})
        for name in values if isinstance(values, (dict, list)) else ():
            if name not in parameters and "." not in name:
                found.append(f'{key}: {spec["model"]} has no parameter "{name}". {nearest(name, parameters)}')
    for name, pair in spec.get("bounds", {}).items():
        numbers = isinstance(pair, list) and len(pair) == 2 and all(isinstance(x, (int, float)) for x in pair)
        if name in parameters and numbers:
            scaling = spec.get("scaling") or parameters[name].scaling
            if scaling in ("linear", "log"):
                found += [f"bounds {fault}" for fault in parameters[name].within(*pair, scaling).faults()]
    return found


def _doubles(study: Study) -> list[str]:
    found = []
    for what, names in (
        ("optimizer", study.labels),
        ("problem", [problem.name for problem in study.problem]),
        ("stage", [stage.name for stage in study.stage]),
    ):
        word = "label" if what == "optimizer" else "name"
        for name in sorted({name for name in names if names.count(name) > 1}):
            found.append(f'two [[{what}]] are both called "{name}"; give one another {word}.')
    return found
