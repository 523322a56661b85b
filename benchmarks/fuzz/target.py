"""One kind of input: how it is made, whom it is given to, and the count of what became of it."""

from __future__ import annotations

import atexit
import faulthandler
import shutil
import signal
import tempfile
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import FrameType
from typing import Any, NoReturn

import hypothesis
from hypothesis import HealthCheck, Phase, settings
from hypothesis.strategies import SearchStrategy

from hysteresis_bench.errors import UserError

LIMIT = 30.0
"""Seconds that an input may take on a loaded machine; beyond thrice that the process ends with a traceback."""
LONGEST = 2000
"""Characters of a sentence that somebody reads; a file may have many faults, and gets a sentence on each."""
SHOWN = 600
"""Characters of an input that are told."""
KINDS = ("answers", "sentences", "tracebacks", "hangs", "wrong")


class Wrong(Exception):
    """A number that is not the right one, without a word; or a sentence that is none."""


class TooLong(BaseException):
    """Raised out of what hangs."""


@cache
def scratch() -> Path:
    """A folder for the files of an input, gone with this process."""
    name = tempfile.mkdtemp(prefix="fuzz")
    atexit.register(shutil.rmtree, name, ignore_errors=True)
    return Path(name)


@dataclass(frozen=True)
class Target:
    """inputs : of hypothesis;  ask : given one of them, returns for an answer, raises UserError for a sentence and
    Wrong for a silent wrong number;  share : of all inputs, as a weight"""

    name: str
    inputs: SearchStrategy[Any]
    ask: Callable[[Any], object]
    share: int


@dataclass
class Count:
    """How many inputs came to what; failures : the first of each kind, with the input."""

    answers: int = 0
    sentences: int = 0
    tracebacks: int = 0
    hangs: int = 0
    wrong: int = 0
    failures: dict[str, str] = field(default_factory=dict)

    @property
    def failed(self) -> int:
        return self.tracebacks + self.hangs + self.wrong

    def add(self, kind: str, told: str = "", given: object = None) -> None:
        setattr(self, kind, getattr(self, kind) + 1)
        if told:
            self.failures.setdefault(f"{kind}: {told}", repr(given)[:SHOWN])


def fuzz(target: Target, inputs: int, seed: int) -> Count:
    """Give a target so many inputs; the same seed gives the same ones."""
    count = Count()

    @hypothesis.seed(seed)
    @settings(
        max_examples=inputs,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @hypothesis.given(target.inputs)
    def each(given: Any) -> None:
        kind, told = _asked(target, given)
        count.add(kind, told, given)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        each()
    return count


def _asked(target: Target, given: Any) -> tuple[str, str]:
    """What came of an input: its kind, and what is wrong with that."""
    faulthandler.dump_traceback_later(3 * LIMIT, exit=True)  # for what no signal ends, such as a compiled loop
    before = signal.signal(signal.SIGALRM, _too_long)
    signal.setitimer(signal.ITIMER_REAL, LIMIT)
    try:
        target.ask(given)
        return "answers", ""
    except UserError as error:
        sound = str(error).isprintable() and max(map(len, error.faults)) < LONGEST
        return ("sentences", "") if sound else ("wrong", "a sentence that is too long, or not to be printed")
    except OSError:  # the command line tells it in a sentence
        return "sentences", ""
    except Wrong as error:
        return "wrong", str(error)
    except TooLong:
        return "hangs", f"more than {LIMIT:g} s"
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        return "tracebacks", f"{type(error).__name__} at {place.name}, line {place.lineno} of {place.filename}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
        faulthandler.cancel_dump_traceback_later()


def _too_long(number: int, frame: FrameType | None) -> NoReturn:
    raise TooLong
