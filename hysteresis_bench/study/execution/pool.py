"""Tickets, such as trials, on all cores: one that hangs is killed, one that crashes takes no other with it."""

from __future__ import annotations

import itertools
import selectors
import signal
import socket
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from types import TracebackType
from typing import Any, Generic, Protocol, TypeVar

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.execution.messages import Inbox, Unreadable, send
from hysteresis_bench.study.execution.template import Template, memory_of
from hysteresis_bench.study.execution.worker import BEGUN, Failure

PREPARATION = 600.0
"""Seconds for a ticket's imports, compilation and data, before its own time begins."""
PATIENCE = 1.0
"""Seconds for a worker that has closed its socket to end by itself."""
ATTEMPTS = 10
"""Templates that may end in a row without one becoming ready."""
OUTSIDE = (signal.SIGKILL, signal.SIGTERM)
"""Signals that no fault of a program's own raises."""
OWN_LIMIT = signal.SIGPROF
"""Ends a worker that has set itself a limit of the processor's time, and hangs in compiled code."""

MACHINE = ("killed", "out-of-memory", "not-started")
"""Statuses that say more of the machine than of the ticket: worth another try."""


class Finished(Protocol):
    """What a ticket that ran to its end says of itself."""

    @property
    def status(self) -> str: ...

    @property
    def reason(self) -> str: ...


T = TypeVar("T")
E = TypeVar("E", bound=Finished)
Ended = tuple[T, E | None, str, str]
"""ticket, outcome or None, status, reason"""


def at_once(run: Callable[[T], E]) -> Callable[[T], Callable[[], E]]:
    """A function of a ticket as work that needs no preparation."""
    return partial(partial, run)


def _never(ticket: object) -> bool:
    return False


@dataclass(frozen=True)
class Work(Generic[T, E]):
    """What is done with a ticket.

    prepare : prepare(ticket) -> what carries it out, both in a worker process;  limit : seconds for the latter
    warm : called once, before any ticket: what workers need and may share
    alone : whether a ticket needs a process of its own, as code of other distributions does
    """

    prepare: Callable[[T], Callable[[], E]]
    limit: float
    warm: Sequence[Callable[[], object]] = ()
    alone: Callable[[T], bool] = _never


@dataclass(eq=False)
class _Worker:
    """fate : why it is being ended, once it is;  deadline : of what it is doing, on time.monotonic
    forgotten : its socket is closed on this side"""

    number: int
    socket: socket.socket
    ticket: Any = None
    begun: bool = False
    deadline: float = 0.0
    fate: Failure | None = None
    forgotten: bool = False
    inbox: Inbox = field(init=False)

    def __post_init__(self) -> None:
        self.inbox = Inbox(self.socket)


