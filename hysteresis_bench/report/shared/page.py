"""A page: its answer, its sections, and one self-contained HTML file of them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from hysteresis_bench.errors import UserError
from hysteresis_bench.report.shared.blocks import Block

PACKAGE = "hysteresis_bench.report"


@dataclass(frozen=True)
class Section:
    """A part of a page with its heading. anchor : its id in the page, unique where there is one"""

    anchor: str
    heading: str
    blocks: Sequence[Block]


@dataclass(frozen=True)
class Page:
    """What a page says, in its order.

    answer : the first sentences;  answers : what they answer, for who cannot see the page
    warnings : before anything else is believed, under the heading `warned`
    contents : does a list of the sections lead the page?
    files_kept : are its figures kept beside it, so that it links to them?
    """

    title: str
    kicker: str
    sections: Sequence[Section]
    answer: Sequence[Block] = ()
    answers: str = "The answer"
    warnings: Sequence[str] = ()
    warned: str = "Warnings"
    contents: bool = False
    files_kept: bool = True

    def write(self, path: Path) -> Path:
        """Write the page with its style and figures inside; every text is escaped, links and figures excepted.

        Raises UserError where the path is a link: what it points to is not ours to replace.
        """
        if path.is_symlink():
            raise UserError(str(path), f"is a link to {path.readlink()}; remove it, so that the page is written here.")
        parts = {"style": "style.css", "sorting": "sorting.js", "printing": "printing.js"}
        inside = {key: (files(PACKAGE) / "templates" / name).read_text(encoding="utf-8") for key, name in parts.items()}
        text: str = _environment().get_template("page.html.j2").render(page=self, **inside)
        path.write_text(text, encoding="utf-8")
        return path


def files_beside(known: Mapping[str, str]) -> str:
    """A sentence with a link to each file that lies beside the page. known : name -> what is in it"""
    from markupsafe import Markup

    links = [Markup('<a href="{0}">{0}</a> ({1})').format(name, what) for name, what in known.items()]
    return Markup("Files beside this page: {}.").format(Markup(", ").join(links))


def _said(text: str) -> str:
    """A sentence with what stands between backticks, as a terminal shows it, set as code; escaped unless `Markup`."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", str(escape(text))))


@cache
def _environment() -> Any:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(PACKAGE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["said"] = _said
    return environment
