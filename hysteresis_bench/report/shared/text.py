"""Numbers, names and quantities as the text of a page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

NONE = "–"
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

Units = Mapping[str, str]
"""Of time, input and output."""


def number(value: Any, digits: int = 4, never: str = "failed") -> str:
    """3.296×10⁻⁴, 0.0823, 15 050; NONE where absent, `never` where infinite."""
    if not _given(value):
        return NONE
    value = float(value)
    if math.isinf(value):
        return never
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e6:
        if value == round(value) and abs(value) >= 1:
            return whole(value)
        text = f"{value:.{digits}g}"
        return text if "e" not in text else whole(value)
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}×10{str(int(exponent)).translate(SUPERSCRIPTS)}"


def whole(value: Any, never: str = "not reached") -> str:
    """15 050 with narrow no-break spaces."""
    if not _given(value):
        return NONE
    if math.isinf(float(value)):
        return never
    return f"{round(float(value)):,}".replace(",", "\u202f")


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
