"""Units of measured columns as quantities: what is the same, what converts, and what does not.

A unit is a text as the field writes it: um, µm, degC, °C, C/m^2, uC/cm2, deg, %, 1. Gaussian units convert into SI ones
(Oe into A/m). A text that is no known unit, such as `a.u.` or `sample`, is compared as text.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from importlib.resources import as_file, files
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import UNITLESS, Dataset, Record

MEASURED = ("time", "input", "output")

LONGEST_UNIT = 60
"""Characters beyond which a text is no unit."""

ARBITRARY = frozenset({"a.u", "au", "AU"})
"""Arbitrary units, which a registry takes for years, atomic masses or astronomical units."""

SPELLED = re.compile(r"[\w°%µμΩΩÅ^*/·⋅×().⁻⁰¹²³⁴⁵⁶⁷⁸⁹ -]+")
POWER = re.compile(r"\^\s*\(?\s*[-+]?\d{1,2}\s*\)?(?!\d)")
DEGREES = re.compile(r"(?:°|degrees?|deg)\s*([CFKR])\b")
TORQUE = re.compile(r"\b([mkM]?)Nm\b")
"""A registry takes Nm for the number of a yarn."""


def same_unit(one: str, other: str) -> bool:
    """Whether two texts mean one unit, as `um` and `µm` do."""
    if one == other:
        return True
    first, second = _parsed(one), _parsed(other)
    return first is not None and second is not None and bool(first == second)


def is_unit(text: str) -> bool:
    """Whether a text is a unit that is known, or says that there is none."""
    return text.strip().rstrip(".") in ARBITRARY or _parsed(text) is not None


def is_no_duration(text: str) -> bool:
    """Whether a text is a known unit of something else than time; an angle or a number may stand for time."""
    unit = None if text == "s" else _parsed(text)
    return unit is not None and not (unit.dimensionless or any(map(unit.is_compatible_with, ("s", "rad"))))


def converted(values: Array, unit: str, wanted: str) -> Array:
    """Values given in `unit`, in the wanted one; the same array where both are one unit.

    values : (samples,)
    Raises ValueError where the units do not convert into each other.
    """
    if same_unit(unit, wanted):
        return values
    have, want = _parsed(unit), _parsed(wanted)
    if have is None or want is None:
        raise ValueError(f"{unit} does not convert into {wanted}")
    from pint import PintError

    try:
        quantity = _registry().Quantity(np.asarray(values, dtype=float), have)
        contexts = ("Gaussian",) if _is_gaussian(have, want) or _is_gaussian(want, have) else ()
        with np.errstate(over="ignore", invalid="ignore"):
            found = np.asarray(quantity.to(want, *contexts).magnitude, dtype=float)
    except (PintError, ArithmeticError):
        raise ValueError(f"{unit} does not convert into {wanted}") from None
    if not np.all(np.isfinite(found)):
        raise ValueError(f"in {wanted} the values in {unit} are too large")
    return found


def seconds_in(unit: str, seconds: float) -> float:
    """A duration in a record's unit of time; the number itself where that is no unit of time, such as an index."""
    try:
        return float(converted(np.array([seconds]), "s", unit)[0])
    except ValueError:
        return seconds


def rounded(value: float, digits: int = 2) -> str:
    """A number in a sentence or a table: 120 and not 1.2e+02; from a million on with its power of ten."""
    return f"{float(f'{value:.{digits}g}'):g}"


def frequency_in(unit: str, cycles: float) -> str:
    """Cycles a unit of time in words: 3 Hz, 0.2 cycles a ms, 3 cycles a unit of time where that is not known."""
    if same_unit(unit, "s"):
        return f"{cycles:.4g} Hz"
    return f"{cycles:.4g} cycles a {'unit of time' if unit == '1' else unit}"


