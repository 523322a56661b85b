"""Values of parsed JSON, each of the kind that belongs there."""

from __future__ import annotations

from typing import Any


def value_of(content: Any, key: str, *kinds: type) -> Any:
    """What stands under a key, of one of these kinds; a truth value is no number. Raises KeyError or TypeError."""
    value = content[key]
    if not isinstance(value, kinds) or (isinstance(value, bool) and bool not in kinds):
        raise TypeError(f'"{key}"')
    return value


def number_of(content: Any, key: str) -> float:
    """The number under a key. Raises KeyError, TypeError or OverflowError."""
    return float(value_of(content, key, int, float))
