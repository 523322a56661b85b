"""Parsed JSON and TOML with something changed somewhere."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

from hypothesis import strategies as st

Place = tuple[int | str, ...]

ODD = (
    0, 1, -1, 2, 0.5, -0.5, 1e-300, 1e101, 1e308, 10**400, float("nan"), float("inf"), float("-inf"), True, False, None,
    "", "x", "1", "nan", "\x00", "\x1b[31m", "\ud800", "\u00e9" * 900, "../x", "/etc/hostname", "a,b", [], [1], [0, 1],
    [1, 0], ["a"], [["a"]], [[]], [None], {}, {"a": 1}, {"a": {}}, {"a": [1, 2]}, [{}],
)  # fmt: skip
"""Values that belong nowhere, or not there."""


def places(tree: Any, here: Place = ()) -> Iterator[Place]:
    """Where something stands in a tree, its root not."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in items:
        yield (*here, key)
        yield from places(value, (*here, key))


def holder(tree: Any, place: Place) -> Any:
    """What holds a place."""
    for part in place[:-1]:
        tree = tree[part]
    return tree


@st.composite
def changes(draw: st.DrawFn, tree: Any) -> tuple[str, Place, Any]:
    """(how, where, what): a value replaced by an odd one or by another of the tree, taken out, renamed, or doubled."""
    every = list(places(tree))
    place = draw(st.sampled_from(every))
    how = draw(st.sampled_from(("odd", "odd", "odd", "other", "without", "renamed", "added")))
    if how == "other":
        other = draw(st.sampled_from(every))
        return how, place, copy.deepcopy(holder(tree, other)[other[-1]])
    return how, place, draw(st.sampled_from(ODD))


def changed(tree: Any, how: str, place: Place, what: Any) -> Any:
    """A copy of the tree with that change."""
    tree = copy.deepcopy(tree)
    inside = holder(tree, place)
    if how in ("odd", "other"):
        inside[place[-1]] = what
    elif how == "without":
        del inside[place[-1]]
    elif how == "added" or isinstance(inside, list):
        inside.append(what) if isinstance(inside, list) else inside.update(unheard_of=what)
    else:
        inside[f"{place[-1]}s"] = inside.pop(place[-1])
    return tree