class Pool(Generic[T, E]):
    """Workers for one kind of work. A context manager: none of them outlives it, nor this process."""

    def __init__(self, work: Work[T, E], jobs: int, memory: int | None = None) -> None:
        """jobs : tickets at a time;  memory : bytes that each may take, a share of the machine's where None"""
        self._work, self._jobs = work, jobs
        self._memory = memory or memory_of(jobs)
        self._numbers = itertools.count(1)
        self._idle: list[_Worker] = []
        self._busy: dict[int, _Worker] = {}
        self._ended: list[tuple[T, Any]] = []
        self._failed_templates = 0
        self._selector = selectors.DefaultSelector()
        self._open_template()

    def __enter__(self) -> Pool[T, E]:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        for worker in [*self._idle, *self._busy.values()]:
            worker.socket.close()
        self._template.close()
        self._selector.close()

    def run(self, tickets: Iterable[T]) -> Iterator[Ended[T, E]]:
        """Yields tickets as they end, in no order. Raises UserError where no worker can be started."""
        waiting = iter(tickets)
        while True:
            while len(self._busy) < self._jobs and (ticket := next(waiting, None)) is not None:
                self._begin(ticket)
            if not self._busy and not self._ended:
                return
            if not self._ended:
                self._wait()
            ended, self._ended = self._ended, []
            for ticket, answer in ended:
                yield ticket, None if isinstance(answer, Failure) else answer, answer.status, answer.reason

    def _begin(self, ticket: T) -> None:
        worker = self._fork() if self._work.alone(ticket) or not self._idle else self._idle.pop()
        worker.ticket, worker.begun = ticket, False
        worker.deadline = time.monotonic() + PREPARATION
        self._busy[worker.number] = worker
        with suppress(OSError):  # one that has just ended: its end is reported
            send(worker.socket, ticket)

    def _fork(self) -> _Worker:
        number = next(self._numbers)
        while True:
            try:
                worker = _Worker(number, self._template.fork(number))
                break
            except OSError:
                self._replace_template()
        self._selector.register(worker.socket, selectors.EVENT_READ, worker)
        return worker

    def _wait(self) -> None:
        """Take in what happens next."""
        until = min(worker.deadline for worker in self._busy.values())
        for key, _ in self._selector.select(min(max(0.0, until - time.monotonic()), PREPARATION)):
            self._hear_template() if key.data is None else self._hear(key.data)
        for worker in list(self._busy.values()):
            if worker.deadline <= time.monotonic():
                self._overdue(worker)

    def _hear(self, worker: _Worker) -> None:
        """Take in a worker's messages; one that has closed its socket is given time to end by itself."""
        if worker.inbox.closed or worker.forgotten:
            return
        try:
            messages = worker.inbox.read()
        except Unreadable:
            self._end(worker, Failure("crashed", "the worker process answered what cannot be read"))
            return
        for message in messages if worker.number in self._busy else ():
            if isinstance(message, str) and message == BEGUN:
                worker.begun, worker.deadline = True, time.monotonic() + self._work.limit
            else:
                self._answered(worker, message)
                return
        if worker.inbox.closed:
            self._selector.unregister(worker.socket)
            if worker.number in self._busy:
                worker.deadline = time.monotonic() + PATIENCE
            else:
                self._idle.remove(worker)
                worker.socket.close()

    def _answered(self, worker: _Worker, answer: Any) -> None:
        if self._work.alone(worker.ticket) or worker.inbox.closed or worker.fate:
            self._template.kill(worker.number)
            self._forget(worker, answer)
        else:
            del self._busy[worker.number]
            self._idle.append(worker)
            self._ended.append((worker.ticket, answer))

    def _overdue(self, worker: _Worker) -> None:
        if not self._template.ready:
            worker.deadline = time.monotonic() + PREPARATION  # its own preparation has not begun
        elif worker.inbox.closed:
            self._end(worker, Failure("crashed", "the worker process closed its connection to the study"))
        elif worker.begun:
            self._end(worker, Failure("timed-out", f"stopped after {self._work.limit:g} s"))
        else:
            self._end(worker, Failure("not-started", f"imports, compilation and data took over {PREPARATION:g} s"))

    def _end(self, worker: _Worker, fate: Failure) -> None:
        """Kill a worker; the template reports its end."""
        worker.fate = worker.fate or fate
        worker.deadline = float("inf")
        self._template.kill(worker.number)

    def _hear_template(self) -> None:
        for number, code in self._template.ended():
            if worker := self._busy.get(number):
                self._bury(worker, verdict(code))
        if self._template.gone:
            self._replace_template()

    def _bury(self, worker: _Worker, why: Failure) -> None:
        """What a worker that has ended leaves: its answer, where it had given one, else why it ended."""
        self._hear(worker)
        if worker.number in self._busy:
            self._forget(worker, worker.fate or why)

    def _forget(self, worker: _Worker, answer: Any) -> None:
        del self._busy[worker.number]
        self._ended.append((worker.ticket, answer))
        self._drop(worker)

    def _drop(self, worker: _Worker) -> None:
        with suppress(KeyError):  # one that has closed its socket is no longer listened to
            self._selector.unregister(worker.socket)
        worker.forgotten = True
        worker.socket.close()

    def _open_template(self) -> None:
        self._template = Template(self._work.prepare, self._work.warm, self._memory)
        self._selector.register(self._template.socket, selectors.EVENT_READ, None)

    def _replace_template(self) -> None:
        """After the template has ended, and its workers with it."""
        self._failed_templates = 0 if self._template.ready else self._failed_templates + 1
        self._selector.unregister(self._template.socket)
        code = self._template.close()
        for worker in list(self._busy.values()):
            self._bury(worker, Failure("killed", "the process that starts the workers was killed from outside"))
        for worker in self._idle:
            self._drop(worker)
        self._idle.clear()
        if self._failed_templates >= ATTEMPTS:
            raise UserError("workers", f"cannot be started: the process that starts them ends with exit code {code}.")
        self._open_template()


def verdict(code: int) -> Failure:
    """Why a worker ended that was not told to. code : as of subprocess, minus the signal"""
    if -code in OUTSIDE:
        return Failure("killed", f"killed from outside by {_named(-code)}, as the system does when memory runs out")
    if -code == OWN_LIMIT:
        return Failure("timed-out", "stopped, as it hangs in compiled code")
    if code < 0:
        return Failure("crashed", f"the worker process was ended by {_named(-code)}")
    return Failure("crashed", f"the worker process ended with exit code {code}")


def _named(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
