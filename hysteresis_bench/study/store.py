"""The store: every finished trial and its trace in SQLite, one commit a trial, failures too."""

from __future__ import annotations

import io
import json
import sqlite3
import zipfile
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.kept_files.packed import unpacked
from hysteresis_bench.study.kept_files.trial_rows import FIRST, KEY, MEASURED, check_rows
from hysteresis_bench.study.origin import Trial

FILE = "trials.sqlite"

DAMAGED = (sqlite3.Error, ValueError, TypeError, AttributeError, OSError, KeyError, EOFError, zipfile.BadZipFile)
"""What a store that was cut or overwritten raises when it is read."""

COLUMNS = ("study", *KEY, "seed", "status", "reason", *MEASURED)
"""Columns of a table of trials; parameter.NAME columns follow."""

TRIALS = f"""trials (
    problem TEXT, optimizer TEXT, trial INTEGER, seed TEXT, status TEXT, reason TEXT,
    evaluations INTEGER, fitness REAL, rmse REAL, relative_rms REAL, max_error REAL,
    held_out_rmse REAL, seconds REAL, parameters TEXT, trace BLOB, origin TEXT, instance INTEGER DEFAULT {FIRST},
    PRIMARY KEY ({", ".join(KEY)}))"""


@dataclass(frozen=True)
class Outcome:
    """One finished trial. Absent numbers are None: a trial that failed has no fitness.

    instance : of the problem, counted from 1
    origin : the package versions and the processor it was made with, see provenance.origin; "" where nobody knows
    """

    problem: str
    optimizer: str
    trial: int
    seed: str
    status: str
    reason: str = ""
    evaluations: int | None = None
    fitness: float | None = None
    rmse: float | None = None
    relative_rms: float | None = None
    max_error: float | None = None
    held_out_rmse: float | None = None
    seconds: float | None = None
    parameters: dict[str, float] = field(default_factory=dict)
    trace: Trace | None = None
    origin: str = ""
    instance: int = FIRST

    @property
    def key(self) -> Trial:
        return self.problem, self.optimizer, self.instance, self.trial


