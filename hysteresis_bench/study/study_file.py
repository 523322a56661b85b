"""The study file: TOML in, a checked study out; all faults are told at once, with the nearest known name."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PositiveInt, ValidationError, model_validator

from hysteresis_bench import registry
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.parameters import Scaling
from hysteresis_bench.study.study_faults import content_faults

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


class ClosingSpec(_Strict):
    """How a study closes its loop: what a diagnosis gets to see once the trials are in.

    model, settings : the bare model
    after : the problem whose rig or data are this one's too; the study's first where none is named
    fitted, held_out : experiments of the rig, or records of the data
    effects : known to act, around the model from the beginning
    says : what the paper itself says that its model lacks
    """

    model: str
    settings: dict[str, Any] = {}
    after: str | None = None
    fitted: list[str] = Field(min_length=1)
    held_out: list[str] = Field(min_length=1)
    effects: list[str] = []
    says: str = ""


class Study(_Strict):
    """A checked study. `reference` is the optimizer that the others are compared with."""

    title: str
    seed: int
    trials: PositiveInt = 3
    budget: PositiveInt = 15050
    timeout: Annotated[float, BeforeValidator(duration)] = 600.0
    reference: str = registry.REFERENCE
    published: str | None = None
    notes: list[str] = []
    problem: list[ProblemSpec] = Field(min_length=1)
    optimizer: list[OptimizerSpec] = Field(min_length=1)
    stage: list[StageSpec] = []
    closing: ClosingSpec | None = None

    @property
    def labels(self) -> list[str]:
        return [spec.name for spec in self.optimizer]

    def budget_of(self, spec: OptimizerSpec) -> int:
        return spec.budget or self.budget

    def identity(self) -> dict[str, Any]:
        """What makes it the same study: all but the trials, the optimizers, and what follows the trials."""
        afterwards: dict[str, Any] = {"trials": True, "optimizer": True, "stage": True, "closing": True}
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
        raise UserError(where, [_sentence(fault) for fault in error.errors()] + content_faults(raw)) from None
    found = content_faults(raw) + _doubles(study)
    if found:
        raise UserError(where, found)
    return study


def _words(location: tuple[int | str, ...]) -> list[str]:
    """("optimizer", 1, "settings") -> [[optimizer]] 2, settings; ("closing", "fitted") -> [closing], fitted."""
    words: list[str] = []
    for index, part in enumerate(location):
        if isinstance(part, int):
            words[-1] = f"[[{words[-1]}]] {part + 1}" if index == 1 else f"{words[-1]} {part + 1}"
        else:
            table = index == 0 and len(location) > 1 and isinstance(location[1], str)
            words.append(f"[{part}]" if table else part)
    return words


def _sentence(fault: Any) -> str:
    location = fault["loc"]
    if fault["type"] == "extra_forbidden":
        owners: dict[str, type[BaseModel]] = {
            "problem": ProblemSpec,
            "optimizer": OptimizerSpec,
            "stage": StageSpec,
            "closing": ClosingSpec,
        }
        owner = owners.get(str(location[0]), Study)
        known = owner.model_fields if len(location) > 1 or owner is Study else Study.model_fields
        place = " ".join(_words(location)[:-1])
        return f'{place + ": " if place else ""}no key "{location[-1]}". {nearest(str(location[-1]), known)}'
    message = fault["msg"].removeprefix("Value error, ")
    return f"{' '.join(_words(location))}: {message[0].lower() + message[1:]}."


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
