"""Of laws that were not given, one without a curve goes before one with it, where it predicts about as well."""

from types import SimpleNamespace

import pytest

from hysteresis_bench.diagnosis.diagnose import _preferred


def found(unseen, *effects):
    return SimpleNamespace(unseen=unseen, floor=1.0, effects=effects)


@pytest.mark.parametrize(
    ("curved", "plain", "preferred"),
    [
        (found(1.15, "output-curve"), found(1.24), 1),  # leaves more than half of the other's excess: a law's shape
        (found(1.15, "output-curve"), found(1.4), 0),
        (found(0.99, "saturation"), found(3.0), 0),
        (found(1.15, "creep"), found(1.24), 0),  # has dynamics, which no law's shape makes
        (found(1.15, "output-curve"), found(1.24, "asymmetry"), 0),
        (found(1.24, "output-curve"), found(1.15), 1),
    ],
)
def test_a_curve_makes_another_law(curved, plain, preferred):
    assert _preferred([curved, plain]) is (curved, plain)[preferred]
