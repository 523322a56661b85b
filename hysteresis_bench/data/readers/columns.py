"""Which column of a sheet is which: by its name, by the name or position that the user gives, or asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from hysteresis_bench.data.layout import ALIASES, ROLES, Layout
from hysteresis_bench.data.readers.sheet import LONGEST_NAME, Sheet, parted
from hysteresis_bench.errors import UserError, nearest

KEEP_FAULTS = 8
"""Faults told of one file; a broken column has thousands."""
LISTED = 50
"""Names that a sentence lists at most."""


@dataclass(frozen=True, eq=False)
class Named:
    """A sheet whose columns have plain names, `time`, `input` and `output` among them.

    units : the ones that are stated, by name;  sources : of a role, what its column is called in the file
    notes : what was left out, as clauses
    replaced : the column of time that a rate is given in place of, and its unit; None where there is none
    """

    cells: pd.DataFrame
    units: dict[str, str]
    sources: dict[str, str]
    notes: tuple[str, ...] = ()
    replaced: tuple[pd.Series, str | None] | None = None


def named(where: str, sheet: Sheet, layout: Layout, required: Sequence[str]) -> Named:
    """The sheet's columns by name. Raises UserError for a required one that is not found, telling the option."""
    width = sheet.cells.shape[1]
    headers = [*sheet.headers[:width], *[""] * (width - len(sheet.headers))]
    for number, header in enumerate(headers, start=1):
        if len(header) > LONGEST_NAME:
            found = f"column {number} has a name of {len(header)} characters; is the first line a header?"
            raise UserError(where, found)
    names, units = [], {}
    for number, header in enumerate(headers):
        name, unit = parted(header)
        names.append(name.lower() or str(number + 1))
        below = sheet.units[number].strip() if number < len(sheet.units) else ""
        if unit or below:
            units[number] = unit or below
    if len(sheet.headers) > width:
        names += [parted(header)[0].lower() for header in sheet.headers[width:]]
    empty = {n for n in range(width) if not headers[n].strip() and sheet.headers and _is_empty(sheet.cells[n])}
    roles, faults = {}, []
    for role in dict.fromkeys((*ROLES, *required)):
        asked = layout.column(role) if role in ROLES else None
        if role == "time" and layout.rate is not None:
            continue
        position = _position(role, asked, names, headers)
        if position is not None and position < width:
            roles[role] = position
        elif role in required or asked is not None:
            faults.append(_missing(role, asked, names, bool(sheet.headers), sheet.left.get(asked or role)))
    taken: dict[int, list[str]] = {}
    for role, position in roles.items():
        taken.setdefault(position, []).append(role)
    faults += [
        f'column {n + 1}, called "{names[n]}", cannot be {" and ".join(of)}.' for n, of in taken.items() if len(of) > 1
    ]
    if faults:
        raise UserError(where, faults)
    back = {position: role for role, position in roles.items()}
    plain = {n: back.get(n, names[n]) for n in range(width) if n not in empty}
    shadowed = [n for n, name in plain.items() if n not in back and name in ROLES and _given(layout, name)]
    for n in shadowed:  # a column of that name that the user passed over
        del plain[n]
    doubled = sorted({name for name in plain.values() if [*plain.values()].count(name) > 1})
    if faults := [_doubled(name, plain) for name in doubled if name in (*ROLES, *required)]:
        raise UserError(where, faults[:KEEP_FAULTS])
    plain = {n: name for n, name in plain.items() if name not in doubled}
    notes = [f"left out, because several columns are called so: {', '.join(doubled[:LISTED])}"] if doubled else []
    every = list(plain.values())
    cells = sheet.cells[list(plain)].set_axis(pd.Index(every), axis=1)
    sources = {role: headers[position].strip() or f"column {position + 1}" for role, position in roles.items()}
    stated = {plain[n]: unit for n, unit in units.items() if n in plain}
    place = _position("time", None, names, headers) if layout.rate is not None else None
    replaced = (
        (sheet.cells[place], units.get(place)) if place is not None and place < width and place not in back else None
    )
    return Named(cells, stated, sources, tuple(notes), replaced)


def _doubled(name: str, plain: Mapping[int, str]) -> str:
    places = [str(n + 1) for n, other in plain.items() if other == name]
    which = " or ".join(f"--{name} {place}" for place in places)
    return f'two columns are called "{name}".' + (f" Say which it is with {which}." if name in ROLES else "")


def _given(layout: Layout, role: str) -> bool:
    return layout.column(role) is not None or (role == "time" and layout.rate is not None)


def _is_empty(cells: pd.Series) -> bool:
    return not pd.api.types.is_numeric_dtype(cells) and bool((cells == "").all())


def _position(role: str, asked: str | None, names: Sequence[str], headers: Sequence[str]) -> int | None:
    """Where the column of a role stands, from 0."""
    if asked is not None:
        wanted = asked.strip().lower()
        for known in (names, [header.strip().lower() for header in headers]):
            if wanted in known:
                return known.index(wanted)
        return int(wanted) - 1 if wanted.isdigit() and 0 < int(wanted) <= len(names) else None
    for name in (role, *ALIASES.get(role, ())):
        if name in names:
            return names.index(name)
    return None


def _counted(names: Sequence[str]) -> str:
    return f"{len(names)} column{'s' if len(names) > 1 else ''}"


def _missing(role: str, asked: str | None, names: Sequence[str], headed: bool, why: str | None) -> str:
    """The sentence on a column that is not found, with the option that helps.

    why : what stands under its name, where that is no column
    """
    if why is not None:
        return (
            f'"{asked or role}" is no column of numbers, but {why}. Save it as one, or give another with --{role} NAME.'
        )
    known = nearest(asked or role, names[:LISTED], unlike=[one for one in ROLES if asked is None])
    if not headed:
        return (
            f'no column "{asked or role}": there is no header, only {_counted(names)}. '
            f"Give its position with --{role} 1 to {len(names)}" + (", or --rate HZ." if role == "time" else ".")
        )
    helps = f" Say which it is with --{role} NAME." if role in ROLES else ""
    if asked is not None and asked.strip().lstrip("-").isdigit():
        helps = f" A position is a number from 1 to {len(names)}."
    rate = " Where there is no time, give --rate HZ." if role == "time" else ""
    return f'no column "{asked or role}". {known}{helps}{rate}'
