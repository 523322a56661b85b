"""What is told of a law after others were asked."""

from types import SimpleNamespace as Of

import pytest

from hysteresis_bench.diagnosis import around
from hysteresis_bench.diagnosis.findings.remainder import Remainder

SLOW = Remainder(None, matters=False, slow=True, heavy=False, louder=False)


@pytest.mark.parametrize(
    ("records", "predicted", "noise"),
    [
        (4, True, False),
        (4, False, True),
        (1, True, True),  # of a lone record a smooth course of time predicts slow noise between its neighbours
    ],
)
def test_what_a_black_box_predicts_of_other_records_is_no_noise(monkeypatch, records, predicted, noise):
    monkeypatch.setattr(around, "remainder", lambda stage, evidence, parameters: SLOW)
    thin = Of(stack=Of(records=(None,) * records), fitted_values=lambda hypothesis: 4)
    found = Of(thin=thin, final=None, evidence=None, ceiling=Of(better=predicted))
    assert around._left(Of(after=None), found).noise is noise
