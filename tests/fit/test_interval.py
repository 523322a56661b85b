"""Intervals beside predictions: what they hold of unseen excitations, and where they say that they need not."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench import FitOptions, fit, measure
from hysteresis_bench.cli import main
from hysteresis_bench.fit.model_file import read_model, write_model
from hysteresis_bench.signals import Dataset

SEEN, UNSEEN = ("slow", "fast", "nested"), ("sweep", "mixed", "stairs")
QUICK = FitOptions(budget=2000)


def data(names, maker="bouc-wen", imperfect=""):
    return measure("hidden-effects", *names, settings={"model": maker, "imperfect": imperfect})


def within(model, measured, level):
    predicted = model.predict(measured, level)
    pairs = zip(measured.records, predicted.records, strict=True)
    return [np.mean(np.abs(old.output - new.output) <= new.columns["output_high"] - new.output) for old, new in pairs]


@pytest.fixture(scope="module")
def model():
    return fit(data(SEEN), "bouc-wen", ["bias"], options=QUICK).model


@pytest.mark.parametrize(
    ("law", "maker", "imperfect"),
    [
        ("bouc-wen", "bouc-wen", ""),
        ("bouc-wen", "bouc-wen", "coloured"),
        ("dahl", "bouc-wen", ""),
        ("bouc-wen", "jiles-atherton", "coloured"),
    ],
)
def test_what_was_not_seen_lies_within(law, maker, imperfect):
    found = fit(data(SEEN, maker, imperfect), law, ["bias"], options=QUICK).model
    for level in (50, 90, 99):
        shares = within(found, data(UNSEEN, maker, imperfect), level)
        assert np.mean(shares) > level / 100 - 0.05, (level, shares)
        assert min(shares) > level / 100 - 0.2, (level, shares)


def test_it_is_no_wider_than_the_noise_asks(model):
    assert model.interval.records == 3
    assert np.mean(within(model, data(UNSEEN), 90)) < 0.95
    assert np.mean(within(model, data(UNSEEN), 50)) < 0.6


def test_held_out_records_count_as_they_are():
    lagging = measure("hidden-effects", "slow", "sweep", settings={"effects": ["input-lag"]})
    alone, held = Dataset(lagging.records[:1]), lagging.split(["sweep"])
    one, two = (fit(records, "bouc-wen", options=QUICK).model.interval for records in (alone, held))
    assert (one.records, two.records) == (0, 1)
    assert two.half_widths[90] > 1.5 * one.half_widths[90]
    assert "nothing is known of others" in one.words(90, "um")
    assert "with a probability of 50%" in two.words(90, "um")


def test_without_an_output_it_holds_the_zeros_of_other_records():
    seen, unseen = data((*SEEN, "sweep", "stairs")), data(("mixed",))
    zeros = dict(zip(seen.names, (0.0, 2.1, -1.7, 0.9, -0.6), strict=True))
    moved = seen.map(lambda record: replace(record, output=record.output + zeros[record.name]))
    found = fit(moved, "bouc-wen", ["record-offset"], options=QUICK).model
    (own,) = within(found, unseen, 90)
    assert own > 0.85
    blind = found.predict(unseen.map(lambda record: replace(record, output=None)), 90).records[0]
    measured = unseen.records[0].output
    assert 1.7 < np.max(blind.columns["output_high"] - blind.output) < 2.4
    for zero in (-1.6, 0.0, 1.6):
        inside = np.abs(measured + zero - blind.output) <= blind.columns["output_high"] - blind.output
        assert np.mean(inside) > 0.9
    assert "where no output was measured" in found.interval.words(90, "um", measured=False)
    assert "where no output" not in found.interval.words(90, "um")


def test_without_an_output_it_is_the_same_where_records_have_nothing_of_their_own(model):
    assert model.interval.unmeasured == model.interval.half_widths


def test_what_lies_beyond_the_fit_is_told(model):
    (record,) = data(("slow",)).records
    ranges = model.data["ranges"]["input"]
    assert list(model.interval.beyond(record, ranges)) == []
    (wide,) = model.interval.beyond(replace(record, input=1.1 * record.input), ranges)
    assert "beyond the fitted inputs" in wide
    (fast,) = model.interval.beyond(replace(record, time=record.time / 10.0), ranges)
    assert "times the fastest fitted record's speed" in fast
    again = record.time + record.time[-1] + record.time[1]
    twice = replace(record, time=np.append(record.time, again), input=np.tile(record.input, 2), output=None)
    (long,) = model.interval.beyond(twice, ranges)
    assert "it lasts 2 times as long as the longest fitted record" in long
    index = {**record.units, "time": "sample"}
    assert list(model.interval.beyond(replace(record, time=record.time / 10.0, units=index), ranges)) == []


@pytest.mark.parametrize("imperfect", ["", "noisy-input", "coarse", "uneven"])
def test_an_input_that_rests_longer_is_told(model, imperfect):
    mixed, stairs = data(("mixed", "stairs"), imperfect=imperfect).records
    ranges = model.data["ranges"]["input"]
    assert not any("stays where it is" in said for said in model.interval.beyond(mixed, ranges))
    (said,) = [said for said in model.interval.beyond(stairs, ranges) if "stays where it is" in said]
    assert "where the device creeps or relaxes" in said


def test_the_file_keeps_it_and_older_ones_have_none(model, tmp_path):
    path = tmp_path / "model.json"
    write_model(path, model)
    assert read_model(path).interval == model.interval
    content = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps({**content, "interval": {"half_widths": {}}}), encoding="utf-8")
    done = CliRunner().invoke(main, ["predict", str(path), "x.csv", "--out", str(tmp_path / "p.csv")])
    assert done.exit_code == 2
    assert "is missing or wrong" in " ".join(done.output.split())
    del content["interval"]
    path.write_text(json.dumps(content), encoding="utf-8")
    old = read_model(path)
    assert old.interval is None
    assert "output_low" not in old.predict(data(("mixed",))).records[0].columns


def test_predict_writes_and_tells_it(model, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_model(tmp_path / "model.json", model)
    (record,) = data(("mixed",)).records
    pd.DataFrame({"time [s]": record.time, "input": record.input, "output": record.output}).to_csv("mixed.csv")
    command = ["predict", "model.json", "mixed.csv", "--interval", "68"]
    said = " ".join(CliRunner().invoke(main, [*command, "--out", "p.csv"]).output.split())
    assert "of its samples within the interval" in said
    assert f"68 % interval: ±{model.interval.half_widths[68]:.3g}, the widest of 3 records predicted unseen" in said
    table = pd.read_csv("p.csv")
    assert np.allclose(table["output_high"] - table["output_low"], 2.0 * model.interval.half_widths[68])
    told = json.loads(CliRunner().invoke(main, [*command, "--out", "q.csv", "--json"]).output)
    assert told["records"]["mixed"]["within"] == within(model, Dataset((record,)), 68)[0]
