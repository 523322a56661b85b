"""The main tables as LaTeX: every sign that would stop it is escaped, and every row is there."""

import re

from hysteresis_bench.report.shared.blocks import Table
from hysteresis_bench.report.study import write_report
from hysteresis_bench.report.trials.latex import booktabs, escaped
from tests.synthetic_study import OPTIMIZERS, PROBLEMS, write_results


def test_signs_are_escaped():
    assert escaped("a_b & 5\u202f% of $3 {#}~\\") == (r"a\_b \& 5\,\% of \$3 \{\#\}\textasciitilde{}\textbackslash{}")
    assert escaped("3.296×10⁻⁴") == r"3.296$\times10^{-4}$"


def test_a_table_has_its_rows_and_sides():
    made = booktabs(Table("T", ["Name", "Value"], [["a", "1.5"], ["b", "2"]], "A note."))
    assert r"\begin{tabular}{lr}" in made
    assert made.count(r" \\") == 3
    assert "A note." in made


def test_a_report_leaves_its_main_tables(tmp_path):
    write_report(write_results(tmp_path, trials=14))
    made = (tmp_path / "tables.tex").read_text(encoding="utf-8")
    assert made.count(r"\begin{table}") == made.count(r"\end{table}") == 1 + len(PROBLEMS)
    assert all(made.count(f"\n{label} & ") == len(PROBLEMS) for label in OPTIMIZERS)
    assert not re.search(r"(?<!\\)%(?! needs)", made)
