"""The index of a folder of results: the answer of every report in it, and the papers' claims side by side."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
from markupsafe import Markup

from hysteresis_bench.data.csv_files import read_table
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.paper.claims import EQUIVALENT, FAILS, HOLDS, READING, UNDECIDED, how_many, in_a_table
from hysteresis_bench.report.paper.claims_file import CLAIMS
from hysteresis_bench.report.shared.blocks import Block, Cell, Details, Table
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.text import NONE, listed, probability, sentence, share
from hysteresis_bench.study.results import REPORT

INDEX = "index.html"
SEVERAL = " instances"
"""What is judged over many of these holds beyond one."""
SHOWN = 2
"""Paragraphs of an answer; the others are folded away."""
VERDICTS = (HOLDS, EQUIVALENT, FAILS, UNDECIDED)
TONES = {HOLDS: "good", FAILS: "bad"}


@dataclass
class Answered(HTMLParser):
    """A page of ours as it is read: its title, the line above it, the paragraphs of its answer."""

    title: str = ""
    kicker: str = ""
    answer: list[str] = field(default_factory=list)
    _inside: list[str] = field(default_factory=list)
    _text: str = ""
    _plain: bool = True

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "section":
            self._inside.append(dict(attrs).get("id") or "")
        if tag in ("title", "p"):
            self._text, self._plain = "", not attrs

    def handle_data(self, data: str) -> None:
        self._text += data

    def handle_endtag(self, tag: str) -> None:
        if tag == "title":
            self.title = self._text.strip()
        if tag == "p" and self._plain and "answer" in self._inside:
            self.answer.append(re.sub("[ \n]+", " ", self._text).strip())  # narrow spaces stay
        if tag == "p" and not self.kicker:  # the first one of a page
            self.kicker = self._text.strip()
        if tag == "section" and self._inside:
            self._inside.pop()


def is_index(folder: Path) -> bool:
    """Whether it is a folder of results folders, and none itself."""
    return not (folder / REPORT).is_file() and any(folder.glob(f"*/{REPORT}"))


def write_index(folder: Path) -> Path:
    """Write index.html beside the results folders, from what their pages and claims.csv say; returns it.

    Raises UserError where none of them has a page.
    """
    pages = sorted(folder.glob(f"*/{REPORT}"))
    if not pages:
        raise UserError(str(folder), f"holds no results: no folder in it has a {REPORT}.")
    found = {path.parent.name: _read(path) for path in pages}
    claims = _claims([path.parent for path in pages])
    sections = [_section(name, read) for name, read in found.items()]
    rest = [each for each in sorted(folder.iterdir()) if each.is_dir() and each.name not in found]
    sections += [_tables_only(each) for each in rest if any(each.glob("*.csv"))]
    sections += _claims_section(claims)
    answer = list(_on_claims(claims))
    page = Page("What was found, report by report", "hysteresis-bench results", sections, answer, contents=True)
    return page.write(folder / INDEX)


def _read(path: Path) -> Answered:
    read = Answered()
    read.feed(path.read_text(encoding="utf-8"))
    return read


def _section(name: str, read: Answered) -> Section:
    link = Markup('<a href="{0}/{1}">{0}/{1}</a>').format(name, REPORT)
    said = read.answer or [f"{sentence(read.kicker)} The page answers in tables."]
    more: list[Block] = [Details("More of its answer", said[SHOWN:])] if len(said) > SHOWN else []
    return Section(name, read.title, [*said[:SHOWN], *more, link])


def _tables_only(folder: Path) -> Section:
    names = [f"{folder.name}/{file.name}" for file in sorted(folder.glob("*.csv"))]
    links = Markup(", ").join(Markup('<a href="{0}">{0}</a>').format(name) for name in names)
    heading = folder.name.replace("-", " ").replace("_", " ").capitalize()
    return Section(folder.name, heading, [Markup("Tables without a page: {}.").format(links)])


def _claims(folders: Sequence[Path]) -> pd.DataFrame:
    """The papers' claims that are judged over instances, those first that hold; without ablations."""
    tables = [read_table(path).assign(folder=path.parent.name) for each in folders if (path := each / CLAIMS).is_file()]
    if not tables:
        return pd.DataFrame()
    every = pd.concat(tables, ignore_index=True)
    every = every.assign(why=every.get("why", ""))  # an older version did not say
    judged = every[~every["ablation"].astype(bool) & every["over"].str.endswith(SEVERAL)]
    place = {verdict: place for place, verdict in enumerate(VERDICTS)}
    return judged.sort_values("verdict", key=lambda column: column.map(place), kind="stable")


def _on_claims(claims: pd.DataFrame) -> Iterator[str]:
    if claims.empty:
        return
    of = {verdict: claims[claims["verdict"] == verdict] for verdict in VERDICTS}
    told = [f"{len(of[each])} {how_many(each, len(of[each]), list(of[each]['why']))}" for each in of if len(of[each])]
    over = listed(list(dict.fromkeys(claims["over"])))
    yield f"Of {len(claims)} judgements on the papers’ claims, each over {over} of the device: {listed(told)}."
    for verdict, what in ((HOLDS, "What holds"), (FAILS, "What does not, as the contrary does")):
        pairs = zip(of[verdict]["claim"], of[verdict]["problem"], strict=True)
        if names := [f"“{claim}” (on {problem})" for claim, problem in pairs]:
            yield f"{what}: {listed(names, len(names))}."


def _claims_section(claims: pd.DataFrame) -> Iterator[Section]:
    if claims.empty:
        return
    rows: list[list[str | Cell]] = []
    for _, row in claims.iterrows():
        interval = f"{share(row['a12'])} ({share(row['a12_low'])} to {share(row['a12_high'])})"
        equivalent = share(row["probability_equivalent"]) if pd.notna(row["probability_equivalent"]) else NONE
        verdict = Cell(in_a_table(row["verdict"], row["why"]), TONES.get(row["verdict"], "quiet"), strong=True)
        where = Cell(row["folder"], link=f"{row['folder']}/{REPORT}")
        rows.append([row["claim"], row["problem"], verdict, interval, probability(row["p"]), equivalent, where])
    header = ["Claim", "Problem", "Here", "A12 (95 %)", "p", "Equivalent", "In"]
    heading = "The papers’ claims over instances"
    yield Section("claims", heading, [Table("Every claim on every problem", header, rows, READING)])
