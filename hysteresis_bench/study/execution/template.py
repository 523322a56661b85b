"""The template: a process that has imported and prepared what workers need, and of which they are forked copies.

A worker then starts in milliseconds, every one from the same state, so that a trial can have one of its own. The
template runs no ticket and no code of other distributions; it has one thread, and nothing that a fork could tear.
"""

from __future__ import annotations

import gc
import json
import os
import select
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress

from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.study.execution.lifetime import adopt_orphans, end_group, end_orphans, end_with
from hysteresis_bench.study.execution.messages import Inbox, receive, send
from hysteresis_bench.study.execution.worker import Prepare, work

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
REQUEST = struct.Struct("!cQ")
FORK, KILL = b"f", b"k"
READY = "ready"
PATIENCE = 10.0
"""Seconds in which a template ends that was told to."""

START = """import json, sys
sys.path[:] = json.loads(sys.argv[2])
from hysteresis_bench.study.execution.template import serve
serve(int(sys.argv[1]))"""


class Template:
    """The runner's end. Workers go by numbers, as a process id may be somebody else's by the time it is used."""

    def __init__(self, prepare: Prepare, warm: Sequence[Callable[[], object]], memory: int) -> None:
        """warm : called once in the template, faults and all;  memory : bytes that a worker may take"""
        self.socket, theirs = socket.socketpair()
        self._inbox = Inbox(self.socket)
        self.ready = False
        arguments = [sys.executable, "-c", START, str(theirs.fileno()), json.dumps(sys.path)]
        # one thread each, for speed and for the same sums on every machine
        environment = {**os.environ, **dict.fromkeys(ONE_THREAD, "1")}
        self._process = subprocess.Popen(
            arguments, pass_fds=[theirs.fileno()], env=environment, stdin=subprocess.DEVNULL, start_new_session=True
        )
        theirs.close()
        with suppress(OSError):  # one that ends at once is found gone
            send(self.socket, memory)
            send(self.socket, (prepare, list(warm)))

    def fork(self, number: int) -> socket.socket:
        """The socket to a new worker of this number. Raises OSError where the template has ended."""
        ours, theirs = socket.socketpair()
        with theirs:
            socket.send_fds(self.socket, [REQUEST.pack(FORK, number)], [theirs.fileno()])
        return ours

    def kill(self, worker: int) -> None:
        """End a worker and all that it has started; nothing happens where it has ended."""
        with suppress(OSError):
            self.socket.sendall(REQUEST.pack(KILL, worker))

    def ended(self) -> list[tuple[int, int]]:
        """(number, exit code) of the workers that have ended since it was asked last."""
        reports = self._inbox.read()
        self.ready = self.ready or READY in reports
        return [report for report in reports if report != READY]

    @property
    def gone(self) -> bool:
        return self._inbox.closed

    def close(self) -> int:
        """End the template and its workers; returns its exit code."""
        self.socket.close()
        try:
            return self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()


def serve(descriptor: int) -> None:
    """The process itself: prepare, then fork and kill as asked until the runner is gone, however it went."""
    import resource

    control = socket.socket(fileno=descriptor)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    adopt_orphans()
    try:
        memory = receive(control)
        prepare, warm = receive(control)
    except EOFError:
        return
    resource.setrlimit(resource.RLIMIT_DATA, (memory, resource.getrlimit(resource.RLIMIT_DATA)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
    with economical():
        for step in warm:
            with suppress(Exception):  # the ticket that needs it will tell
                step()
        gc.freeze()
        with suppress(EOFError, OSError):
            send(control, READY)
            _Forks(control, prepare).serve()


class _Forks:
    """The workers of this process."""

    def __init__(self, control: socket.socket, prepare: Prepare) -> None:
        self._control = control
        self._prepare = prepare
        self._workers: dict[int, int] = {}  # number: process
        self._woken, self._wake = socket.socketpair()
        for end in (self._woken, self._wake):
            end.setblocking(False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(self._wake.fileno(), warn_on_full_buffer=False)

    def serve(self) -> None:
        """Raises EOFError or OSError once the runner is gone; no worker is left by then."""
        try:
            while True:
                ready, _, _ = select.select([self._control, self._woken], [], [])
                if self._woken in ready:
                    self._woken.recv(4096)
                    self._bury()
                if self._control in ready:
                    self._obey()
        finally:
            for process in self._workers.values():
                end_group(process)
                os.waitpid(process, 0)
            end_orphans(())

    def _obey(self) -> None:
        request, descriptors, _, _ = socket.recv_fds(self._control, REQUEST.size, 1)
        if len(request) < REQUEST.size:
            raise EOFError
        what, number = REQUEST.unpack(request)
        if what == FORK:
            self._fork(number, descriptors[0])
        elif number in self._workers:
            end_group(self._workers[number])

    def _fork(self, number: int, descriptor: int) -> None:
        template = os.getpid()
        process = os.fork()
        if process == 0:
            try:
                self._become_worker(template, descriptor)
            finally:
                os._exit(0)
        with suppress(OSError):  # the worker does the same: whoever is first, the group is there when it is killed
            os.setpgid(process, process)
        os.close(descriptor)
        self._workers[number] = process

    def _become_worker(self, template: int, descriptor: int) -> None:
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        with suppress(OSError):
            os.setpgid(0, 0)
        end_with(template)
        adopt_orphans()
        for end in (self._control, self._woken, self._wake):
            end.close()
        work(socket.socket(fileno=descriptor), self._prepare)

    def _bury(self) -> None:
        """Tell the runner of the workers that have ended, and end what they have left behind."""
        for number, process in list(self._workers.items()):
            found, status = os.waitpid(process, os.WNOHANG)
            if found:
                del self._workers[number]
                end_group(process)
                send(self._control, (number, os.waitstatus_to_exitcode(status)))
        end_orphans(self._workers.values())


def memory_of(jobs: int, share: float = 0.8) -> int:
    """Bytes a worker where all together may take this share of the machine."""
    total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return int(share * total / jobs)
