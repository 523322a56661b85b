"""Threads and memory while we compute: one BLAS thread, memory that is kept for the next simulation, and few
collections of garbage.

On matrices as small as ours, BLAS threads wait for each other longer than they work. Every simulation of a swarm
takes and frees arrays of megabytes; glibc gives such arrays back to the kernel, which then clears every page anew:
a fit with creep took 686 000 page faults. Python looks for cycles among all objects, most of them modules and figures,
after every 700 new ones: a fifth of the time of a report. Forked processes find these settings as they are.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock

TRIM_THRESHOLD, MMAP_THRESHOLD, MMAP_MAX = -1, -3, -4
"""glibc's names for what mallopt sets, <malloc.h>."""
NEVER = -1
MOST_MAPPED = 65536
"""glibc's own MMAP_MAX."""
THRESHOLD = 32 << 20
"""glibc's thresholds move, which nobody can ask for and no call brings back: afterwards they stand where they would
move at most, 32 MB for what is mapped and twice that for what is kept."""

NEW_OBJECTS = 10_000
"""After which Python looks for cycles. Half of it and ten times as many save as much."""

_lock = Lock()
_users = 0
_restore: Callable[[], None]


@contextmanager
def economical() -> Iterator[None]:
    """One BLAS thread, in whatever BLAS numpy and scipy bring, memory kept, and few collections; as before when the
    last user leaves.

    Also a decorator, and may be nested.
    """
    global _users, _restore
    with _lock:
        _users += 1
        if _users == 1:
            _restore = _limited()
            _keep_memory()
    try:
        yield
    finally:
        with _lock:
            _users -= 1
            if _users == 0:
                _restore()
                _return_memory()


def _limited() -> Callable[[], None]:
    """Limits the threads and the collections; returns what restores both."""
    import scipy.linalg  # noqa: F401 - brings a BLAS of its own, which is limited only once it is loaded
    from threadpoolctl import threadpool_limits

    threads, (new_objects, *older) = threadpool_limits(limits=1, user_api="blas"), gc.get_threshold()

    def restore() -> None:
        threads.restore_original_limits()
        gc.set_threshold(new_objects, *older)

    if new_objects:  # whoever has turned it off wants none
        gc.set_threshold(max(new_objects, NEW_OBJECTS), *older)
    return restore


def _keep_memory() -> None:
    if libc := _glibc():
        libc.mallopt(MMAP_MAX, 0)
        libc.mallopt(TRIM_THRESHOLD, NEVER)


def _return_memory() -> None:
    if libc := _glibc():
        libc.mallopt(MMAP_MAX, MOST_MAPPED)
        libc.mallopt(MMAP_THRESHOLD, THRESHOLD)
        libc.mallopt(TRIM_THRESHOLD, 2 * THRESHOLD)
        libc.malloc_trim(2 * THRESHOLD)


def _glibc() -> ctypes.CDLL | None:
    """The C library, where it has these settings."""
    if sys.platform != "linux":
        return None
    library = ctypes.CDLL(None)
    return library if hasattr(library, "mallopt") and hasattr(library, "malloc_trim") else None
