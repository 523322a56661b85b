"""Several hypotheses, or laws, at once: forked processes that share the data."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from types import TracebackType
from typing import Any, Generic, Self, TypeVar, cast

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.progress import Kept, OnStep, Step, quiet
from hysteresis_bench.study.execution.lifetime import end_with

Answer = TypeVar("Answer")

_fitter: Any

WORDS = {
    "extended": "one effect more",
    "reduced": "one effect less",
    "refitted": "other starts",
    "bare": "the bare model",
    "screened": "other laws on some of the samples",
    "fitted": "other laws",
}


class Workers(Generic[Answer]):
    """Runs methods of a fitter, in order of the questions; in this process where there is one job, or no fork, and
    after the end of the context.

    Answer : what the methods return;  on_step : told of every answer
    kept : asked for (fitter, method's name, *arguments) before anything is run, and given every answer as it comes
    """

    def __init__(self, fitter: Any, jobs: int, on_step: OnStep = quiet, kept: Kept | None = None) -> None:
        self._on_step, self._kept = on_step, kept
        self._fitter = fitter
        self._others = {*multiprocessing.active_children()}
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
            for child in {*multiprocessing.active_children()} - self._others:
                child.terminate()
        if self._pool:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None

    def map(self, questions: Sequence[tuple[Any, ...]]) -> list[Answer]:
        """questions : (method's name, *arguments)"""
        answers = [self._known(question) for question in questions]
        new = [place for place, answer in enumerate(answers) if answer is None]
        if questions:
            step = Step(_words(*questions[0]), len(questions) - len(new), len(questions))
            self._on_step(step)
            for place, answer in self._answered(questions, new):
                answers[place] = answer
                if self._kept is not None:
                    self._kept[self._fitter, *questions[place]] = answer
                step = replace(step, done=step.done + 1)
                self._on_step(step)
        return cast(list[Answer], answers)

    def _known(self, question: tuple[Any, ...]) -> Answer | None:
        return None if self._kept is None else self._kept.get((self._fitter, *question))

    def _answered(self, questions: Sequence[tuple[Any, ...]], places: Sequence[int]) -> Iterator[tuple[int, Answer]]:
        """The answers to some of the questions, each with its place, as they come."""
        if self._pool and len(places) > 1:
            futures = {self._pool.submit(_answer, questions[place]): place for place in places}
            yield from ((futures[future], future.result()) for future in as_completed(futures))
        else:
            for place in places:
                method, *arguments = questions[place]
                yield place, getattr(self._fitter, method)(*arguments)


def _words(method: str, hypothesis: Any, *_: Any) -> str:
    names = ", ".join(sorted(hypothesis.names)) if isinstance(hypothesis, Hypothesis) else ""
    return f"{WORDS.get(method, method)}{f' on {names}' if names else ''}"


def _install(fitter: Any, parent: int) -> None:
    global _fitter
    _fitter = fitter
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends without a traceback of its own
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    end_with(parent)


def _answer(question: tuple[Any, ...]) -> Any:
    method, *arguments = question
    return getattr(_fitter, method)(*arguments)
