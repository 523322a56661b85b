"""The audit's arithmetic: what it can say, what it refuses, and what becomes of a wrong statement."""

import math

import numpy as np
import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.report.paper.audit import audit
from hysteresis_bench.report.paper.expression import evaluate
from hysteresis_bench.report.paper.published import check_published

NAMES = {"E": 60000.0, "table": {"a": [1.0, 2.0, 6.0], "label": ["x", "y", "z"]}}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 - (log(2) / 70) ** (1 / 6)", 1 - (math.log(2) / 70) ** (1 / 6)),
        ("3.296e-4 * sqrt(E)", 3.296e-4 * math.sqrt(60000)),
        ("mean(table.a)", 3.0),
        ("max(table.a) - min(table.a)", 5.0),
        ("table.a[2] / table.a[0]", 6.0),
        ("mean([1, 2, 3] > 1)", 2 / 3),
        ("1 < 2 <= 2 and not 3 < 2", True),
        ("1 > 2 or 2 >= 3", False),
        ("all(table.a > 0)", True),
        ("-2 ** 2", -4.0),
    ],
)
def test_the_arithmetic(text, value):
    assert evaluate(text, NAMES) == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "E.__class__",
        "table.__class__",
        "(lambda: 1)()",
        "[x for x in table.a]",
        "open('/etc/passwd')",
        "'text'",
        "E if 1 else 2",
        "unknown + 1",
        "table.missing",
        "table.a[7]",
        "table.label",
        "mean(table.a, axis=0)",
        "1 +",
        "1 % 2",
        "1 / 0",
        "10.0 ** 400",
    ],
)
def test_what_is_no_arithmetic_is_refused(text):
    with pytest.raises(ValueError, match=r"expression|evaluated|called|no part|no table|no column|convert"):
        evaluate(text, NAMES)


def entry(**changes):
    return {"where": "eq. (1)", "printed": "x", "says": "y", "kind": "contradiction"} | changes


def findings(*entries, **more):
    return audit(check_published({"audit": list(entries)} | more))


def test_a_mean_that_does_not_match_its_column_is_found():
    table = {"title": "Table 4", "columns": {"signal": ["10 Hz", "20 Hz"], "error": [0.1, 0.3]}}
    right, wrong = findings(
        entry(arithmetic="mean(table_4.error)", expects=0.2),
        entry(arithmetic="mean(table_4.error)", expects=0.0823),
        tables={"table_4": table},
    )
    assert (right.value, right.borne_out) == (pytest.approx(0.2), True)
    assert wrong.borne_out is False


def test_a_name_carries_over_and_words_have_no_verdict():
    first, second, third = findings(
        entry(arithmetic="2 * 3", name="six", expects=6),
        entry(arithmetic="six > 5", expects=True),
        entry(),
    )
    assert first.borne_out is second.borne_out is True
    assert (third.value, third.borne_out) == (None, None)


def test_a_share_of_a_box_is_drawn_the_same_every_time():
    box = entry(arithmetic="mean(u > 0.3)", sample={"u": [0, 1]}, expects=0.7)
    logarithmic = entry(arithmetic="mean(u < 1)", sample={"u": [0.01, 100]}, scaling="log", expects=0.5)
    [linear, log], [again, _] = findings(box, logarithmic), findings(box, logarithmic)
    assert linear.borne_out is log.borne_out is True
    assert linear.value == again.value


def test_two_sampled_names_are_independent():
    [found] = findings(entry(arithmetic="mean(u > 0.5 and v > 0.5)", sample={"u": [0, 1], "v": [0, 1]}, expects=0.25))
    assert found.value == pytest.approx(0.25, abs=0.005)


def test_faulty_arithmetic_is_told_and_the_rest_goes_on():
    broken, many, fine = findings(
        entry(arithmetic="nothing + 1", expects=1),
        entry(arithmetic="[1, 2]", expects=1),
        entry(arithmetic="1 + 1", expects=2),
    )
    assert "nothing is called 'nothing'" in broken.fault
    assert "2 values" in many.fault
    assert (broken.borne_out, fine.borne_out) == (False, True)


def test_unknown_keys_of_a_published_file_are_told_all_at_once():
    with pytest.raises(UserError) as error:
        check_published({"audits": [], "claim": [{"say": "x"}]})
    for part in ('no key "audits"', 'Did you mean "audit"?', '[[claim]] 1: no key "say"', 'Did you mean "says"?'):
        assert part in str(error.value), part


def test_values_are_numbers_not_arrays_of_them():
    assert isinstance(evaluate("mean([1, 2])", {}), float)
    assert not isinstance(evaluate("1 < 2", {}), np.generic)
