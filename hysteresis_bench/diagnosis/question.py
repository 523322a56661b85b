"""What is asked of a diagnosis, beside the data."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.contracts import Model
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.checks.asked import around_faults, asked_faults, parameter_faults
from hysteresis_bench.fit.checks.faulty_records import still
from hysteresis_bench.fit.checks.wanted_units import in_wanted_units
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.fit.settling import open_loops
from hysteresis_bench.progress import Kept, OnStep, quiet
from hysteresis_bench.signals import Dataset, Record

FEWEST_SAMPLES = 40
"""Scored samples below which a fitted record tells too little of its noise to be diagnosed."""


@dataclass(frozen=True)
class DiagnosisOptions:
    """How a diagnosis is made.

    seed : of all searches;  jobs : processes; default: as many as cores, at most 4
    input_offset, flip : the model sees (input - input_offset), times -1 with flip
    skip : seconds at the start of every record that are simulated and not scored
    settle : closed loops are repeated until they close before they are scored; None: where the fitted records say so
    laws : models among which the law is sought where none is named, all registered ones where empty
    accept_terms : add what describes the remaining residual to the model, as an effect that explains nothing
    on_step : called with where the diagnosis is
    kept : fits of an earlier run that was stopped, which are not made again; every new one is given to it
    """

    seed: int = 0
    jobs: int | None = None
    input_offset: float = 0.0
    flip: bool = False
    skip: float = 0.0
    settle: bool | None = None
    accept_terms: bool = False
    laws: Sequence[str] = ()
    on_step: OnStep = field(default=quiet, compare=False, repr=False)
    kept: Kept | None = field(default=None, compare=False, repr=False)

    @property
    def processes(self) -> int:
        """That work side by side."""
        return self.jobs or min(4, os.cpu_count() or 1)


@dataclass(frozen=True)
class Question:
    """What does this model lack on the fitted records? Or, where no model is named, which law do they follow?

    model, settings : a registered model, "" where the law is sought among `options.laws`
    effects : known to act, around the model from the beginning
    bounds : replaces parts of the box that follows from the records;  fixed : parameters that are known
    among : effects that are in question; None: all
    """

    model: str
    effects: Sequence[str] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)
    options: DiagnosisOptions = DiagnosisOptions()
    among: Sequence[str] | None = None

    @property
    def preparation(self) -> Preparation:
        """What is done to every record before the model sees it; how often a loop is passed is found out later."""
        return Preparation(self.options.input_offset, self.options.flip, self.options.skip)

    @property
    def built(self) -> Model:
        """Raises ValueError where there is no such model, or not with these settings."""
        model: Model = registry.build("models", self.model, self.settings)
        return model

    def in_wanted_units(self, dataset: Dataset) -> Dataset:
        """The records in the units that the model, the effects around it, and those in question want.

        What is only in question is left to tell that it does not apply. Raises UserError."""
        if asked_faults(self.model, self.settings, self.effects) if self.model else around_faults("", self.effects):
            return dataset  # `check` tells them
        for name in registry.usable("effects"):
            if name not in self.effects:
                with suppress(UserError):
                    dataset = in_wanted_units(dataset, [registry.effect(name)], f"{name}'s")
        around = [registry.effect(name) for name in self.effects]
        return in_wanted_units(dataset, [self.built, *around] if self.model else around, "the model's")

    def check(self, dataset: Dataset) -> None:
        """Raises UserError telling every fault of the question and of the records at once; dataset : as measured."""
        if faults := self.preparation.faults(dataset.records):
            raise UserError("diagnose", faults)
        dataset = dataset.map(self.preparation.skipped)
        faults = asked_faults(self.model, self.settings, self.effects)
        if not faults:
            faults += parameter_faults(self.built, self.bounds, self.fixed)
            known = registry.build_effects(self.built, self.effects)
            reasons = {name: effect.inapplicable(dataset.records) for name, effect in known}
            faults += [f"effect {name}: {reason}" for name, reason in reasons.items() if reason]
        faults += open_loops(dataset.records) if self.options.settle else []
        faults += record_faults(dataset.fitted, "diagnose")
        if faults:
            raise UserError("diagnose", faults)


def record_faults(records: Sequence[Record], purpose: str) -> list[str]:
    """A sentence on every record that tells too little; purpose : a verb, what nothing is left to do with it."""
    faults = []
    for record in records:
        if words := still(record, purpose):
            faults.append(words)
        elif record.measured.size < FEWEST_SAMPLES:
            faults.append(
                f"record {record.name}: {record.measured.size} samples are too few; {FEWEST_SAMPLES} are needed."
            )
    return faults
