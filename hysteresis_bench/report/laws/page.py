"""What a comparison of laws leaves behind: laws.csv, a page; and the same on the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table as Printed

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG
from hysteresis_bench.diagnosis.laws.comparison import BASELINE, Comparison
from hysteresis_bench.diagnosis.structure.curves import FILE as CURVES
from hysteresis_bench.diagnosis.structure.curves import read_curves, write_curves
from hysteresis_bench.report.laws.structure import structure_section
from hysteresis_bench.report.laws.tables import draw_laws, fitted_ones, laws_figure, laws_table, not_fitted
from hysteresis_bench.report.shared.blocks import Bullets, Figures
from hysteresis_bench.report.shared.page import Page, Section, files_beside
from hysteresis_bench.report.shared.papers import save_figure
from hysteresis_bench.report.shared.text import listed

EQUAL = 0.01
"""Share of the chosen law's error by which another one is as good."""

FILE, LAWS = "laws.html", "laws.csv"
FILES = (LAWS, CURVES, FILE)


def write_comparison(folder: Path, found: Comparison, files: Sequence[Path]) -> Path:
    """Write laws.csv, the figure and the page; returns the page."""
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / LAWS, found.table)
    content = found.as_dict()
    laws = content["laws"]
    reasons = not_fitted(laws)
    structure = None
    if found.structure is not None:
        write_curves(folder, found.structure.findings)
        structure = structure_section(folder, content["structure"], read_curves(folder), found.units)
    sections = [
        Section(
            "laws",
            "Every law beside every other",
            [
                Figures([laws_figure(folder, laws, floor=found.floor, units=found.units)]),
                laws_table(laws, content["chosen"], found.floor, found.units),
            ],
        ),
        *([Section("reasons", "Laws that were not fitted", [Bullets(reasons)])] if reasons else []),
        *([structure] if structure else []),
        Section(
            "notes",
            "How it was made",
            [
                *([Bullets(found.notes)] if found.notes else []),
                files_beside({LAWS: "a row a law", **({CURVES: "what the tests compare"} if structure else {})}),
            ],
        ),
    ]
    page = Page(_title(found), f"Laws for {listed([file.stem for file in files], 6)}", sections, [found.words])
    return page.write(folder / FILE)


def draw_comparison(path: Path, found: Comparison) -> None:
    """The figure of the laws for a paper."""
    laws = fitted_ones(found.as_dict()["laws"])
    save_figure(
        path, 1.0 + 0.22 * len(laws), lambda figure: draw_laws(figure.subplots(), laws, found.floor, found.units)
    )


def _title(found: Comparison) -> str:
    if not found.chosen:
        return "No law beats a polynomial"
    errors = found.table.set_index("law")["unseen"]
    error = float(errors[found.chosen])
    others = errors.drop([found.chosen, BASELINE])
    equal = others.index[(others - error).abs() <= EQUAL * error]
    names, many = listed([found.chosen, *equal]), len(equal) > 0
    if error <= WRONG * found.floor:
        return f"{names} {'follow' if many else 'follows'} these data"
    return f"{names} {'come' if many else 'comes'} nearest, at {rounded(error / found.floor)} times the noise"


def print_comparison(found: Comparison, console: Console) -> None:
    """A row a law, the best first, and the choice in words."""
    unit = found.units.get("output", "1")
    held_out = bool(found.table["held_out"].notna().any())
    table = Printed(
        title=escape(f"RMSE{'' if unit == '1' else f' [{unit}]'}, noise {found.floor:.3g}"),
        title_justify="left",
        box=None,
    )
    table.add_column("law", no_wrap=True)
    for heading in ("parameters", "left out", "fitted", *(["held out"] if held_out else []), "CPU s"):
        table.add_column(heading, justify="right")
    for row in found.table.dropna(subset="unseen").itertuples(index=False):
        errors = [f"{row.unseen:.4g}", f"{row.fitted:.4g}", *([f"{row.held_out:.4g}"] if held_out else [])]
        style = "bold" if row.law == found.chosen else "dim" if row.law == BASELINE else ""
        table.add_row(row.law, str(row.parameters), *errors, f"{row.seconds:.1f}", style=style)
    console.print(table)
    for told in not_fitted(found.as_dict()["laws"]):
        console.print(escape(told), highlight=False, style="yellow" if "excluded: " in told else "dim")
    console.print(escape(found.words), highlight=False, style="bold" if found.chosen else "bold yellow")
