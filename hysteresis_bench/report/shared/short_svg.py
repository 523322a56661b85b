"""SVG with as few letters as show the same: points to a tenth of a typographic point, steps from one to the next.

A tenth is a third of the thinnest line, and a page holds dozens of figures of thousands of points.
"""

from __future__ import annotations

import re
from itertools import groupby

UNITS = 10
"""Of a point."""
PATH = re.compile(r' d="(M[^"]*)"')
POLYGON = re.compile(r"[MLz]|-?[0-9.]+(?:e-?[0-9]+)?")
USE = re.compile(r'<use ([^>]*?) ?style="([^"]*)"/>')
GROUP = re.compile(r'<g id="[^"]*"')
"""Names that nothing refers to: what is referred to is a path, a mark or a clip."""
LONG = re.compile(r'(?<=[ "(-])([0-9]+\.[0-9]{3,})(?=[ ")])')
BARE = re.compile(r"<g>\n((?:(?!</?g[ >]).)*?)</g>\n?", flags=re.S)
STYLE = re.compile(r'style="([^"]*)"')
PLACE = re.compile(r'\b(x|y)="(-?[0-9.]+)"')


def shortened(svg: str) -> str:
    """An SVG of matplotlib's, drawn alike."""
    svg = PATH.sub(lambda found: f' d="{_path(found[1])}"', svg)
    svg = re.sub(r"\n +", "\n", GROUP.sub("<g", svg))
    while (flat := BARE.sub(r"\1", svg)) != svg:
        svg = flat
    svg = "\n".join(text for style, lines in groupby(svg.split("\n"), _style) for text in _alike(style, list(lines)))
    svg = STYLE.sub(lambda found: f'style="{re.sub("(?<=[:;]) ", "", found[1])}"', svg)
    return LONG.sub(lambda found: f"{float(found[1]):.2f}", svg)


def _path(text: str) -> str:
    """Straight lines as steps between rounded points; what has a curve keeps its form."""
    if re.search("[A-Za-df-y]", text.replace("M", "").replace("L", "")):
        return " ".join(text.split())
    parts: list[str] = []
    tokens, here, last = POLYGON.findall(text), (0, 0), ""
    place, drawn = 0, 0
    while place < len(tokens):
        command = tokens[place]
        if command == "z":
            parts.append("z")
            place, last = place + 1, "z"
            continue
        there = _rounded(tokens[place + 1]), _rounded(tokens[place + 2])
        step = there[0] - here[0], there[1] - here[1]
        if command == "M":
            parts.append(f"M{_pair(*there)}")
            drawn = 0
        elif step != (0, 0) or not drawn:
            parts.append(f"{'' if last == 'l' else 'l'}{'' if last != 'l' or step[0] < 0 else ' '}{_pair(*step)}")
            drawn += 1
            command = "l"
        else:
            command = last
        here, last, place = there, command, place + 3
    return "".join(parts)


def _rounded(number: str) -> int:
    return round(UNITS * float(number))


def _pair(x: int, y: int) -> str:
    return f"{_number(x)}{'' if y < 0 else ' '}{_number(y)}"


def _number(tenths: int) -> str:
    whole, rest = divmod(abs(tenths), UNITS)
    text = f"{whole or ''}.{rest}" if rest else str(whole)
    return f"-{text}" if tenths < 0 else text


def _style(line: str) -> str:
    """Of a mark that is put somewhere; empty for every other line."""
    found = USE.fullmatch(line.strip())
    return found[2] if found else ""


def _alike(style: str, lines: list[str]) -> list[str]:
    """Marks of one style say it once."""
    if not style or len(lines) < 2:
        return lines
    marks = [f"<use {PLACE.sub(_place, USE.fullmatch(line.strip())[1])}/>" for line in lines]  # type: ignore[index]
    return [f'<g style="{style}">', *marks, "</g>"]


def _place(found: re.Match[str]) -> str:
    return f'{found[1]}="{_number(_rounded(found[2]))}"'
