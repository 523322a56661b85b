"""One BLAS thread: on matrices as small as ours several wait for each other longer than they work."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from threadpoolctl import threadpool_limits

Function = TypeVar("Function", bound=Callable)


def single_threaded(function: Function) -> Function:
    """The function, run with one BLAS thread; processes that it forks have one, too."""
    limited: Function = threadpool_limits.wrap(limits=1, user_api="blas")(function)
    return limited
