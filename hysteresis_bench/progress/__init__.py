"""Where a long computation is, and what an earlier run of it left: told upward, printed and kept by commands alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias


@dataclass(frozen=True)
class Step:
    """what : is being done, as a clause;  done, total : of this step, such as evaluations; total is None where it is
    not known"""

    what: str
    done: int = 0
    total: int | None = None


OnStep: TypeAlias = Callable[[Step], None]
"""Called whenever a step begins or goes on; it must return at once."""


class Kept(Protocol):
    """Answers of an earlier run, by all that determines them but the code; every new one is given to it."""

    def get(self, question: tuple[Any, ...]) -> Any | None: ...

    def __setitem__(self, question: tuple[Any, ...], answer: Any) -> None: ...


def quiet(step: Step) -> None:
    """Nobody listens."""
