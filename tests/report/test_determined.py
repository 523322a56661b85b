"""What the standard errors say of the parameters, in words."""

import pytest

from hysteresis_bench.report.study.determined import WELL, how_well


def analysis(*shares, sentences=()):
    """Parameters a, b, ... of value 2 with these standard errors, as shares of it; None is not known."""
    errors = [None if share is None else 2.0 * share for share in shares]
    return {"names": "abcd"[: len(shares)], "values": [2.0] * len(shares), "standard_errors": errors} | {
        "sentences": list(sentences)
    }


@pytest.mark.parametrize(
    ("shares", "told"),
    [
        ((0.01, 0.1), ["All parameters are well determined; the least of them, b, to 10\u202f%."]),
        ((0.0, 1e-9), ["All parameters are well determined."]),
        ((0.01, 0.77), ["b is known to 77\u202f% only."]),
        (
            (0.46, 2.0, 3.0),
            ["a is known to 46\u202f% only.", "The standard error of b and c is larger than the values."],
        ),
        ((WELL, WELL), ["All parameters are well determined; the least of them, b, to 20\u202f%."]),
    ],
)
def test_all_are_well_determined_only_where_every_standard_error_is_small(shares, told):
    assert list(how_well(analysis(*shares))) == told


def test_beside_a_direction_that_nobody_sees_nothing_is_well_determined():
    blind = ["d and b act only through d b: fix one, for example d."]
    assert list(how_well(analysis(0.01, None, sentences=blind))) == []
    assert list(how_well(analysis(0.46, None, sentences=blind))) == ["a is known to 46\u202f% only."]
