"""Tickets, such as trials, on all cores: a pool that kills a hung one, survives a crashed one, and loses no other."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, TimeoutError, wait
from contextlib import contextmanager
from typing import Protocol, TypeVar

from hysteresis_bench.errors import UserError

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
MEMORY_SHARE = 0.8
"""Share of the machine's memory that all workers together may take."""


class Finished(Protocol):
    """What a ticket that ran to its end says of itself."""

    @property
    def status(self) -> str: ...

    @property
    def reason(self) -> str: ...


T = TypeVar("T")
E = TypeVar("E", bound=Finished)


def run_tickets(
    tickets: Sequence[T], run: Callable[[T], E], jobs: int, timeout: float
) -> Iterator[tuple[T, E | None, str, str]]:
    """Yields (ticket, outcome or None, status, reason) as tickets finish, in no order.

    timeout : seconds a ticket. Raises UserError where the caller's script starts it on being imported.
    """
    from pebble import ProcessPool

    if multiprocessing.parent_process() is not None:
        raise UserError("run_study", 'guard the call in your script with `if __name__ == "__main__":`.')
    context = multiprocessing.get_context("spawn")  # a forked copy of a threaded parent may hang
    with _single_threaded_children(), ProcessPool(jobs, initializer=_limit, initargs=[jobs], context=context) as pool:
        futures: dict[Future[E], T] = {}
        waiting = iter(tickets)
        try:
            while True:
                # a ticket at a time beyond those at work: all of them at once would fill the pool's pipe
                while len(futures) < 2 * jobs and (ticket := next(waiting, None)) is not None:
                    futures[pool.schedule(run, args=[ticket], timeout=timeout)] = ticket
                if not futures:
                    return
                for future in wait(futures, return_when=FIRST_COMPLETED).done:
                    yield futures.pop(future), *_verdict(future, timeout)
        except BaseException:
            stop: Callable[[], None] = pool.stop
            stop()
            raise


def _verdict(future: Future[E], timeout: float) -> tuple[E | None, str, str]:
    from pebble import ProcessExpired

    try:
        outcome = future.result()
    except TimeoutError:
        return None, "timed-out", f"stopped after {timeout:g} s"
    except MemoryError:
        return None, "out-of-memory", "needed more memory than its share of the machine"
    except ProcessExpired as error:
        if error.exitcode is not None and -error.exitcode == signal.SIGKILL:
            return None, "out-of-memory", "killed from outside, as the system does when memory runs out"
        return None, "crashed", f"the worker process ended with exit code {error.exitcode}"
    except Exception as error:  # a plugin's own fault, whatever it is, becomes the ticket's row
        return None, "raised", f"{type(error).__name__}: {' '.join(str(error).split())}"
    return outcome, outcome.status, outcome.reason


def _limit(jobs: int) -> None:
    """Give a worker its share of the memory, leave Ctrl-C to the parent, and end with it, however it ends."""
    import resource

    threading.Thread(target=_end_with, args=[os.getppid()], daemon=True).start()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    share = int(MEMORY_SHARE * total / jobs)
    resource.setrlimit(resource.RLIMIT_DATA, (share, resource.getrlimit(resource.RLIMIT_DATA)[1]))


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


@contextmanager
def _single_threaded_children() -> Iterator[None]:
    """Workers inherit the environment: one thread each, for speed and for the same sums on every machine."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.update({name: value})
