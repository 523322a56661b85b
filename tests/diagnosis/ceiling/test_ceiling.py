"""What a black box reaches on excitations left out: never less than the noise, and more than a wrong model."""

from dataclasses import asdict, replace

import numpy as np
import pytest
from numpy.random import default_rng

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.ceiling.ceiling import Ceiling, ceiling
from hysteresis_bench.diagnosis.evidence.noise import pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import floor_of
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.signals import INDEX, Record
from tests.diagnosis.generator import make

HONEST = 0.95
"""Of the noise's RMS: its scatter over 1600 samples is 0.02, over 400 it is 0.04."""


def reached(records, model: str = "bouc-wen", offset: str = registry.RECORD_OFFSET) -> Ceiling:
    """By the bare model, and by the black box."""
    views = views_of(records)
    noise = pooled_noise([view.noise for view in views])
    fitter = Fitter(Stack(registry.build("models", model, {}), tuple(records)))
    return ceiling(fitter, fitter.bare(frozenset({offset})), floor_of(views, noise), noise)


@pytest.fixture(scope="module")
def lagged() -> tuple[Record, ...]:
    return make(1, "bouc-wen", ("output-lag",), 0.005).dataset.fitted


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("offset", registry.OFFSETS)
def test_nothing_predicts_noise(count, offset):
    """Neither a sample that is left out, nor one beside it, leaks into what predicts it."""
    rng, time = default_rng(count), np.linspace(0.0, 5.0, 400)
    records = [
        Record(time, np.sin((2.0 + k) * time), rng.standard_normal(time.size), name=str(k)) for k in range(count)
    ]
    noise = float(np.std(np.concatenate([record.measured for record in records])))
    found = reached(records, offset=offset)
    assert min(found.black_box, found.alone) > HONEST * noise
    assert not found.better


@pytest.mark.parametrize("model", ["bouc-wen", "jiles-atherton", "free-energy"])
def test_the_right_law_leaves_nothing_and_the_black_box_hears_the_noise(model):
    case = make(3, model, (), 0.005)
    found = reached(case.dataset.fitted, model)
    assert found.reached
    assert "comes down to the noise" in found.words
    assert HONEST * case.noise < found.black_box < 1.1 * found.named
    assert found.alone > HONEST * case.noise


def test_beside_a_wrong_law_the_black_box_does_better():
    case = make(2, "jiles-atherton", (), 0.003)
    found = reached(case.dataset.fitted, "dahl")
    assert found.better
    assert HONEST * case.noise < found.black_box < 0.6 * found.named
    assert "clearly better" in found.words


def test_a_lag_is_found_by_lags_and_not_without_a_clock(lagged):
    found = reached(lagged)
    blind = reached([replace(record, units={**record.units, "time": INDEX}) for record in lagged])
    assert found.better
    assert "lags" in found.columns
    assert found.black_box < 0.7 * blind.black_box


def test_a_temperature_that_was_measured_is_known_to_the_black_box():
    case = make(4, "bouc-wen", ("temperature-sensitivity",), 0.005)
    found = reached(case.dataset.fitted)
    ignorant = reached([replace(record, columns={}) for record in case.dataset.fitted])
    assert found.better
    assert found.black_box < 0.7 * ignorant.black_box


def test_what_nobody_measured_is_not_found():
    """A load that comes and goes as it likes is no function of the input."""
    case = make(5, "bouc-wen", (), 0.002)
    rng, records = default_rng(0), []
    for record in case.dataset.fitted:
        load = np.convolve(rng.standard_normal(record.time.size + 40), np.ones(41) / 41, "valid")
        records.append(replace(record, output=record.measured + 0.1 * np.ptp(record.measured) * load))
    found = reached(records)
    assert not found.reached
    assert not found.better
    assert "measure another quantity" in found.words


def test_the_order_of_records_changes_nothing(lagged):
    first, again, turned = reached(lagged), reached(lagged), reached(lagged[::-1])
    assert first == again
    assert (turned.black_box, turned.alone) == pytest.approx((first.black_box, first.alone), rel=1e-3)


def test_the_named_model_is_judged_on_whole_records_as_elsewhere(lagged):
    fitter = Fitter(Stack(registry.build("models", "bouc-wen", {}), lagged))
    named = fitter.bare(frozenset({registry.RECORD_OFFSET}))
    noise = pooled_noise([view.noise for view in views_of(lagged)])
    found = ceiling(fitter, named, noise.rms, noise)
    assert found.left_out == "whole records"
    assert found.named == pytest.approx(float(np.sqrt(np.mean(fitter.unseen(named) ** 2))), rel=1e-3)


def test_of_a_record_that_goes_further_blocks_are_left_out():
    time = np.linspace(0.0, 10.0, 500)
    records = [
        Record(time, size * np.sin(2.0 * time), size * np.sin(2.0 * time - 0.2), name=name)
        for name, size in (("small", 1.0), ("middle", 2.0), ("large", 8.0))
    ]
    found = reached(records)
    assert "large" in found.left_out
    assert "small" not in found.left_out


@pytest.mark.parametrize(
    ("named", "black_box", "advantage", "said"),
    [
        (1.05, 1.0, 9.0, "comes down to the noise"),
        (2.0, 1.2, 3.0, "does clearly better"),
        (2.0, 1.2, 1.0, "does not do clearly better"),
        (2.0, 1.99, 9.0, "does not do clearly better"),
        (2.0, 2.5, -3.0, "measure another quantity"),
        (1.6, 1.6, 0.0, "no more than repeats differ by"),
    ],
)
def test_better_is_what_is_clear_and_matters(named, black_box, advantage, said):
    found = Ceiling(named, black_box, black_box, advantage, "past extrema", "whole records", 4, "um", 1.0, 0.9, 1.5)
    assert said in found.words
    assert f"{named:.3g} um" in found.words
    assert "repeats differ by 1.5" in found.words
    assert found.as_dict()["words"] == found.words
    assert found.finds_nothing == ("does not do clearly better" in found.words)


def test_a_noise_that_was_put_too_high_hides_nothing():
    """As where few samples a cycle leave much between them."""
    found = Ceiling(12.0, 2.5, 2.5, 8.0, "past extrema", "whole records", 4, "um", 15.0, 1.0, None)
    assert found.better
    assert not found.reached


def test_of_two_excitations_little_is_said():
    found = Ceiling(18.0, 17.0, 17.0, 1.0, "past extrema", "whole records", 2, "um", 1.0, 1.0, None)
    assert "says little" in found.words
    assert not found.finds_nothing


def test_nothing_else_is_to_be_measured_where_what_is_left_is_told_elsewhere():
    found = Ceiling(4.0, 4.1, 4.1, -1.0, "past extrema", "whole records", 4, "um", 1.0, 1.0, None)
    assert found.words.endswith("or add excitations.")
    known = replace(found, told=True)
    assert known.words.endswith("smooth course of time or path.")
    assert found.words.startswith(known.words)
    assert set(known.as_dict()) == {*asdict(known), "reached", "clearly_better", "words"} - {"told", "law"}
    another = replace(found, law=True)
    assert another.words.endswith("does not do clearly better; another law does.")
