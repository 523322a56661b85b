"""What every rig promises: the experiments that it declares, records with units, data that repeat."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig, SteppedRig
from hysteresis_bench.signals import Dataset, Record
from hysteresis_bench.testing.contract import Broken, expect
from hysteresis_bench.testing.plugin import PluginContract

DRIVEN = 400
"""Samples of a drive."""

RATE = 1000.0
"""Samples a second at which a stepped rig is driven."""


class RigContract(PluginContract):
    """Subclass it in a test file and name the plugin: `plugin = "my-rig"`."""

    kind = "rigs"

    def use(self, built: Any) -> Sequence[Array]:
        first = next(iter(built.experiments))
        records = built.measure(first, np.random.default_rng(7)).records
        return [array for record in records for array in (record.time, record.input, record.measured)]

    def test_its_experiments_are_declared(self, plugin: str) -> None:
        """It declares experiments, each with a line that says what is measured."""
        experiments = self.build(plugin).experiments
        expect(isinstance(experiments, Mapping) and experiments, "it declares no experiment.")
        silent = [name for name, line in experiments.items() if not (isinstance(line, str) and line.strip())]
        expect(not silent, f"nothing says what is measured in {', '.join(map(repr, silent))}.")

    def test_every_experiment_measures(self, plugin: str) -> None:
        """Every experiment gives records of finite numbers, a time that increases, and a unit of every column; the
        same data again, to the last bit, where the generator is the same."""
        built = self.build(plugin)
        for experiment in built.experiments:
            dataset, again = (built.measure(experiment, np.random.default_rng(11)) for _ in range(2))
            expect(isinstance(dataset, Dataset) and dataset.records, f"{experiment} gives no Dataset with records.")
            for record, other in zip(dataset.records, again.records, strict=True):
                faults = _record_faults(record)
                expect(not faults, f"{experiment}: {' '.join(faults)}")
                same = np.array_equal(record.input, other.input) and np.array_equal(record.measured, other.measured)
                expect(same, f"{experiment} gives other data with the same generator; draw all noise from `rng`.")
            expect(len(set(dataset.names)) == len(dataset.names), f"{experiment}: two records share a name.")
            expect(isinstance(dataset.hidden, Mapping), f"{experiment}: `hidden` is no mapping of names.")

    def test_its_ranges_make_rigs(self, plugin: str) -> None:
        """Every constant that differs between instances is a number among its settings, lies in its range as it
        stands, and makes a rig at either end."""
        built = self.build(plugin)
        for name, found in built.ranges.items():
            stands = getattr(built, name, None)
            expect(isinstance(stands, float), f"ranges names {name!r}, which is no setting that is a number.")
            inside = found.lower <= stands <= found.upper and found.lower < found.upper
            expect(inside, f"{name} = {stands} is not within its range, {found.lower} to {found.upper}.")
            for end in (found.lower, found.upper):
                faults = registry.faults("rigs", plugin, {name: end})
                expect(not faults, f"{name} = {end} makes no rig: {' '.join(faults)}")

    def test_it_refuses_what_it_does_not_know(self, plugin: str) -> None:
        """An unknown experiment raises ValueError that names the known ones."""
        built = self.build(plugin)
        try:
            built.measure("no such experiment", np.random.default_rng(0))
        except ValueError as error:
            unnamed = [name for name in built.experiments if name not in str(error)]
            expect(not unnamed, f"of an unknown experiment it says {str(error)!r}, and does not name {unnamed[0:1]}.")
        except Exception as error:
            raise Broken(f"an unknown experiment raises {type(error).__name__}; ValueError is asked.") from error
        else:
            raise Broken("it measures an experiment that it does not declare; raise ValueError.")

    def test_it_can_be_stepped(self, plugin: str) -> None:
        """A rig that a controller can drive keeps no state of its own, and its limit and its noise are numbers."""
        built = self.build(plugin)
        if not isinstance(built, SteppedRig):
            return
        expect(0.0 < built.input_limit < np.inf, f"its input limit is {built.input_limit}.")
        expect(0.0 <= built.noise_floor < np.inf, f"its noise floor is {built.noise_floor}.")
        plant = built.plant(RATE)
        drive = 0.5 * built.input_limit * np.sin(np.linspace(0.0, 6.0, 40))
        paths = []
        for _ in range(2):
            state, path = plant.rest(), []
            for voltage in drive:
                plant.step(state, -float(voltage))  # a step that is not taken
                state = plant.step(state, float(voltage))
                path.append(plant.displacement(state))
            path.append(plant.read(state, np.random.default_rng(3)))
            paths.append(path)
        expect(np.all(np.isfinite(paths)), "driven sample by sample, its output is not finite.")
        expect(paths[0] == paths[1], "driven again, it answers otherwise: a step changes the state that it was given.")

    def test_it_plays_a_drive(self, plugin: str) -> None:
        """A rig that plays any drive tells its units, and gives a sound record of its name; the same again where
        the generator is the same."""
        built = self.build(plugin)
        if not isinstance(built, DrivenRig):
            return
        (known,) = built.measure(next(iter(built.experiments)), np.random.default_rng(7)).records
        untold = [name for name in ("time", "input", "output") if name not in built.units]
        expect(not untold, f"its units do not tell that of {', '.join(untold)}.")
        time = np.linspace(0.0, float(np.ptp(known.time)), DRIVEN)
        swing = np.sin(np.linspace(0.0, 2.0 * np.pi, DRIVEN))
        u = 0.5 * (known.input.min() + known.input.max()) + 0.5 * np.ptp(known.input) * swing
        drive = Record(time, u, None, "a drive", built.units)
        (record,), (again,) = (built.play(drive, np.random.default_rng(3)).records for _ in range(2))
        faults = [] if record.name == drive.name else [f"its record is called {record.name!r}."]
        faults += _record_faults(record)
        expect(not faults, f"of a drive: {' '.join(faults)}")
        same = np.array_equal(record.measured, again.measured)
        expect(same, "a drive gives other data with the same generator; draw all noise from `rng`.")


def _record_faults(record: Record) -> list[str]:
    """What is wrong with a record, a sentence each."""
    if record.output is None:
        return [f"record {record.name} has no output."]
    columns = {"time": record.time, "input": record.input, "output": record.output, **record.columns}
    faults = []
    for name, values in columns.items():
        if np.shape(values) != np.shape(record.time) or np.ndim(values) != 1:
            faults.append(f"{name} is {np.shape(values)} and time {np.shape(record.time)}; both are (samples,).")
        elif not np.all(np.isfinite(values)):
            faults.append(f"{name} is not finite.")
        if not str(record.units.get(name, "")).strip():
            faults.append(f"{name} has no unit.")
    if not faults and not np.all(np.diff(record.time) > 0.0):
        faults.append("time does not increase strictly.")
    if not faults and np.ptp(record.input) == 0.0:
        faults.append("the input never moves.")
    return faults
