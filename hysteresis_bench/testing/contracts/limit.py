"""A limit on the seconds that a promise takes, in which the compilation of kernels does not count.

Compiled code hears no signal that Python would answer. So a second timer runs beside the first: of the processor's
time, with a signal that Python leaves to the system, which ends the process.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from numba.core.event import Listener, install_listener

AGAIN = 1.0
"""Seconds after which a plugin that caught the end of its time is told again."""
GRACE = 2.0
"""Seconds of the processor beyond the limit after which the process is ended."""


class Overrun(BaseException):
    """The time of what runs is over."""


class Compiling(Listener):
    """How long kernels have been compiled, or loaded, until now; those compiled for another count once.

    Meanwhile the timer of the processor's time rests.
    """

    def __init__(self) -> None:
        self._depth, self._since, self._before, self._left = 0, 0.0, 0.0, 0.0

    def on_start(self, event: Any) -> None:
        if self._depth == 0:
            self._since = time.monotonic()
            self._left, _ = signal.setitimer(signal.ITIMER_PROF, 0.0)
        self._depth += 1

    def on_end(self, event: Any) -> None:
        self._depth -= 1
        if self._depth == 0:
            self._before += time.monotonic() - self._since
            signal.setitimer(signal.ITIMER_PROF, self._left)

    @property
    def seconds(self) -> float:
        return self._before + (time.monotonic() - self._since if self._depth else 0.0)


@contextmanager
def within(limit: float) -> Iterator[None]:
    """Raises Overrun in what runs inside once it has taken `limit` seconds beside compilation. In the main thread.

    Where that is not heard, as in compiled code, SIGPROF ends the process once its processor was busy for GRACE more.
    """
    begun, compiling = time.monotonic(), Compiling()

    def late(number: int, frame: FrameType | None) -> None:
        left = limit - (time.monotonic() - begun - compiling.seconds)
        signal.setitimer(signal.ITIMER_REAL, max(left, AGAIN))
        if left <= 0.0:
            raise Overrun

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, limit)
    signal.setitimer(signal.ITIMER_PROF, limit + GRACE)
    try:
        with install_listener("numba:compile", compiling):
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
