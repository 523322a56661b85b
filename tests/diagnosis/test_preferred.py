"""Of laws that were not given, one without a curve goes before one with it, where it predicts about as well."""

from types import SimpleNamespace as Of

import pandas as pd
import pytest

from hysteresis_bench.diagnosis.around import Standing
from hysteresis_bench.diagnosis.diagnose import _preferred, _told


def found(unseen, *effects, parameters=5):
    return Standing("law", effects, parameters, unseen, 1.0)


@pytest.mark.parametrize(
    ("curved", "plain", "preferred"),
    [
        (found(1.15, "output-curve"), found(1.24), 1),  # leaves more than half of the other's excess: a law's shape
        (found(1.15, "output-curve"), found(1.4), 0),
        (found(0.99, "saturation"), found(3.0), 0),
        (found(1.15, "creep"), found(1.24), 0),  # has dynamics, which no law's shape makes
        (found(1.15, "output-curve"), found(1.24, "asymmetry"), 0),
        (found(1.24, "output-curve"), found(1.15), 1),
        (found(0.99, "saturation"), found(1.0), 1),
    ],
)
def test_a_curve_makes_another_law(curved, plain, preferred):
    assert _preferred([curved, plain]) is (curved, plain)[preferred]


def test_of_those_that_predict_to_the_noise_the_simplest_is_taken():
    dynamic, simple, simpler = found(1.0, parameters=7), found(1.01, "output-lag"), found(1.05, parameters=4)
    assert _preferred([dynamic, simple, simpler]) is simple


@pytest.mark.parametrize(("unseen", "told"), [(0.3, True), (0.6, False)])
def test_a_density_that_predicts_better_alone_is_told(unseen, told):
    """No effect is sought around a law of so many parameters."""
    table = pd.DataFrame({"law": ["preisach-hats", "dahl"], "unseen": [unseen, 0.7]})
    laws = Of(words="Words.", table=table, ranked=("preisach-hats", "dahl"))
    said = _told(Of(model_name="dahl", unseen=0.5), [], laws)
    assert ("preisach-hats alone predicts it to 0.3" in said) is told
