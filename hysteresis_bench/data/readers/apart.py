"""Reading in a process of its own: a damaged file may end the process in a compiled reader, or keep it for ever."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeVar

from hysteresis_bench.errors import UserError

Content = TypeVar("Content")

LONGEST_READ = 300.0
"""Seconds that a file may take."""


def read_apart(read: Callable[[], Content], path: Path, kind: str) -> Content:
    """What `read` returns, or raises; where processes cannot be forked it is called here.

    kind : of the file, as a message names it
    Raises UserError where it ends its process, or does not come to an end.
    """
    may_fork = "fork" in multiprocessing.get_all_start_methods() and not multiprocessing.current_process().daemon
    if not may_fork:
        return read()
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_read_and_send, args=(read, sender), daemon=True)
    process.start()
    sender.close()
    try:
        if not receiver.poll(LONGEST_READ):
            raise UserError(str(path), f"cannot be read as {kind}: reading it does not come to an end.")
        answer, error = receiver.recv()
    except EOFError:
        raise UserError(str(path), f"cannot be read as {kind}: it is damaged, and ends the reader.") from None
    finally:
        process.kill()
        process.join()
        receiver.close()
    if error is not None:
        raise error
    content: Content = answer
    return content


def _read_and_send(read: Callable[[], Any], sender: Connection) -> None:
    try:
        sender.send((read(), None))
    except Exception as error:  # whatever it is, the other side raises it
        sender.send((None, error))
