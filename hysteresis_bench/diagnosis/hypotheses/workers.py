"""Several hypotheses, or laws, at once: forked processes that share the data."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.progress import OnStep, Step, quiet
from hysteresis_bench.study.execution.lifetime import end_with

Answer = TypeVar("Answer")

_fitter: Any

WORDS = {
    "extended": "one effect more",
    "reduced": "one effect less",
    "refitted": "other starts",
    "bare": "the bare model",
}


class Workers(Generic[Answer]):
    """Runs methods of a fitter, in order of the answers; in this process where there is one job, or no fork.

    Answer : what the methods return;  on_step : told of every answer
    """

    def __init__(self, fitter: Any, jobs: int, on_step: OnStep = quiet) -> None:
        self._on_step = on_step
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
        if isinstance(error, KeyboardInterrupt):  # what is being fitted would be waited for
            for child in multiprocessing.active_children():
                child.terminate()
        if self._pool:
            self._pool.shutdown(cancel_futures=True)

    def map(self, questions: Sequence[tuple[Any, ...]]) -> list[Answer]:
        """questions : (method's name, *arguments)"""
        if self._pool and len(questions) > 1:
            answers: Iterator[Answer] = self._pool.map(_answer, questions)
        else:
            answers = (getattr(self._fitter, method)(*arguments) for method, *arguments in questions)
        return list(self._told(answers, questions))

    def _told(self, answers: Iterator[Answer], questions: Sequence[tuple[Any, ...]]) -> Iterator[Answer]:
        """The answers, counted as they come."""
        if not questions:
            return
        method, hypothesis, *_ = questions[0]
        names = ", ".join(sorted(hypothesis.names)) if isinstance(hypothesis, Hypothesis) else ""
        what = f"{WORDS.get(method, method)}{f' on {names}' if names else ''}"
        self._on_step(Step(what, 0, len(questions)))
        for done, answer in enumerate(answers, start=1):
            self._on_step(Step(what, done, len(questions)))
            yield answer


def _install(fitter: Any, parent: int) -> None:
    global _fitter
    _fitter = fitter
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends without a traceback of its own
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    end_with(parent)


def _answer(question: tuple[Any, ...]) -> Any:
    method, *arguments = question
    return getattr(_fitter, method)(*arguments)
