"""The main tables for a paper: LaTeX with booktabs, to be read by \\input."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from hysteresis_bench.report.shared.blocks import Table

TABLES = "tables.tex"
SPECIAL = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
SPECIAL |= {character: f"\\{character}" for character in "&%$#_{}"}
SIGNS = {"\u202f": r"\,", "\u00a0": "~", "–": "--", "’": "'", "“": "``", "”": "''", "χ²": r"$\chi^2$", "±": r"$\pm$"}
SIGNS |= {"<": r"$<$", ">": r"$>$"}
POWER = re.compile("×10([⁻⁰¹²³⁴-⁹]+)")
PLAIN = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def write_latex(folder: Path, tables: Sequence[Table]) -> Path:
    """Write the tables into one file; returns it."""
    path = folder / TABLES
    path.write_text("% needs \\usepackage{booktabs}\n\n" + "\n".join(map(booktabs, tables)), encoding="utf-8")
    return path


def booktabs(table: Table) -> str:
    """A table with its caption; numbers stand at the right of their column."""
    columns = "".join("r" if numeric else "l" for numeric in table.numeric)
    header = " & ".join(escaped(name) for name in table.header)
    rows = [" & ".join(escaped(cell.text) for cell in row) for row in table.cells]
    lines = [
        r"\begin{table}",
        rf"\caption{{{escaped(table.caption)}}}",
        rf"\begin{{tabular}}{{{columns}}}",
        r"\toprule",
    ]
    lines += [rf"{header} \\", r"\midrule", *(rf"{row} \\" for row in rows), r"\bottomrule", r"\end{tabular}"]
    lines += [rf"\par\smallskip {escaped(table.note)}"] if table.note else []
    return "\n".join([*lines, r"\end{table}", ""])


def escaped(text: str) -> str:
    """Text as LaTeX prints it."""
    plain = "".join(SPECIAL.get(character, character) for character in text)
    for sign, command in SIGNS.items():
        plain = plain.replace(sign, command)
    return POWER.sub(lambda found: rf"$\times10^{{{found[1].translate(PLAIN)}}}$", plain)
