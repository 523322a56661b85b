"""What no plugin should do to its process, and an optimizer that does it."""

import ctypes
import os
import signal
import sys
import time
from dataclasses import dataclass

from hysteresis_bench.contracts import Optimizer


class Wordless(Exception):
    """Raises when it is asked what happened."""

    def __str__(self):
        raise ValueError("never")


class Unpicklable(Exception):
    """Holds what no other process can get."""

    def __init__(self):
        super().__init__("held")
        self.held = lambda: None


def _raise(error: BaseException):
    raise error


def _segfault():
    ctypes.string_at(0)


def _hold_the_lock():
    ctypes.PyDLL(None).sleep(1000)


def _fork():
    if os.fork() == 0:
        time.sleep(1000)
    os._exit(3)


def _close_everything():
    os.closerange(0, 4096)
    time.sleep(1000)


def _write_junk():
    for descriptor in range(3, 32):
        try:
            os.write(descriptor, b"\xff" * 64)
        except OSError:
            continue


BAD = {
    "sys.exit": lambda: sys.exit(0),
    "keyboard interrupt": lambda: _raise(KeyboardInterrupt()),
    "generator exit": lambda: _raise(GeneratorExit()),
    "wordless": lambda: _raise(Wordless()),
    "unpicklable": lambda: _raise(Unpicklable()),
    "surrogate": lambda: _raise(ValueError("\udc80")),
    "long text": lambda: _raise(ValueError("x" * 50_000_000)),
    "os._exit": lambda: os._exit(0),
    "segmentation fault": _segfault,
    "abort": os.abort,
    "50 GB": lambda: bytearray(50 << 30),
    "killed": lambda: os.kill(os.getpid(), signal.SIGKILL),
    "lock held": _hold_the_lock,
    "fork": _fork,
    "closed descriptors": _close_everything,
    "junk": _write_junk,
}


EXPECTED = {
    "sys.exit": ("raised", "SystemExit: 0"),
    "keyboard interrupt": ("raised", "KeyboardInterrupt"),
    "generator exit": ("raised", "GeneratorExit"),
    "wordless": ("raised", "Wordless: it cannot be put into words"),
    "unpicklable": ("raised", "Unpicklable: held"),
    "surrogate": ("raised", "ValueError: \N{REPLACEMENT CHARACTER}"),
    "long text": ("raised", "ValueError: xxx"),
    "os._exit": ("crashed", "exit code 0"),
    "segmentation fault": ("crashed", "SIGSEGV"),
    "abort": ("crashed", "SIGABRT"),
    "50 GB": ("out-of-memory", "more memory than its share"),
    "killed": ("killed", "from outside by SIGKILL"),
    "lock held": ("timed-out", "stopped after"),
    "fork": ("crashed", "exit code 3"),
    "closed descriptors": ("crashed", "closed its connection"),
    "junk": ("crashed", "cannot be read"),
}
"""The status of each, and a part of the reason."""


@dataclass(frozen=True)
class Misbehaves(Optimizer):
    """Evaluates a little, then does what its setting says."""

    kind: str = "sys.exit"

    def search(self, objective, start, rng):
        objective.many(start(3))
        BAD[self.kind]()
