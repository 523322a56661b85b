"""Several hypotheses, or laws, at once: forked processes that share the data."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from hysteresis_bench.study.execution.lifetime import end_with

Answer = TypeVar("Answer")

_fitter: Any


class Workers(Generic[Answer]):
    """Runs methods of a fitter, in order of the answers; in this process where there is one job, or no fork.

    Answer : what the methods return
    """

    def __init__(self, fitter: Any, jobs: int) -> None:
        self._fitter = fitter
        self._pool: ProcessPoolExecutor | None = None
        if jobs > 1 and "fork" in multiprocessing.get_all_start_methods():
            context = multiprocessing.get_context("fork")
            # forked, not pickled: the workers find the records where they are
            self._pool = ProcessPoolExecutor(
                jobs, mp_context=context, initializer=_install, initargs=(fitter, os.getpid())
            )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self._pool:
            self._pool.shutdown(cancel_futures=True)

    def map(self, questions: Sequence[tuple[Any, ...]]) -> list[Answer]:
        """questions : (method's name, *arguments)"""
        if self._pool and len(questions) > 1:
            return list(self._pool.map(_answer, questions))
        return [getattr(self._fitter, method)(*arguments) for method, *arguments in questions]


def _install(fitter: Any, parent: int) -> None:
    global _fitter
    _fitter = fitter
    end_with(parent)


def _answer(question: tuple[Any, ...]) -> Any:
    method, *arguments = question
    return getattr(_fitter, method)(*arguments)
