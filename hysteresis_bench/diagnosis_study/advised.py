"""The experiment that a diagnosis advises, carried out on a virtual rig, and the diagnosis after it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig
from hysteresis_bench.data.units import converted, same_unit
from hysteresis_bench.diagnosis.experiments.settled import Measured, Tied
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.preparation import with_held_out
from hysteresis_bench.diagnosis_study.study_file import no_drive
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.seeds import generator
from hysteresis_bench.signals import Dataset, Record, joined

QUANTITIES = ("time", "input", "output")

FOLLOWED = 0.01
"""Share of the drive's range by which what acted may differ from it (RMS) before that is told."""


@dataclass(frozen=True, eq=False)
class Bench:
    """A rig that plays drives.

    name : as it is told;  key : what its random numbers depend on, with the record's name
    """

    rig: DrivenRig
    name: str
    key: tuple[object, ...]

    def check(self, dataset: Dataset) -> None:
        """Raises UserError where the rig and the records have nothing in common, telling every fault."""
        if not all(record.timed for record in dataset.records):
            raise UserError("--measure", "the records have no time, and a rig plays its drive in time.")
        faults = [
            f"{name} is in {dataset.units.get(name, '1')} in the records and in {self.rig.units[name]} on the rig "
            f"{self.name}."
            for name in QUANTITIES
            if not self._convertible(dataset, name)
        ]
        if faults:
            raise UserError("--measure", faults)

    def record_name(self, dataset: Dataset) -> str:
        """Of the record that is measured: none that the data set has."""
        name = f"advised-{self.name}"
        names = (name, *(f"{name}-{number}" for number in range(2, len(dataset.records) + 3)))
        return next(one for one in names if one not in dataset.names)

    def played(self, dataset: Dataset, drive: Record) -> Record:
        """The drive's record, in the units of the data set."""
        units = {name: dataset.units.get(name, "1") for name in QUANTITIES}
        time, u = (_in(getattr(drive, name), units[name], self.rig.units[name]) for name in ("time", "input"))
        asked = replace(drive, name=self.record_name(dataset), units=self.rig.units, time=time, input=u)
        (record,) = self.rig.play(asked, generator(*self.key, asked.name)).records
        assert record.output is not None
        time, u, y = (_in(getattr(record, name), record.units[name], units[name]) for name in QUANTITIES)
        return replace(record, units={**record.units, **units}, time=time, input=u, output=y)

    def _convertible(self, dataset: Dataset, name: str) -> bool:
        try:
            _in(np.zeros(1), dataset.units.get(name, "1"), self.rig.units[name])
        except ValueError:
            return False
        return True


def driven_rig(name: str) -> DrivenRig:
    """A registered rig that plays any drive. Raises ValueError where it does not, or where there is none."""
    rig = registry.build("rigs", name)
    if isinstance(rig, DrivenRig):
        return rig
    raise ValueError(no_drive(name))


def nothing_to_measure(found: Diagnosis) -> str:
    """Why no experiment is worth carrying out, as a sentence, or nothing."""
    if not found.ties:
        return "There is no tie: nothing to settle, and nothing was measured."
    if found.advice is None:
        return "A tied effect needs a column beside the input, and no drive commands that: nothing was measured."
    return "" if found.advice.drive else "No experiment that can be played here tells them apart: nothing was measured."


def measured(dataset: Dataset, found: Diagnosis, bench: Bench, again: Callable[[Dataset], Diagnosis]) -> Diagnosis:
    """The diagnosis of the records with that of the advised experiment, which is fitted.

    dataset : what `found` was made of, as measured;  again : the same question, asked of more records
    """
    assert found.advice is not None
    assert found.advice.drive is not None
    record = bench.played(dataset, found.advice.drive)
    after = again(joined(with_held_out(dataset)[0], Dataset((record,))))
    told = Measured(
        bench.name,
        found.advice.experiment,
        record,
        found.headline,
        found.effects,
        ties_after(found, after),
        tuple(_oddities(dataset, found.advice.drive, record)),
    )
    return replace(after, measured=told)


def _oddities(dataset: Dataset, drive: Record, record: Record) -> Iterator[str]:
    """What the rig did not do as asked, and what its record lacks."""
    asked = np.interp(record.time, drive.time, drive.input)
    span = float(np.ptp(drive.input))
    missed = float(np.sqrt(np.mean((record.input - asked) ** 2)))
    if missed > FOLLOWED * span:
        yield (
            f"The rig could not follow the advised drive from {asked.min():.4g} to {asked.max():.4g}: it went from "
            f"{record.input.min():.4g} to {record.input.max():.4g}, off by {missed / span:.2g} of that range (RMS), "
            "and that is what the record has."
        )
    known = set.intersection(*(set(one.columns) for one in dataset.records))
    if lost := sorted(known - set(record.columns)):
        yield f"The rig's record has no column {', '.join(lost)}; effects of it can no longer be fitted."


def _in(values: Array, unit: str, wanted: str) -> Array:
    """Values in another unit; without a unit they are taken to be in it. Raises ValueError where none converts."""
    return values if "1" in (unit, wanted) or same_unit(unit, wanted) else converted(values, unit, wanted)


def ties_after(before: Diagnosis, after: Diagnosis) -> tuple[Tied, ...]:
    """The ties of one diagnosis, and what became of them in another one with more records."""
    return tuple(_ties(before, after))


def _ties(before: Diagnosis, after: Diagnosis) -> Iterator[Tied]:
    told = before.advice.probabilities if before.advice else {}
    still = {frozenset((tie.effect, tie.rival)) for tie in after.ties}
    for first in dict.fromkeys(tie.effect for tie in before.ties):
        rivals = [tie.rival for tie in before.ties if tie.effect == first]
        names = (first, *rivals)
        made = first == before.ties[0].effect and {*rivals} <= {*told}
        claimed = [name for name in names if name in after.effects]
        left = tuple((one, *(other for other in names if frozenset((one, other)) in still)) for one in claimed)
        yield Tied(names, min(told[rival] for rival in rivals) if made else None, left)
