"""From a problem's specification to the problem itself: data, system, box."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Rig
from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.layout import AS_THEY_SAY
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.fit.checks.wanted_units import in_wanted_units
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.fit.seeds import generator
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Dataset, joined
from hysteresis_bench.study.instances import drawn_constants, instance_key
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.study_file import ProblemSpec, Study

SETTLING_REPEATS = 3
"""Repeats of a closed loop before it is scored."""


@dataclass(frozen=True, eq=False)
class Built:
    """A problem ready to be searched, and the data set it came from."""

    problem: Problem
    dataset: Dataset


def build_problem(spec: ProblemSpec, seed: int, folder: Path, instance: int = FIRST) -> Built:
    """folder : where relative data files are looked for. Raises UserError for what the data make impossible."""
    dataset = dataset_of(spec, seed, folder, instance)
    system = build_system(spec.model, spec.settings, effects=spec.effects, fixed=spec.fixed)
    dataset = in_wanted_units(dataset, system.parts, "the model's")
    faults = inapplicable(system, dataset) + [f"fixed {reason}" for reason in system.refusals()]
    boxes = system.box(dataset.fitted) if spec.box == "data" else system.parameters
    parameters, more = boxed(boxes, spec)
    if faults + more:
        raise UserError(f'problem "{spec.name}"', faults + more)
    return Built(Problem(system, dataset.fitted, Space(parameters), LOSSES[spec.loss]), dataset)


def dataset_of(spec: ProblemSpec, seed: int, folder: Path, instance: int = FIRST) -> Dataset:
    """What is fitted and what is held out, as the problem prepares it. Raises UserError where nothing is left,
    ValueError where the constants of an instance make no rig."""
    dataset = _of_rig(spec, seed, instance) if spec.rig else _read(spec, folder)
    if spec.skip is not None:
        preparation = Preparation(skip=spec.skip)
        if faults := preparation.faults(dataset.records):
            raise UserError(f'problem "{spec.name}"', faults)
        dataset = dataset.map(preparation.skipped)
    if spec.settle:
        dataset = dataset.map(lambda record: record.settled(SETTLING_REPEATS))
    return dataset


def closing_dataset(study: Study, folder: Path) -> Dataset:
    """What the diagnosis of a study gets to see, and what it does not: `hidden`. Raises UserError for an unknown
    record, ValueError where the study does not ask for a diagnosis."""
    if study.closing is None:
        raise ValueError("the study has no table [closing]")
    after = study.closing.after or study.problem[0].name
    spec = next(spec for spec in study.problem if spec.name == after)
    changed = {"name": "closing", "fitted": study.closing.fitted, "held_out": study.closing.held_out}
    return dataset_of(spec.model_copy(update=changed), study.seed, folder)


def build_system(
    model: str,
    settings: Mapping[str, Any] | None = None,
    *,
    effects: Sequence[str] = (),
    fixed: Mapping[str, float] | None = None,
) -> System:
    """A registered model with registered effects around it, innermost first."""
    built = registry.build("models", model, settings)
    return System(built, registry.build_effects(built, effects), fixed or {})


def inapplicable(system: System, dataset: Dataset) -> list[str]:
    """Why effects of the system cannot be fitted to the data, a sentence each."""
    reasons = [(name, effect.inapplicable(dataset.fitted)) for name, effect in system.effects]
    return [f"effect {name}: {reason}" for name, reason in reasons if reason]


def boxed(boxes: Sequence[Parameter], spec: ProblemSpec) -> tuple[tuple[Parameter, ...], list[str]]:
    """The parameters in the specification's box, and what is wrong with it."""
    names = [parameter.name for parameter in boxes]
    faults = [f'bounds: no parameter "{name}". {nearest(name, names)}' for name in spec.bounds if name not in names]
    parameters = []
    for parameter in boxes:
        lower, upper = spec.bounds.get(parameter.name, (parameter.lower, parameter.upper))
        parameters.append(parameter.bounded(lower, upper, spec.scaling))
        faults += parameters[-1].faults()
    return tuple(parameters), faults


def measure(rig: Rig, experiments: Sequence[str], *key: object) -> Dataset:
    """Experiments on a rig; the random numbers of each depend on the key and on its name alone."""
    return joined(*(rig.measure(name, generator(*key, name)) for name in experiments))


def _of_rig(spec: ProblemSpec, seed: int, instance: int) -> Dataset:
    assert spec.rig is not None
    rig = registry.build("rigs", spec.rig, {**spec.rig_settings, **drawn_constants(spec, seed, instance)})
    key = (seed, spec.rig, *instance_key(instance))
    fitted, held_out = (measure(rig, names, *key) for names in (spec.fitted, spec.held_out))
    return joined(fitted, held_out).split(held_out.names)


def _read(spec: ProblemSpec, folder: Path) -> Dataset:
    try:
        layout = spec.layout.layout if spec.layout else AS_THEY_SAY
        dataset = read_data([folder / file for file in spec.data], layout=layout)
    except UserError as error:
        if not any(" --" in fault for fault in error.faults):
            raise
        told = 'In a study, what an option says stands in the problem: layout = { input = "NAME", decimal = "," }.'
        raise UserError(error.where, [*error.faults, told]) from None
    wanted = [*(spec.fitted or [name for name in dataset.names if name not in spec.held_out]), *spec.held_out]
    unknown = [name for name in wanted if name not in dataset.names]
    if unknown:
        where, files = f'problem "{spec.name}"', spec.data[0] if len(spec.data) == 1 else "the data files"
        raise UserError(where, [f'no record "{name}" in {files}. {nearest(name, dataset.names)}' for name in unknown])
    records = tuple(record for record in dataset.records if record.name in wanted)
    return replace(dataset, records=records).split(spec.held_out)
