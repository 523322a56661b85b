"""A model file that was edited by hand, and values that no record can be prepared or simulated with, are told."""

import json
from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import FitOptions, fit, measure
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import read_model, write_model
from hysteresis_bench.signals import Dataset

QUICK = FitOptions(budget=400)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    made = measure("hidden-effects", "slow", settings={"effects": ["input-lag"]})
    path = tmp_path_factory.mktemp("model") / "model.json"
    write_model(path, fit(made, "bouc-wen", ["input-lag"], options=QUICK).model)
    return path, json.loads(path.read_text(encoding="utf-8")), made


def edited(written, tmp_path, keys, value):
    content = json.loads(json.dumps(written[1]))
    place = content
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    (tmp_path / "model.json").write_text(json.dumps(content), encoding="utf-8")
    return tmp_path / "model.json"


@pytest.mark.parametrize(
    ("keys", "value", "words"),
    [
        (("parameters", "alpha"), 0.5, 'parameter "alpha": of value, standard_error, unit'),
        (("parameters", "alpha", "value"), "much", 'parameter "alpha"'),
        (("effects", 0, "parameters", "time_constant", "value"), -1.0, "time_constant = -1 must be at least 0"),
        (("preparation", "skip"), -5, "skip = -5 must be finite and at least 0"),
        (("preparation", "settle"), 10**9, "settle = 1000000000 must lie from 0 to"),
        (("interval", "half_widths", "90"), -1.0, "half_widths and unmeasured must not be below 0"),
    ],
)
def test_a_file_that_was_edited_says_where_it_is_wrong(written, tmp_path, keys, value, words):
    with pytest.raises(UserError, match=words):
        read_model(edited(written, tmp_path, keys, value))


def test_a_prediction_says_what_leaves_nothing_of_a_record(written, tmp_path):
    with pytest.raises(UserError, match="skipping 1e\\+09 s leaves nothing of it"):
        read_model(edited(written, tmp_path, ("preparation", "skip"), 1e9)).predict(written[2])
    with pytest.raises(UserError, match="beside an input offset of 1e\\+150 its input is constant"):
        read_model(edited(written, tmp_path, ("preparation", "input_offset"), 1e150)).predict(written[2])


def test_a_fit_says_what_an_offset_leaves_nothing_of(written):
    with pytest.raises(UserError, match="beside an input offset of 1e\\+150 its input is constant"):
        fit(written[2], "bouc-wen", options=replace(QUICK, input_offset=1e150))


def test_a_prediction_without_a_column_that_the_model_needs(written):
    (record,) = written[2].records
    temperature = 20.0 + 5.0 * np.sin(record.time)
    warm = Dataset((replace(record, columns={"temperature": temperature}),))
    model = fit(warm, "bouc-wen", ["temperature-sensitivity"], options=QUICK).model
    with pytest.raises(UserError, match="temperature-sensitivity needs a column temperature"):
        model.predict(Dataset((replace(record, columns={}),)))


def test_bounds_and_fixed_values_are_asked_at_once(written):
    with pytest.raises(UserError) as told:
        fit(written[2], "bouc-wen", bounds={"alfa": (0, 1), "beta": (0, 1)}, fixed={"betta": 1.0, "beta": 2.0})
    said = " ".join(told.value.faults)
    for words in ('bounds: no parameter "alfa"', 'fixed: no parameter "betta"', "beta is fixed and has bounds"):
        assert words in said
