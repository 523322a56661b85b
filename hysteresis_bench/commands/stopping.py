"""What a command says when it is stopped: by Ctrl-C, or by SIGTERM as a batch system sends it."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import NoReturn

AGAIN = "Run it again to continue."


@contextmanager
def told_when_stopped(what: Path | str, kept: Callable[[], str], again: str = AGAIN) -> Iterator[None]:
    """Ends with a sentence and the exit code that a shell gives: 130, 143. kept : what is not lost, as a clause"""

    def stop(number: int, frame: FrameType | None) -> NoReturn:
        raise KeyboardInterrupt(number)

    before = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    except KeyboardInterrupt as stopped:
        by = signal.Signals(stopped.args[0]) if stopped.args else signal.SIGINT
        told = f"{what}: stopped by {by.name}; {kept()}. {again}"
        from hysteresis_bench.commands.terminal.console import terminal

        terminal(aside=True, soft_wrap=True).print(told, highlight=False, markup=False)
        sys.exit(128 + by)
    finally:
        signal.signal(signal.SIGTERM, before)
