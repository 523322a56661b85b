"""Numbers in cells: decimal point or comma, what is missing, times of day; what is ambiguous is asked for."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array

MISSING = frozenset(
    {"", "nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?"}
    | {f"{sign}1.#{word}" for sign in ("", "-") for word in ("ind", "qnan", "snan")}
)
NOT_A_NUMBER, OVERFLOW = 9.91e37, 9.9e37
"""What instruments write in the place of a reading that there is none of, and of one beyond their range (SCPI 1999)."""
BLANKS = "\u00a0\u2009\u202f"
NUMBER = re.compile(rf"[-+−]?(\d([\d.,'’]|[{BLANKS}](?=\d\d\d))*|[.,]\d+)([eEdD][-+]?\d+)?")
COMMA_GROUPS = re.compile(r"[-+−]?[1-9]\d{0,2}(,\d{3})+")
POINT_GROUPS = re.compile(r"[-+−]?[1-9]\d{0,2}(\.\d{3})+")
GROUPED = {
    mark: re.compile(
        rf"[-+−]?[1-9]\d{{0,2}}([{other}'’{BLANKS}])\d{{3}}(\1\d{{3}})*({re.escape(mark)}\d*)?([eEdD][-+]?\d+)?"
    )
    for mark, other in ((",", "."), (".", ","))
}
"""Numbers with one mark between all their thousands, by the decimal mark: `0.123` and `12345.678` have none."""
CLOCK = re.compile(r"(\d{1,3}):(\d\d)(?::(\d\d(?:[.,]\d+)?))?(?: ?([AP])M)?", re.IGNORECASE)
MINUTES = re.compile(r"(\d{1,4}):(\d\d[.,]\d+)")
DAY, HALF, HOUR = 86400.0, 43200.0, 3600.0
DOTTED = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})(?= |$)")
"""A date with dots, whose first number is the day."""
ISO = re.compile(r"\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d([.,]\d+)?)?)?(Z|[-+]\d\d:?\d\d)?")


class Ambiguous(ValueError):
    """A number can be read in two ways: the sentence says which, and which option decides."""


def looks_like_a_number(cell: str) -> bool:
    """Whether a cell is a number in any notation, missing, or a time of day."""
    text = cell.strip()
    return bool(
        text.lower() in MISSING
        or NUMBER.fullmatch(text)
        or any(clock.fullmatch(_iso(text)) for clock in (CLOCK, MINUTES, ISO))
    ) or math.isinf(number(text))


def is_missing(cell: object) -> bool:
    """Whether a cell says that there is no number."""
    if isinstance(cell, float):
        return math.isnan(cell) or cell == NOT_A_NUMBER
    text = str(cell).strip().lower()
    return text in MISSING or (text.endswith("37") and number(text) == NOT_A_NUMBER)


def number(cell: object, decimal: str = ".") -> float:
    """The number in a cell, NaN where there is none."""
    if not isinstance(cell, str):
        return float(cell) if isinstance(cell, (int, float, np.number)) else math.nan
    try:
        if "_" in cell:  # Python reads 1_0 as 10
            return math.nan
        if decimal == ".":
            return float(cell)
        if "." not in cell and cell.count(",") < 2:
            return float(cell.replace(",", "."))
    except ValueError:
        pass
    text = cell.strip()
    if grouped := GROUPED[decimal].fullmatch(text):
        text = text.replace(grouped[1], "")
    text = text.replace("−", "-")
    if decimal == ",":
        if "." in text:
            return math.nan
        text = text.replace(",", ".")
    try:
        return float(re.sub(r"[dD](?=[-+]?\d+$)", "e", text))
    except ValueError:
        return math.nan


def decimal_mark(cells: Iterable[tuple[int, str]]) -> str:
    """The decimal mark of a file. cells : (row, text), all of them. Raises Ambiguous."""
    certain: dict[str, str] = {}
    doubtful: dict[str, str] = {}
    grouped = False
    for row, cell in cells:
        text = cell.strip()
        if not NUMBER.fullmatch(text) or not ("," in text or "." in text):
            continue
        said = f'row {row}: "{text}"'
        points, commas = text.count("."), text.count(",")
        if points and commas:
            certain.setdefault("," if text.rfind(",") > text.rfind(".") else ".", said)
            grouped = True
        elif commas > 1 or points > 1:
            certain.setdefault("." if commas else ",", said)
            grouped = True
        elif commas:
            (doubtful if COMMA_GROUPS.fullmatch(text) else certain).setdefault(",", said)
        else:
            (doubtful if POINT_GROUPS.fullmatch(text) else certain).setdefault(".", said)
    if len(certain) > 1:
        raise Ambiguous(f"{' beside '.join(certain.values())}: decimal comma and point in one file; give --decimal.")
    if not certain:
        if "," in doubtful:
            raise Ambiguous(
                f"{doubtful[',']} may be a decimal comma or thousands; give --decimal , or --decimal . to say which."
            )
        return "."
    ((mark, seen),) = certain.items()
    other = "." if mark == "," else ","
    if other in doubtful and not grouped:
        raise Ambiguous(
            f"{doubtful[other]} beside {seen} may be thousands or another decimal mark; give --decimal , or --decimal ."
        )
    return mark


def seconds(cells: pd.Series) -> tuple[Array, str] | None:
    """Times of day or dates as seconds after the first, (samples,), and what they were read as; None where a cell is
    neither.

    Times of day may go past midnight; dates are those of ISO 8601, or with dots. Of two numbers the first are minutes
    where a day has not as many hours, or where the second have decimals, else hours.
    """
    texts = [_iso(str(cell).strip().replace(",", ".")) for cell in cells]
    for clock in (CLOCK, MINUTES):
        if all(found := [clock.fullmatch(text) for text in texts]):
            times = np.array([_of_day(one) for one in found if one])
            words, short = "times of day", clock is CLOCK and not any(one[3] or one[4] for one in found if one)
            if clock is MINUTES or (short and times.max() >= DAY):
                words, times = "minutes and seconds", times / 60.0 if short else times
            elif short:
                words = "times of day in hours and minutes"
            days = np.concatenate(([0.0], np.cumsum(np.diff(times) < -HALF)))
            return np.round(times - times[0] + DAY * days, 9), words
    if all(ISO.fullmatch(text) for text in texts):
        try:
            stamps = pd.to_datetime(pd.Series(texts), format="ISO8601", utc=True)
        except ValueError:
            return None
        return np.asarray((stamps - stamps.iloc[0]).dt.total_seconds(), dtype=float), "times of day"
    return None


def _iso(text: str) -> str:
    """A date with dots as one of ISO 8601; anything else as it is."""
    return DOTTED.sub(lambda date: f"{date[3]}-{int(date[2]):02d}-{int(date[1]):02d}", text)


def _of_day(clock: re.Match[str]) -> float:
    """Seconds of hours, minutes and seconds, with a half of the day or without, or of minutes and seconds."""
    if clock.re is MINUTES:
        return 60.0 * int(clock[1]) + float(clock[2])
    hours = int(clock[1]) % 12 + 12 * (clock[4] in "pP") if clock[4] else int(clock[1])
    return HOUR * hours + 60.0 * int(clock[2]) + float(clock[3] or 0)
