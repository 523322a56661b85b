"""Where a long computation is: told upward by a function that is passed down, printed by commands alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True)
class Step:
    """what : is being done, as a clause;  done, total : of this step, such as evaluations; total is None where it is
    not known"""

    what: str
    done: int = 0
    total: int | None = None


OnStep: TypeAlias = Callable[[Step], None]
"""Called whenever a step begins or goes on; it must return at once."""


def quiet(step: Step) -> None:
    """Nobody listens."""
