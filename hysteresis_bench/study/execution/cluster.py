"""Tickets on many machines by Dask distributed. Every thread of a Dask worker carries its tickets out by a pool of its
own: a ticket that hangs or crashes ends a child and not the Dask worker, and its numbers are those of one machine."""

from __future__ import annotations

import pickle
import threading
from collections.abc import Iterable, Iterator
from itertools import islice
from types import TracebackType
from typing import Any, Generic

from hysteresis_bench.errors import UserError, told
from hysteresis_bench.study.execution.pool import E, Ended, Pool, T, Work
from hysteresis_bench.study.execution.template import memory_of

PATIENCE = 30
"""Seconds to wait for the scheduler and for its first worker."""
AHEAD = 2
"""Tickets a thread that are underway, so that none waits for the network."""
IDLE = 10.0
"""Seconds that a Dask worker's pool waits for the next ticket before it ends."""

_of_thread = threading.local()


class Cluster(Generic[T, E]):
    """As a Pool, on the workers of a scheduler. A context manager. Only this process sees the outcomes."""

    def __init__(self, work: Work[T, E], scheduler: str) -> None:
        """scheduler : its address, such as tcp://10.0.0.1:8786. Raises UserError where none answers."""
        try:
            from distributed import Client
        except ImportError:
            raise UserError("--scheduler", 'needs Dask distributed: pip install "hysteresis-bench[cluster]".') from None
        self._work = pickle.dumps(work)
        try:
            self._client = Client(scheduler, timeout=PATIENCE)
        except (OSError, ValueError, TypeError) as error:
            raise UserError("--scheduler", f"no scheduler answers at {scheduler}: {told(error)}") from None
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            self._client.close()
            raise UserError("--scheduler", f"the scheduler at {scheduler} has no workers.") from None

    def __enter__(self) -> Cluster[T, E]:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._client.close()

    def run(self, tickets: Iterable[T]) -> Iterator[Ended[T, E]]:
        """Yields tickets as they end, in no order. One whose Dask worker dies is carried out by another.

        Raises UserError where the scheduler goes.
        """
        from distributed import as_completed

        waiting = iter(tickets)
        underway: dict[Any, T] = {}
        ended = as_completed()
        while True:
            threads = sum(self._client.nthreads().values()) if self._client.status == "running" else 0
            for ticket in islice(waiting, max(0, AHEAD * max(1, threads) - len(underway))):
                future = self._client.submit(carried_out, self._work, ticket, pure=False)
                underway[future] = ticket
                ended.add(future)
            if not underway:
                return
            future = next(ended)
            ticket = underway.pop(future)
            yield ticket, *self._answer(future)
            future.release()

    def _answer(self, future: Any) -> tuple[E | None, str, str]:
        from distributed import KilledWorker

        if future.status in ("cancelled", "lost"):
            raise UserError("--scheduler", "the scheduler is gone. Nothing that finished is lost: run it again.")
        try:
            answer: tuple[E | None, str, str] = future.result()
        except KilledWorker:
            return None, "killed", "every machine that tried it was lost"
        except Exception as error:  # of the machine there: what a ticket raises comes as text
            return None, "not-started", told(error)
        return answer


def carried_out(work: bytes, ticket: Any) -> tuple[Any, str, str]:
    """On a Dask worker: a ticket by this thread's pool."""
    if not hasattr(_of_thread, "pool"):
        _of_thread.pool = _KeptPool()
    answer: tuple[Any, str, str] = _of_thread.pool.run(work, ticket)
    return answer


class _KeptPool:
    """A pool that stays for the next ticket of the same work, and ends where none comes: the study may be over, or its
    runner killed."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._pool: Pool[Any, Any] | None = None
        self._work = b""
        self._end = threading.Timer(IDLE, self._close)

    def run(self, work: bytes, ticket: Any) -> tuple[Any, str, str]:
        """outcome or None, status, reason"""
        self._end.cancel()
        if work != self._work:
            self._close()
        with self._lock:
            if self._pool is None:
                self._pool, self._work = Pool(pickle.loads(work), 1, _memory()), work
            ((_, outcome, status, reason),) = self._pool.run([ticket])
        self._end = threading.Timer(IDLE, self._close)
        self._end.daemon = True
        self._end.start()
        return outcome, status, reason

    def _close(self) -> None:
        with self._lock:
            if self._pool is not None:
                self._pool.__exit__(None, None, None)
                self._pool = None


def _memory() -> int:
    """Bytes for a thread's child: the Dask worker's limit, shared among its threads."""
    from distributed import get_worker

    worker = get_worker()
    threads = worker.state.nthreads
    limit = worker.memory_manager.memory_limit
    return limit // threads if limit else memory_of(threads)
