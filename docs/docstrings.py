"""The project's docstrings as Markdown: `name : meaning` lines and numbered sources become lists.

Loaded by mkdocstrings, and used by the generated pages.
"""

from __future__ import annotations

import re
from inspect import cleandoc
from typing import Any

from griffe import Extension, Object

ITEM = re.compile(r"(\[\d+\] |(?:[\w*]+, )*[\w*]+ : )")
"""How a line begins that stands on its own: a source, or one or more names and their meaning."""

SENTENCE = re.compile(r"(Raises|Returns|Ours|Bounds|Departs)\b")
"""How a sentence begins that is no longer about the last name."""


def markdown(docstring: str) -> str:
    """The text of a docstring, for a page."""
    lines: list[str] = []
    in_list = False
    for line in cleandoc(docstring).replace(";  ", "\n").splitlines():
        text = line.strip()
        if ITEM.match(text) and not line.startswith("|"):
            if not in_list:
                lines.append("")
            name, _, meaning = text.partition(" : ")
            lines.append(f"- `{name}` : {meaning}" if meaning and not text.startswith("[") else f"- {_escaped(text)}")
            in_list = True
        elif not text or (in_list and SENTENCE.match(text)):
            lines += ["", _escaped(text)]
            in_list = False
        else:
            lines.append(f"  {_escaped(text)}" if in_list else _escaped(line))
    return "\n".join(lines).strip()


def _escaped(text: str) -> str:
    """Text outside of backticks with Markdown's and HTML's own characters taken as they stand."""
    parts = text.split("`")
    parts[::2] = [part.replace("*", r"\*").replace("<", "&lt;") for part in parts[::2]]
    return "`".join(parts)


class HouseDocstrings(Extension):
    """Rewrites every docstring that mkdocstrings shows."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        if obj.docstring:
            obj.docstring.value = markdown(obj.docstring.value)
