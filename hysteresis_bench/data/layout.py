"""What a user says of a data file: which column is which, its rate, how its text is to be read."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

from hysteresis_bench.errors import UserError

ROLES = ("time", "input", "output")
"""Columns that a record is made of."""

ALIASES = MappingProxyType({"time": ("t",), "input": ("u",), "output": ("y",)})
"""Headers that can mean nothing else; any other name is asked for."""

DELIMITERS = MappingProxyType(
    {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "space": " ", "\\t": "\t"}
    | {mark: mark for mark in (",", ";", "\t", "|", " ")}
)


@dataclass(frozen=True)
class Layout:
    """How data files are read, where they do not say it themselves.

    time, input, output : a column's name, or its position from 1;  rate : samples a second, in place of a time column
    delimiter : between cells, as a mark or its name;  decimal : "." or ",";  sheet : the only sheet or variable to read
    Raises UserError for what is no delimiter, no decimal mark, or no rate.
    """

    time: str | None = None
    input: str | None = None
    output: str | None = None
    rate: float | None = None
    delimiter: str | None = None
    decimal: str | None = None
    sheet: str | None = None

    def __post_init__(self) -> None:
        faults = []
        if self.delimiter is not None and self.delimiter not in DELIMITERS:
            faults.append(f'delimiter "{self.delimiter}" is none of comma, semicolon, tab, bar, space.')
        if self.decimal not in (None, ".", ","):
            faults.append(f'decimal mark "{self.decimal}" is neither "." nor ",".')
        if self.rate is not None and not 0.0 < self.rate < float("inf"):
            faults.append(f"rate {self.rate:g} is no number of samples a second.")
        if self.rate is not None and self.time is not None:
            faults.append("give a rate or a column of time, not both.")
        if faults:
            raise UserError("how the data are read", faults)

    def column(self, role: str) -> str | None:
        """What the user calls the column of a role."""
        named: str | None = getattr(self, role)
        return named

    @property
    def mark(self) -> str | None:
        """The delimiter as it stands in the file."""
        return None if self.delimiter is None else DELIMITERS[self.delimiter]


AS_THEY_SAY = Layout()
