"""The main tables as LaTeX: every sign that would stop it is escaped.

`test_report` has those of a whole report.
"""

from hysteresis_bench.report.shared.blocks import Table
from hysteresis_bench.report.trials.latex import booktabs, escaped


def test_signs_are_escaped():
    assert escaped("a_b & 5\u202f% of $3 {#}~\\") == (r"a\_b \& 5\,\% of \$3 \{\#\}\textasciitilde{}\textbackslash{}")
    assert escaped("3.296×10⁻⁴") == r"3.296$\times10^{-4}$"


def test_a_table_has_its_rows_and_sides():
    made = booktabs(Table("T", ["Name", "Value"], [["a", "1.5"], ["b", "2"]], "A note."))
    assert r"\begin{tabular}{lr}" in made
    assert made.count(r" \\") == 3
    assert "A note." in made
