"""Numbers, names and quantities as the text of a page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import Any

NONE = "–"
AS_PRINTED = 7
"""Significant digits of a number that a paper prints or a study sets: as many as stand there."""
SAME = 1e-12
"""Relative difference of two numbers that differ by arithmetic alone."""
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

Units = Mapping[str, str]
"""Of time, input and output."""


def number(value: Any, digits: int = 4, never: str = "failed") -> str:
    """3.296×10⁻⁴, 0.0823, 15 050; NONE where absent, `never` where infinite.

    An integer is told whole, every other number to `digits` significant ones. Zeros at the end say that something was
    rounded: 1 is one, 1.000 nearly so. Digits stand in threes, also of four, so that a column has one look.
    """
    if not _given(value):
        return NONE
    if isinstance(value, Integral):
        return whole(value)
    value = float(value)
    if math.isinf(value):
        return never
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power, rounded = int(exponent), float(f"{mantissa}e{exponent}")
    exact = math.isclose(rounded, value, rel_tol=SAME)
    if -3 <= power < 6:
        return _without_zeros(_in_threes(f"{rounded:,.{max(0, digits - 1 - power)}f}"), exact)
    return f"{_without_zeros(mantissa, exact)}×10{str(power).translate(SUPERSCRIPTS)}"


def to_its_error(value: float, error: float | None, digits: int = 2, most: int = AS_PRINTED) -> str:
    """A value as far as its standard error lets it be known, 0.307 beside 0.021 and 238 600 beside 2 200.

    error : in the value's unit, told to `digits` significant ones; None or infinite where nothing is known of it
    most : significant digits at most
    """
    if error is None or not value or not math.isfinite(error):
        return number(value)
    known = _power(value, most) - _power(error, digits) + digits if error else most
    return number(value, min(max(known, 1), most))


def _power(value: float, digits: int) -> int:
    """Of ten, of a value that is rounded to so many significant digits."""
    return int(f"{value:.{digits - 1}e}".partition("e")[2])


def _without_zeros(text: str, exact: bool) -> str:
    """Zeros after the point are dropped where nothing was rounded."""
    return text.rstrip("0").rstrip(".") if exact and "." in text else text


def _in_threes(text: str) -> str:
    return text.replace(",", "\u202f")


def whole(value: Any, never: str = "not reached") -> str:
    """15 050 with narrow no-break spaces."""
    if not _given(value):
        return NONE
    if math.isinf(float(value)):
        return never
    return _in_threes(f"{round(float(value)):,}")


def percent(value: Any, digits: int = 3, never: str = "failed") -> str:
    """0.0807 -> 8.07 %."""
    if not _given(value):
        return NONE
    return never if math.isinf(float(value)) else f"{number(100.0 * float(value), digits)}\u202f%"


def probability(p: Any) -> str:
    """0.023, or < 0.001; NONE below enough trials."""
    if not _given(p):
        return NONE
    return "< 0.001" if float(p) < 0.001 else f"{float(p):.3f}"


def p_equals(p: Any) -> str:
    """p = 0.023, or p < 0.001."""
    text = probability(p)
    return f"p {text}" if text.startswith("<") else f"p = {text}"


def share(value: Any) -> str:
    """An A12 with two decimals."""
    return f"{float(value):.2f}" if _given(value) else NONE


def seconds(value: Any) -> str:
    """0.14 s; NONE where absent or infinite."""
    return NONE if not _given(value) or math.isinf(float(value)) else f"{float(value):.2g} s"


def listed(names: Sequence[str], most: int = 6) -> str:
    """a, b and c; a long list is cut and counted."""
    shown = list(names[:most])
    if len(names) > most:
        shown.append(f"{len(names) - most} more")
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}" if shown else "none"


def sentence(words: str) -> str:
    """A capital at the beginning, a full stop at the end."""
    return f"{words[:1].upper()}{words[1:]}{'' if words.endswith('.') else '.'}"


def named(quantity: str, units: Units, key: str) -> str:
    """A quantity with its unit, where it is known: `Input (°C)`. key : time, input or output"""
    unit = {"degC": "°C", "deg": "°", "um": "μm"}.get(units.get(key, ""), units.get(key, ""))
    return f"{quantity} ({unit})" if unit not in ("", "1") else quantity


def unit_cell(unit: str | None) -> str:
    """A unit in a column of its own; empty for a pure number."""
    return "" if unit in (None, "1") else str(unit)


def _given(value: Any) -> bool:
    import pandas as pd

    return value is not None and not pd.isna(value)
