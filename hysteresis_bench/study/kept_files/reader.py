"""Files of a results folder, read as far as they can be: what is damaged is left out and said."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import pandas as pd

from hysteresis_bench.data.csv_files import read_table

Content = TypeVar("Content")

UNREADABLE = (OSError, UnicodeDecodeError, ValueError, RecursionError)
"""What reading raises: damaged CSV, JSON and TOML raise kinds of ValueError."""


@dataclass
class Reader:
    """damages : a sentence on every file that was there and could not be read."""

    folder: Path
    damages: list[str] = field(default_factory=list)

    def json(self, name: str, check: Callable[[Mapping[str, Any]], None] = lambda content: None) -> dict[str, Any]:
        """A JSON object; empty where there is none. check : raises ValueError for one that is not the right one"""
        return self._read(name, {}, lambda path: _table(json.loads(path.read_text(encoding="utf-8")), check))

    def toml(self, name: str) -> dict[str, Any]:
        return self._read(name, {}, lambda path: tomllib.loads(path.read_text(encoding="utf-8")))

    def csv(
        self, name: str, columns: Sequence[str] = (), check: Callable[[pd.DataFrame], None] = lambda table: None
    ) -> pd.DataFrame:
        """A table that has these columns; empty where there is none. check : raises ValueError for one that is none"""
        return self._read(name, pd.DataFrame(), lambda path: _whole(path, columns, check))

    def said(self, name: str, error: Exception | str) -> None:
        reason = " ".join(str(error).split())[:200]
        self.damages.append(f"{name} is damaged and left out ({reason}); run the study again to rebuild it.")

    def _read(self, name: str, absent: Content, read: Callable[[Path], Content]) -> Content:
        path = self.folder / name
        if not path.is_file():
            return absent
        try:
            return read(path)
        except UNREADABLE as error:
            self.said(name, error)
            return absent


def _table(content: Any, check: Callable[[Mapping[str, Any]], None]) -> dict[str, Any]:
    if not isinstance(content, dict):
        raise ValueError(f"a {type(content).__name__} where an object belongs")
    check(content)
    return content


def _whole(path: Path, columns: Sequence[str], check: Callable[[pd.DataFrame], None]) -> pd.DataFrame:
    if not path.read_bytes().endswith(b"\n"):
        raise ValueError("it ends in the middle of a line")
    frame = read_table(path)
    missing = [name for name in columns if name not in frame.columns]
    if missing and not (frame.empty and frame.columns.empty):
        raise ValueError(f"it has no column {missing[0]}")
    if not frame.empty:
        check(frame)
    return frame
