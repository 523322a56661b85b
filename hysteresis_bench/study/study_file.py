"""The study file: TOML in, a checked study out; all faults are told at once, with the nearest known name."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from pydantic import Field, PositiveInt, model_validator

from hysteresis_bench import registry
from hysteresis_bench.data.layout import ROLES, Layout
from hysteresis_bench.errors import UserError
from hysteresis_bench.parameters import Scaling
from hysteresis_bench.study.strict import Ends, Seconds, Strict, read_toml, shown, validated
from hysteresis_bench.study.study_faults import content_faults

AS_MANY = {"optimizers", "instances", "most_trials"}
"""What of a problem says how much of it is run."""


class OptimizerSpec(Strict):
    """One optimizer of a study; `label` tells two of the same plugin apart; `budget` overrides the study's."""

    plugin: str
    label: str = ""
    settings: dict[str, Any] = {}
    budget: PositiveInt | None = None

    @property
    def name(self) -> str:
        return self.label or self.plugin


class LayoutSpec(Strict):
    """How data files are read where they do not say it: the options of the commands that read data, as keys.

    time, input, output : a column's name, or its position from 1
    """

    time: str | PositiveInt | None = None
    input: str | PositiveInt | None = None
    output: str | PositiveInt | None = None
    rate: float | None = None
    delimiter: str | None = None
    decimal: str | None = None
    sheet: str | None = None

    @property
    def layout(self) -> Layout:
        columns = {role: None if (one := getattr(self, role)) is None else str(one) for role in ROLES}
        return Layout(**columns, rate=self.rate, delimiter=self.delimiter, decimal=self.decimal, sheet=self.sheet)

    @model_validator(mode="after")
    def readable(self) -> LayoutSpec:
        try:
            _ = self.layout
        except UserError as error:
            raise ValueError(" ".join(error.faults).removesuffix(".")) from None
        return self


class ProblemSpec(Strict):
    """One problem: where the data come from, what is fitted, and in which box.

    layout : how the data files are read, where they do not say it
    fitted, held_out : experiments of the rig, or names of records (of the data: all where none is named)
    box : "data" derives it from the ranges of the fitted records, as `fit` does, and is the default on data files;
        "model" is the model's own, and the default on a rig
    bounds : replaces the box, parameter by parameter
    fixed : parameters that are known: not searched
    profile : parameters whose profile likelihood the report shows
    instances : of the rig, where it is another number than the study's
    ranges : of rig settings that are drawn in every instance but the first, beside those that the rig declares
    optimizers : labels of those that run on this problem; all where none is named
    most_trials : of every optimizer on every instance, whatever the study asks for: where a trial takes minutes
    """

    name: str
    model: str
    settings: dict[str, Any] = {}
    effects: list[str] = []
    rig: str | None = None
    rig_settings: dict[str, Any] = {}
    data: list[str] = []
    layout: LayoutSpec | None = None
    fitted: list[str] = []
    held_out: list[str] = []
    scaling: Scaling | None = None
    loss: str = "rmse"
    box: Literal["model", "data"] = "model"
    bounds: dict[str, Ends] = {}
    fixed: dict[str, float] = {}
    profile: list[str] = []
    instances: PositiveInt | None = None
    ranges: dict[str, Ends] = {}
    optimizers: list[str] = []
    most_trials: PositiveInt | None = None
    skip: Seconds | None = None
    settle: bool = False

    @model_validator(mode="before")
    @classmethod
    def box_of_the_source(cls, raw: Any) -> Any:
        if isinstance(raw, dict) and "box" not in raw:
            return {**raw, "box": "data" if raw.get("data") else "model"}
        return raw

    @model_validator(mode="after")
    def one_source(self) -> ProblemSpec:
        if (self.rig is None) == (not self.data):
            raise ValueError('name either a rig = "..." or data = ["a.csv"], not both or none')
        if self.rig and not self.fitted:
            raise ValueError('fitted = ["..."] must name at least one experiment of the rig')
        if self.rig and self.layout:
            raise ValueError("layout says how data files are read; a rig has none")
        return self


class StageSpec(Strict):
    """The linear section behind a static one, fitted after a problem has found the static one.

    after : the problem; its rig or data are the stage's too
    optimizers : labels whose best trial is taken further; the best trial of all is added
    model, settings : the whole; what it does not share with `fit` is held at what the trial found
    fit : gain, damping and stiffness of the linear section, by the model's names and in its order
    fitted, check : experiments or records to fit and to check the whole model on
    beside : a problem that finds all parameters at once, for comparison
    control : labels whose staged model is put to work in closed loop on the problem's rig
    controllers : that are run for every trial of these; for the best trial all of them are
    """

    name: str
    after: str
    optimizers: list[str] = []
    model: str
    settings: dict[str, Any] = {}
    fit: tuple[str, str, str] = Field(strict=False)
    fitted: list[str] = Field(min_length=1)
    check: list[str] = []
    beside: str | None = None
    control: list[str] = []
    controllers: list[str] = []


class ClosingSpec(Strict):
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


class Study(Strict):
    """A checked study. `reference` is the optimizer that the others are compared with; `instances` are those of every
    problem on a rig, and `trials` those of every optimizer on each."""

    title: str
    seed: int
    instances: PositiveInt = 1
    trials: PositiveInt = 3
    budget: PositiveInt = 15050
    timeout: Seconds = 600.0
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

    def instances_of(self, spec: ProblemSpec) -> int:
        return (spec.instances or self.instances) if spec.rig else 1

    def trials_of(self, spec: ProblemSpec, asked: int) -> int:
        """Of those asked for, of every optimizer on every instance."""
        return min(asked, spec.most_trials or asked)

    def identity(self) -> dict[str, Any]:
        """What makes it the same study: all but the instances, the trials, the optimizers, and what follows them."""
        more: dict[str, Any] = dict.fromkeys(("instances", "trials", "optimizer", "stage", "closing"), True)
        found = self.model_dump(mode="json", exclude=more | {"problem": {"__all__": AS_MANY}})
        for problem in found["problem"]:
            if not problem["ranges"]:
                del problem["ranges"]
        return found


def read_study(path: Path) -> tuple[Study, str]:
    """A study and its text. Raises UserError telling every fault of the file."""
    raw, text = read_toml(path)
    return check_study(raw, str(path)), text


def check_study(raw: dict[str, Any], where: str) -> Study:
    """A study from parsed TOML. Raises UserError telling every fault, of form and of content."""
    study, sound, faults = validated(Study, raw)
    faults += [shown(fault) for fault in content_faults(sound)]
    if study is None or faults:
        raise UserError(where, faults)
    return study
