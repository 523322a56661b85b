"""Work for a pool: tickets that behave, and tickets that do what no plugin should."""

import ctypes
import os
import signal
import sys
import threading
import time
from dataclasses import dataclass
from functools import partial

import numpy as np

GOOD = "good"


@dataclass(frozen=True)
class Done:
    """How a ticket ended, in which process, and what it found of others there."""

    process: int
    found: str = ""
    status: str = "done"
    reason: str = ""


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


def _fork_twice():
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            time.sleep(1000)
        os._exit(0)
    time.sleep(0.1)


def _close_everything():
    os.closerange(0, 4096)
    time.sleep(1000)


def _write_junk():
    for descriptor in range(3, 32):
        try:
            os.write(descriptor, b"\xff" * 64)
        except OSError:
            continue


def _leave_state():
    np.random.seed(1)  # noqa: NPY002
    np.seterr(all="raise")
    np.sqrt = None
    threading.Thread(target=time.sleep, args=[1000]).start()


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
RUN = BAD | {"fork twice": _fork_twice, "leaves state": _leave_state, GOOD: lambda: None}


def run(ticket: str) -> Done:
    RUN[ticket]()
    state = f"{np.geterr()['over']} {np.sqrt is not None} {np.random.get_state()[1][0]}"  # noqa: NPY002
    return Done(os.getpid(), state)


def prepare(ticket: str):
    if ticket == "slow to prepare":
        time.sleep(2.0)
        return partial(run, GOOD)
    return partial(run, ticket)


def alone(ticket: str) -> bool:
    return ticket != GOOD