def in_units(dataset: Dataset, wanted: Mapping[str, str], where: str, whose: str) -> Dataset:
    """The records in the wanted units, column by column, with a sentence in `notes` on what was done.

    A record's `units` hold only what is known: a column that states none is taken as in the wanted unit. Columns
    without a wanted unit stay as they are.
    where : what was read, such as a file's name;  whose : unit is wanted, such as "the model's"
    Raises UserError naming every column whose unit does not convert, with both units.
    """
    changed: dict[str, str] = {}
    unstated: dict[str, str] = {}
    unknown: dict[str, str] = {}
    faults: dict[str, None] = {}
    records = []
    for record in dataset.records:
        stated = {} if record.units is UNITLESS else record.units
        columns = _columns(record)
        for name, values in columns.items():
            unit, want = stated.get(name), wanted.get(name)
            if want is None:
                if unit is not None:
                    unknown[name] = unit
            elif unit is None:
                unstated[name] = want
            elif not same_unit(unit, want):
                try:
                    columns[name] = converted(values, unit, want)
                    changed[name] = f"{name} [{unit}] was converted to {want}"
                except ValueError as error:
                    has = (
                        f"in {want}: {error}" if want != "1" else "has none: take it out of the header, or fit with it"
                    )
                    faults[f'column "{name}" is in {unit}, {whose} {name} {has}.'] = None
        units = {**stated, **{name: wanted[name] for name in wanted if name in columns or name in MEASURED}}
        records.append(_with_columns(record, columns, units))
    if faults:
        raise UserError(where, list(faults))
    notes = [f"{where}: {', '.join(changed.values())}."] if changed else []
    if any(unit != UNITLESS.get(name, "1") for name, unit in unstated.items()):
        taken = ", ".join(f"{name} as {unit}" for name, unit in unstated.items())
        notes.append(f"{where}: no unit is stated; taken as {whose}: {taken}.")
    for name, unit in unknown.items():
        kept = f"{name} is read in {unit}, without conversion: {whose} unit of {name} is not stated."
        if not any(note.endswith(kept) for note in dataset.notes):
            notes.append(f"{where}: {kept}")
    return replace(dataset, records=tuple(records), notes=(*dataset.notes, *dict.fromkeys(notes)))


def _columns(record: Record) -> dict[str, Array]:
    output = {} if record.output is None else {"output": record.output}
    return {"time": record.time, "input": record.input, **output, **record.columns}


def _with_columns(record: Record, columns: Mapping[str, Array], units: Mapping[str, str]) -> Record:
    further = {name: values for name, values in columns.items() if name not in MEASURED}
    return replace(
        record,
        time=columns["time"],
        input=columns["input"],
        output=columns.get("output"),
        columns=further,
        units=units,
    )


def _is_gaussian(one: Any, other: Any) -> bool:
    """Is one in Gauss's system, and the other the SI's unit of the same quantity?

    A registry takes one of its units for another wherever that has the same dimensions there, as field and flux density
    have: teslas would become A/m.
    """
    quantities = {"oersted": "A/m", "gauss": "T", "maxwell": "Wb"}
    return any(name in str(one) and other.is_compatible_with(unit) for name, unit in quantities.items())


@cache
def _registry() -> Any:
    """Built when a unit is first looked at: it takes half a second.

    An angle is a dimension of its own: else a hertz would be a radian a second, and a turn 6.28.
    """
    import pint

    registry: Any = pint.UnitRegistry(None, on_redefinition="ignore")
    with as_file(files(pint) / "default_en.txt") as definitions:
        registry.load_definitions(definitions)
    registry.define("radian = [angle] = rad")
    return registry


@cache
def _parsed(text: str) -> Any:
    """The unit of a text, or None where it is none that is known."""
    plain = text.strip().replace("**", "^")
    if (
        len(plain) > LONGEST_UNIT
        or not SPELLED.fullmatch(plain)
        or plain.rstrip(".") in ARBITRARY
        or plain.endswith(".")
        or re.search(r"\d{3}|[\d)]\s*\^|\d[A-Za-z]", plain)  # 9^9^9 is no unit, and takes a registry for ever
        or len(POWER.findall(plain)) != plain.count("^")
    ):
        return None
    plain = TORQUE.sub(r"\1N*m", DEGREES.sub(r"deg\1", plain))
    plain = re.sub(r"[·⋅×]|(?<=\w)\.(?=\w)", "*", plain)
    plain = re.sub(r"(?<=[A-Za-zµμΩ])(?<!\^)(-?\d{1,2})\b", r"^\1", plain)
    for spelled in (plain, *([plain.lower()] if plain.istitle() else [])):  # `Volt`, as an oscilloscope writes it
        with suppress(Exception):  # a parser's own errors are of any type
            return _registry().parse_units(spelled)
    return None
