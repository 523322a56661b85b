"""What a user's mistake looks like: where, what, and what would be right, all faults at once."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable, Sequence


class UserError(Exception):
    """The user's input is at fault. The command line prints it without a traceback and exits with 2.

    where : what was read, such as a file's name
    faults : one sentence each, saying what is wrong and what would be right
    """

    def __init__(self, where: str, faults: str | Sequence[str]) -> None:
        self.where = printable(where)
        self.faults = [printable(fault) for fault in ([faults] if isinstance(faults, str) else faults)]
        super().__init__(str(self))

    def __str__(self) -> str:
        if len(self.faults) == 1:
            return f"{self.where}: {self.faults[0]}"
        return f"{self.where} has {len(self.faults)} faults: " + " · ".join(self.faults)

    def __reduce__(
        self,
    ) -> tuple[type[UserError], tuple[str, list[str]]]:  # exceptions with two arguments do not survive pickling unaided
        return type(self), (self.where, self.faults)


def printable(text: str) -> str:
    """Text that a terminal can print: what would move its cursor, or nothing shows, as escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def nearest(name: str, known: Iterable[str], unlike: Collection[str] = ()) -> str:
    """`Known: a, b. Did you mean "b"?` for an unknown name;  unlike : known ones that cannot be meant."""
    names = sorted(known)
    close = difflib.get_close_matches(name, [one for one in names if one not in unlike], n=1, cutoff=0.5)
    meant = f' Did you mean "{close[0]}"?' if close else ""
    return f"Known: {', '.join(names) or 'none'}.{meant}"


LONGEST = 500
"""Characters of an exception that are kept."""


def told(error: BaseException) -> str:
    """What an exception of somebody else's says, printable and not too long, whatever it does when it is asked."""
    name = type(error).__name__
    try:
        text = str(error)[: 4 * LONGEST]
    except BaseException:
        text = "it cannot be put into words"
    words = " ".join(text.split())
    whole = f"{name}: {words}" if words else name
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in whole)[:LONGEST]
