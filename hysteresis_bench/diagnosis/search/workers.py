"""Several hypotheses at once: forked processes that share the data."""

from __future__ import annotations

import multiprocessing
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from types import TracebackType
from typing import Any

from hysteresis_bench.diagnosis.search.hypotheses import Bench, Trial

_bench: Bench


class Crew:
    """Runs methods of a bench, in order of the answers; in this process where there is one job, or no fork."""

    def __init__(self, bench: Bench, jobs: int) -> None:
        self._bench = bench
        self._pool: ProcessPoolExecutor | None = None
        if jobs > 1 and "fork" in multiprocessing.get_all_start_methods():
            context = multiprocessing.get_context("fork")
            # forked, not pickled: the workers find the records where they are
            self._pool = ProcessPoolExecutor(jobs, mp_context=context, initializer=_install, initargs=(bench,))

    def __enter__(self) -> Crew:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self._pool:
            self._pool.shutdown(cancel_futures=True)

    def map(self, questions: Sequence[tuple[Any, ...]]) -> list[Trial]:
        """questions : (method's name, *arguments)"""
        if self._pool and len(questions) > 1:
            return list(self._pool.map(_answer, questions))
        return [getattr(self._bench, method)(*arguments) for method, *arguments in questions]


def _install(bench: Bench) -> None:
    global _bench
    _bench = bench


def _answer(question: tuple[Any, ...]) -> Trial:
    method, *arguments = question
    answer: Trial = getattr(_bench, method)(*arguments)
    return answer
