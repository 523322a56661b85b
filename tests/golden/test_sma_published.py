"""The shape-memory-alloy paper's Tables 1 and 2 as printed, and its audit borne out by arithmetic.

Jiles-Atherton Based Hysteresis Identification of Shape Memory Alloy-Actuating Compliant Mechanism via
Modified Particle Swarm Optimization Algorithm, Complexity (2019).
"""

import tomllib
from pathlib import Path

import pytest

from hysteresis_bench.report.paper.audit import audit
from hysteresis_bench.report.paper.published import check_published

STUDIES = Path(__file__).parents[2] / "studies"


@pytest.fixture(scope="module")
def published():
    return check_published(tomllib.loads((STUDIES / "sma.published.toml").read_text(encoding="utf-8")))


def test_table_1_is_the_search_space(published):
    columns = published.tables["table_1"].columns
    rows = list(zip(columns["parameter"], columns["min"], columns["max"], strict=True))
    assert rows == [
        ("alpha", 1e-14, 1e-2),
        ("a", 1e-2, 1e4),
        ("k", 1e-2, 1e4),
        ("M_s", 1e5, 3e7),
        ("c", 1e-2, 3.0),
    ]


def test_table_2_is_the_identified_model(published):
    assert published.tables["table_2"].columns == {
        "optimizer": ["pso", "mpso"],
        "alpha": [1.000e-14, 1.000e-14],
        "a": [7.982261, 9.771736],
        "k": [58.11999, 33.80507],
        "M_s": [2.2722e7, 2.6155e7],
        "c": [1.552548, 1.938721],
        "fitness": [3.611e-4, 3.296e-4],
    }


def test_the_printed_results_are_the_tables_and_the_largest_errors(published):
    printed = {(result.optimizer, result.metric): result.value for result in published.result}
    assert printed == {
        ("pso", "fitness"): 3.611e-4,
        ("mpso", "fitness"): 3.296e-4,
        ("pso", "max_error"): 0.3084,
        ("mpso", "max_error"): 0.2253,
    }
    assert published.iterations == 300


def test_every_audited_statement_with_arithmetic_is_borne_out(published):
    findings = audit(published)
    computed = [finding for finding in findings if finding.entry.arithmetic]
    assert len(computed) >= 15
    assert [finding.entry.where for finding in computed if not finding.borne_out] == []


def test_the_published_optimum_lies_inside_the_published_box(published):
    box, found = published.tables["table_1"].columns, published.tables["table_2"].columns
    for name, low, high in zip(box["parameter"], box["min"], box["max"], strict=True):
        assert all(low <= value <= high for value in found[name])
