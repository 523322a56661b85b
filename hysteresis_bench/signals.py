"""Signals and records: what drives a model, what was measured, and how records form a data set."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.errors import UserError

UNITLESS: Mapping[str, str] = MappingProxyType({"time": "s", "input": "1", "output": "1"})
INDEX = "sample"
"""The unit of a time that is only an index."""

FEWEST_KNOTS = 16
"""Samples from which a spline is tried between them."""

SMOOTHER = 0.5
"""RMS error of a spline over that of straight lines, at samples left out, from which an input is smooth: noise alone
makes it 1.1, steps 1.0, a triangle 0.7, sines of 10 and 40 samples a period 0.07 and 0.003; noise of 0.5 % of a sine of
40 samples makes it 0.6. A quarter tells these alike; with one the triangle passes for smooth."""


def read_only(values: Array) -> Array:
    """The same numbers, side by side in memory, into which nobody can write: a plugin that tries gets the ValueError
    itself, and no kernel is compiled for every stride once more."""
    view = np.asarray(values, order="C").view()
    view.flags.writeable = False
    return view


@dataclass(frozen=True, eq=False)
class Signal:
    """An input over time, for one or for a swarm of simulations.

    time : (samples,) strictly increasing, s; an index where `timed` is False: rate effects do not apply
    input : (samples, 1) shared by the swarm, or (samples, swarm)
    columns : further measured columns by name, (samples,) each, such as temperature
    All arrays are read-only: the next simulation sees them too.
    """

    time: Array
    input: Array
    timed: bool = True
    columns: Mapping[str, Array] = field(default_factory=dict)
    _finer: dict[int, tuple[Array, Array]] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        _close(self, "time", "input")

    def finer(self, steps: int) -> tuple[Array, Array]:
        """Time (instants,) and input (instants, columns) in as many steps a sample, the input along a cubic spline;
        made once, for every simulation that this signal drives."""
        from scipy.interpolate import CubicSpline

        if steps == 1:
            return self.time, self.input
        if steps not in self._finer:
            last = self.time.size - 1
            time = np.interp(np.arange(last * steps + 1) / steps, np.arange(last + 1), self.time)
            self._finer[steps] = read_only(time), read_only(CubicSpline(self.time, self.input)(time))
        return self._finer[steps]

    def with_input(self, values: Array) -> Signal:
        """The same signal with another input, (samples, 1) or (samples, swarm)."""
        return replace(self, input=np.ascontiguousarray(values, dtype=float))


@dataclass(frozen=True, eq=False)
class Record:
    """One measurement; a model restarts at its first sample.

    time, input, output : (samples,); output is None where only a prediction is wanted
    units : of "time", "input", "output" and of any further column
    history : leading samples that are simulated but not scored
    steps : that are simulated from one sample to the next; the input between two samples is interpolated
    input_error : RMS by which the input may still be off after it was smoothed, its unit
    All arrays are read-only. Raises UserError where time does not strictly increase: a rate has no value there.
    """

    time: Array
    input: Array
    output: Array | None
    name: str = "record"
    units: Mapping[str, str] = field(default_factory=lambda: UNITLESS)
    columns: Mapping[str, Array] = field(default_factory=dict)
    history: int = 0
    steps: int = 1
    input_error: float = 0.0

    def __post_init__(self) -> None:
        _close(self, "time", "input", *(["output"] if self.output is not None else []))
        if not (np.all(np.diff(self.time) > 0.0) and np.all(np.isfinite(self.time))):
            raise UserError(f"record {self.name}", "its times must be finite and strictly increase.")

    @property
    def timed(self) -> bool:
        return self.units.get("time") != INDEX

    @cached_property
    def signal(self) -> Signal:
        """What drives a simulation: the samples, and `steps` - 1 instants between each two."""
        time, driven, columns = self.time, self.input, self.columns
        if self.steps > 1:
            last = self.time.size - 1
            time = np.interp(np.arange(self.steps * last + 1) / self.steps, np.arange(last + 1), self.time)
            driven = interpolated(self.time, self.input, time)
            columns = {name: np.interp(time, self.time, column) for name, column in self.columns.items()}
        return Signal(time, np.ascontiguousarray(driven[:, None]), self.timed, columns)

    def at_samples(self, simulated: Array) -> Array:
        """(samples, ...) of a simulation along `signal`."""
        return simulated[:: self.steps] if self.steps > 1 else simulated

    @property
    def scored(self) -> slice:
        return slice(self.history, None)

    @property
    def measured(self) -> Array:
        """The scored samples of the output. Raises ValueError where there is no output."""
        if self.output is None:
            raise ValueError(f"record {self.name} has no output")
        return self.output[self.scored]

    def take(self, samples: slice | Array, name: str | None = None) -> Record:
        """A part of the record, as a record of its own; its history is what it keeps of ours."""
        index = np.arange(self.time.size)[samples]
        return replace(
            self,
            time=self.time[index],
            input=self.input[index],
            output=None if self.output is None else self.output[index],
            columns={key: column[index] for key, column in self.columns.items()},
            history=int(np.count_nonzero(index < self.history)),
            name=name or self.name,
        )

    def skip(self, duration: float) -> Record:
        """Turn the first `duration` (in units of time) into history, if it is not yet: simulated, not scored."""
        return replace(self, history=max(self.history, int(np.searchsorted(self.time, self.time[0] + duration))))

    def settled(self, repeats: int) -> Record:
        """A closed loop preceded by `repeats` of itself as history, so that a model has closed its loop
        when it is scored. The time between the last sample and the repeated first one is the median step."""
        period = self.time[-1] - self.time[0] + float(np.median(np.diff(self.time)))
        copies = repeats + 1

        def tiled(values: Array) -> Array:
            return np.tile(values, copies)

        shift = np.repeat(np.arange(-repeats, 1) * period, self.time.size)
        return replace(
            self,
            time=tiled(self.time) + shift,
            input=tiled(self.input),
            output=None if self.output is None else tiled(self.output),
            columns={key: tiled(column) for key, column in self.columns.items()},
            history=repeats * self.time.size + self.history,
        )


def interpolated(time: Array, values: Array, at: Array) -> Array:
    """Values between samples: along a cubic spline where one through every other sample meets the samples that it left
    out at least twice as closely as straight lines do; along straight lines where the input has corners or noise.

    time, values : (samples,);  at : (instants,), within the time -> (instants,)
    """
    from scipy.interpolate import CubicSpline

    kept, left = slice(None, None, 2), slice(1, 2 * ((time.size - 1) // 2), 2)
    if time.size >= FEWEST_KNOTS:
        ways = CubicSpline(time[kept], values[kept])(time[left]), np.interp(time[left], time[kept], values[kept])
        smooth, straight = (float(np.sum((way - values[left]) ** 2)) for way in ways)
        if smooth < SMOOTHER**2 * straight:
            return np.asarray(CubicSpline(time, values)(at))
    return np.interp(at, time, values)


def _close(of: Signal | Record, *names: str) -> None:
    """Make the arrays of these names and the columns read-only."""
    for name in names:
        object.__setattr__(of, name, read_only(getattr(of, name)))
    columns = {name: read_only(column) for name, column in of.columns.items()}
    object.__setattr__(of, "columns", MappingProxyType(columns))


@dataclass(frozen=True, eq=False)
class Dataset:
    """Records, and which of them are fitted and which are held out (opened once, at the end).

    hidden : what a virtual rig hid in its data, by name; empty for measurements
    notes : what was done to the records when they were read or predicted, a sentence each
    understood : how each record was read, a row of a table each, by heading
    Raises UserError where two records share a name: by it they are held out.
    """

    records: tuple[Record, ...]
    held_out_names: tuple[str, ...] = ()
    hidden: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    understood: tuple[Mapping[str, str], ...] = ()

    def __post_init__(self) -> None:
        twice = sorted(repr(name) for name, count in Counter(self.names).items() if count > 1)
        if twice:
            raise UserError("records", f"names must differ, and several records are named {', '.join(twice)}.")

    @property
    def fitted(self) -> tuple[Record, ...]:
        return tuple(record for record in self.records if record.name not in self.held_out_names)

    @property
    def held_out(self) -> tuple[Record, ...]:
        return tuple(record for record in self.records if record.name in self.held_out_names)

    @property
    def units(self) -> Mapping[str, str]:
        return self.records[0].units

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(record.name for record in self.records)

    def role(self, record: Record) -> str:
        """What a record of it is for: fitted or held-out."""
        return "held-out" if record.name in self.held_out_names else "fitted"

    def split(self, held_out: Sequence[str]) -> Dataset:
        """The same records with these held out. Raises ValueError for unknown names."""
        unknown = [repr(name) for name in held_out if name not in self.names]
        if unknown:
            none = f"no record{'s' if len(unknown) > 1 else ''} {', '.join(unknown)}"
            raise ValueError(f"{none}; there are: {', '.join(self.names)}")
        return replace(self, held_out_names=tuple(held_out))

    def _repr_html_(self) -> str:
        """For a notebook: a row a record."""
        import pandas as pd

        rows = [
            {
                "record": record.name,
                "role": self.role(record),
                "samples": record.time.size,
                "history": record.history,
                "duration": float(record.time[-1] - record.time[0]),
                **{name: record.units.get(name, "1") for name in ("time", "input", "output")},
            }
            for record in self.records
        ]
        html: str = pd.DataFrame(rows).to_html(index=False, float_format="%.4g")
        return html

    def map(self, change: Any) -> Dataset:
        """The data set with every record changed by change(record) -> record."""
        return replace(self, records=tuple(change(record) for record in self.records))


def joined(*datasets: Dataset) -> Dataset:
    """All records of several data sets, in order. Raises UserError where two share a name."""
    records = tuple(record for dataset in datasets for record in dataset.records)
    hidden = {key: value for dataset in datasets for key, value in dataset.hidden.items()}
    held_out = tuple(name for dataset in datasets for name in dataset.held_out_names)
    notes = tuple(note for dataset in datasets for note in dataset.notes)
    return Dataset(records, held_out, hidden, notes, tuple(row for one in datasets for row in one.understood))
