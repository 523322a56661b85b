"""Data that cannot be diagnosed, or hardly: a clear verdict or message, never a confident wrong name."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record
from tests.diagnosis.generator import make


def first(dataset, **changes):
    record = dataset.records[0]
    return Record(**{"time": record.time, "input": record.input, "output": record.output, "name": "only", **changes})


def test_one_record_is_split_in_time():
    dataset = Dataset((first(make(3, "bouc-wen", hidden=(), noise=0.004).dataset),))
    found = diagnose(dataset, "bouc-wen", jobs=1)
    assert found.verdict == "no-effect-needed"
    assert found.effects == ()
    assert found.split["held_out"] == ["only, last third"]
    assert found.after.held_out == found.before.held_out


def test_no_noise_at_all_and_nothing_hidden():
    case = make(4, "bouc-wen", hidden=(), noise=0.0)
    found = diagnose(case.dataset, "bouc-wen", jobs=1)
    assert found.effects == ()
    assert found.verdict == "no-effect-needed"
    assert any("next to no noise" in warning for warning in found.warnings)


def test_constant_output():
    dataset = Dataset((first(make(3, "bouc-wen", hidden=()).dataset, output=np.full(400, 2.0)),))
    with pytest.raises(UserError, match="constant"):
        diagnose(dataset, "bouc-wen")


def test_output_that_has_nothing_to_do_with_the_input():
    rng = np.random.default_rng(8)
    time = np.linspace(0.0, 5.0, 400)
    walk = np.cumsum(rng.standard_normal(400))
    dataset = Dataset((first(make(3, "bouc-wen", hidden=()).dataset, time=time, output=walk),))
    found = diagnose(dataset, "bouc-wen", jobs=1)
    assert found.effects == ()
    assert found.verdict == "unexplained-residual"
    assert "does not follow the input" in found.headline


def test_constant_temperature_is_no_candidate():
    record = first(make(3, "bouc-wen", hidden=()).dataset, columns={"temperature": np.full(400, 21.0)})
    found = diagnose(Dataset((record,)), "bouc-wen", jobs=1)
    row = next(row for row in found.candidates if row.effect == "temperature-sensitivity")
    assert not row.applicable
    assert "never changes" in row.reason


def test_one_period_only():
    record = first(make(3, "bouc-wen", hidden=()).dataset)
    found = diagnose(Dataset((record.take(slice(0, 80)),)), "bouc-wen", jobs=1)
    assert found.effects == ()
    assert any("One record only" in warning for warning in found.warnings)


def test_unknown_model_and_too_few_samples_are_told_together():
    record = first(make(3, "bouc-wen", hidden=()).dataset)
    with pytest.raises(UserError, match="2 faults"):
        diagnose(Dataset((record.take(slice(0, 12)),)), "bouc-when")
