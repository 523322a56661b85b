"""Oscilloscopes that write the time as a start and an increment beside the header, and samples in their order."""

from __future__ import annotations

import re
from collections.abc import Sequence

from hysteresis_bench.data.units import is_unit

TOP = 20
"""Lines among which the start and the increment are looked for."""
NUMBER = r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)"
BESIDE = re.compile(rf"t0 *= *{NUMBER}[^,;\t]*[,;\t] *tInc *= *{NUMBER}.*", re.IGNORECASE)
"""`CH1V,CH2V,t0 = -0.2, tInc = 0.001`"""
WORDS = ("start", "increment")
"""`X,CH1,CH2,Start,Increment` above `Sequence,Volt,Volt,-0.2,0.001`"""
DIGITS = 12
"""Significant ones of a time that is computed, so that rounding adds none."""


def clocked(lines: Sequence[str], mark: str) -> tuple[list[str], str] | None:
    """The same lines with a column of time, s, and what was done as a clause; None where there is no such clock."""
    for index, line in enumerate(lines[:TOP]):
        cells = _cells(line, mark)
        lower = [cell.lower() for cell in cells]
        if lower[-2:] == list(WORDS) and index + 1 < len(lines):
            below = _cells(lines[index + 1], mark)
            numbers = [_is_number(cell) for cell in below]
            if len(below) != len(cells) or not all(numbers[-2:]) or any(numbers[:-2]) or _unit(below[0]):
                return None  # no line of units, or a first column that is a time already
            units, first, counted = [_unit(cell) for cell in below[1:-2]], index + 2, True
            header, (start, step) = cells[1:-2], map(float, below[-2:])
        elif (found := BESIDE.search(line)) and all(map(_is_number, found.groups())):
            start, step = float(found[1]), float(found[2])
            names = _cells(line[: found.start()], mark)
            values = next((_cells(one, mark) for one in lines[index + 1 :] if one.strip()), [])
            if names[0].lower().startswith("time") and len(values) == len(names):
                return None  # it has its times as well
            header = names[1:] if names[0].lower().startswith("time") else names
            units, first, counted = [], index + 1, False
        else:
            continue
        top = [mark.join(["time [s]", *header]), *([mark.join(["s", *units])] if units else [])]
        body = _timed(lines[first:], mark, start, step, counted=counted)
        return [*lines[:index], *top, *body], f"time from a start of {start:g} s and an increment of {step:g} s"
    return None


def _timed(lines: Sequence[str], mark: str, start: float, step: float, *, counted: bool) -> list[str]:
    """Every line with its time in front; counted : whether it begins with the number of its sample"""
    found, sample = [], 0
    for line in lines:
        text = line.rstrip(f"{mark} ")
        if not text:
            found.append("")
            continue
        number, _, rest = text.partition(mark) if counted else (str(sample), mark, text)
        when = f"{start + step * float(number):.{DIGITS}g}" if _is_number(number) else number
        found.append(f"{when}{mark}{rest}")
        sample += 1
    return found


def _cells(line: str, mark: str) -> list[str]:
    """Cells without quotes; what is empty at the end is left out."""
    return [cell.strip().strip('"') for cell in line.rstrip(f"{mark} ").split(mark)]


def _unit(cell: str) -> str:
    """`VOLT` as `volt`; nothing where it is no unit."""
    return next((text for text in (cell, cell.lower()) if is_unit(text)), "")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
