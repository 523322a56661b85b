"""Work for a pool: tickets that behave, and tickets that do what no plugin should."""

import os
import threading
import time
from dataclasses import dataclass
from functools import partial

import numpy as np

from tests.torture_distribution.misbehaviour import BAD

GOOD = "good"


@dataclass(frozen=True)
class Done:
    """How a ticket ended, in which process, and what it found of others there."""

    process: int
    found: str = ""
    status: str = "done"
    reason: str = ""


def _fork_twice():
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            time.sleep(1000)
        os._exit(0)
    time.sleep(0.1)


def _leave_state():
    np.random.seed(1)  # noqa: NPY002
    np.seterr(all="raise")
    np.sqrt = None
    threading.Thread(target=time.sleep, args=[1000]).start()


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