class Store:
    """The trials of one results folder. A context manager; opened by one writer at a time."""

    def __init__(self, folder: Path) -> None:
        self._connection = sqlite3.connect(folder / FILE)
        self._connection.execute("PRAGMA journal_mode = WAL")
        # a kill loses nothing; a power cut may take the last trials, which are run again
        self._connection.execute("PRAGMA synchronous = NORMAL")
        self._connection.execute("CREATE TABLE IF NOT EXISTS study (title TEXT NOT NULL)")
        self._connection.execute(f"CREATE TABLE IF NOT EXISTS {TRIALS}")

    @classmethod
    def reading(cls, folder: Path) -> Store:
        """Opened to be read: nothing in the folder changes. Raises one of DAMAGED where it cannot be."""
        store = cls.__new__(cls)
        store._connection = sqlite3.connect(f"{(folder / FILE).resolve().as_uri()}?mode=ro", uri=True)
        return store

    def __enter__(self) -> Store:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._connection.close()

    def begin(self, title: str) -> None:
        """Name the study that the trials belong to. A store of an older version learns to keep origins and instances:
        its trials are of the first one."""
        with self._connection:
            self._connection.execute("BEGIN")
            if not {"origin", "instance"} <= (there := self._columns()):
                self._connection.execute("ALTER TABLE trials RENAME TO older")
                self._connection.execute(f"CREATE TABLE {TRIALS}")
                names = ", ".join(sorted(there))
                copied = f"INSERT INTO trials ({names}) SELECT {names} FROM older ORDER BY rowid"
                self._connection.execute(copied)
                self._connection.execute("DROP TABLE older")
            self._connection.execute("DELETE FROM study")
            self._connection.execute("INSERT INTO study VALUES (?)", (title,))

    def add(self, outcome: Outcome) -> None:
        """Write one trial; no kill takes it back when this returns. Raises sqlite3.IntegrityError if it is there."""
        self.extend([outcome])

    def extend(self, outcomes: Iterable[Outcome]) -> None:
        """Write trials, all of them or none."""
        rows = [
            (
                *(getattr(outcome, name) for name in COLUMNS[1:]),
                json.dumps(outcome.parameters),
                None if outcome.trace is None else _packed(outcome.trace),
                outcome.origin,
            )
            for outcome in outcomes
        ]
        names = (*COLUMNS[1:], "parameters", "trace", "origin")
        marks = ", ".join("?" * len(names))
        with self._connection:
            self._connection.executemany(f"INSERT INTO trials ({', '.join(names)}) VALUES ({marks})", rows)

    def keys(self) -> set[Trial]:
        """Of every trial that is there."""
        return set(self._connection.execute(f"SELECT {self._key()} FROM trials"))

    def forget(self, statuses: Collection[str]) -> int:
        """Take out the trials that ended so, and tell how many: they are missing then, and are run again."""
        marks = ", ".join("?" * len(statuses))
        with self._connection:
            return self._connection.execute(f"DELETE FROM trials WHERE status IN ({marks})", list(statuses)).rowcount

    def outcomes(self) -> Iterator[Outcome]:
        """Every trial as it was added."""
        origin = "origin" if "origin" in self._columns() else "''"
        names = [self._key(), *COLUMNS[1 + len(KEY) :], "parameters", "trace", origin]
        for row in self._connection.execute(f"SELECT {', '.join(names)} FROM trials"):
            *numbers, parameters, trace, made_by = row
            known = dict(zip(COLUMNS[1:], numbers, strict=True))
            trace = _unpacked(trace) if trace else None
            yield Outcome(**known, parameters=json.loads(parameters), trace=trace, origin=made_by or "")

    def origins(self) -> dict[Trial, Mapping[str, str]]:
        """What every trial was made with, see origin.origin, in the order they came; without those nobody knows it of.

        Raises ValueError for what no trial was made with.
        """
        if "origin" not in self._columns():
            return {}
        query = f"SELECT {self._key()}, origin FROM trials WHERE origin != '' ORDER BY rowid"
        found = {tuple(key): json.loads(text) for *key, text in self._connection.execute(query)}
        if not all(isinstance(made_with, dict) for made_with in found.values()):
            raise ValueError("an origin is no object")
        return found

    def _key(self) -> str:
        """KEY as columns; a store of an older version has the first instance of everything."""
        older = "instance" not in self._columns()
        return ", ".join(f"{FIRST} AS instance" if older and name == "instance" else name for name in KEY)

    def _columns(self) -> set[str]:
        return {row[1] for row in self._connection.execute("PRAGMA table_info(trials)")}

    def table(self) -> pd.DataFrame:
        """One row a trial: COLUMNS, then parameter.NAME; ordered by problem, optimizer, instance, trial.

        Raises ValueError for a row that no trial has left.
        """
        title = next(iter(self._connection.execute("SELECT title FROM study")), ("",))[0]
        columns = (self._key(), *COLUMNS[1 + len(KEY) :], "parameters")
        query = f"SELECT {', '.join(columns)} FROM trials ORDER BY {', '.join(KEY)}"
        frame = pd.read_sql_query(query, self._connection)
        parameters = [json.loads(text) for text in frame["parameters"]]
        names = list(dict.fromkeys(name for values in parameters for name in values))
        found: dict[str, Any] = {
            f"parameter.{name}": pd.array([values.get(name) for values in parameters], dtype="Float64")
            for name in names
        }
        frame.insert(0, "study", title)
        table = pd.concat([frame[list(COLUMNS)], pd.DataFrame(found, index=frame.index)], axis=1)
        check_rows(table)
        return table

    def traces(self) -> dict[Trial, Trace]:
        rows = self._connection.execute(f"SELECT {self._key()}, trace FROM trials WHERE trace NOT NULL")
        return {tuple(key): _unpacked(blob) for *key, blob in rows}


def _packed(trace: Trace) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, evaluations=trace.evaluations, losses=trace.losses, points=trace.points)
    return buffer.getvalue()


def _unpacked(blob: bytes) -> Trace:
    arrays = unpacked(blob)
    return Trace(arrays["evaluations"], arrays["losses"], arrays["points"])
