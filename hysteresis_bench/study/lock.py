"""One writer a results folder, and files that are whole or not there."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hysteresis_bench.errors import UserError

LOCK, PART = ".lock", ".part"


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Hold the folder's lock, which goes with the process, however it ends.

    Raises UserError where another run holds it, or where the platform has no such locks.
    """
    try:
        import fcntl
    except ImportError:
        raise UserError(
            str(folder),
            "cannot be locked against a second run: this platform has no fcntl. Run studies on Linux, macOS or WSL.",
        ) from None
    with (folder / LOCK).open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UserError(str(folder), "another run is writing to this folder; wait for it.") from None
        yield


def write_whole(path: Path, content: str) -> None:
    """Write a file beside, then put it in its place: a kill leaves the old one or the new one."""
    beside = path.with_name(f"{path.name}{PART}")
    beside.write_text(content, encoding="utf-8")
    os.replace(beside, path)
