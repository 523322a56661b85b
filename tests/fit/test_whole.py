"""What is left out to judge a law: excitations within the range of the others, blocks of those that go further."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.fit.unseen.excitations import excitations
from hysteresis_bench.fit.unseen.whole import extrapolated, last_part, left_out
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 6.0, 1200)


def record(amplitude, name: str) -> Record:
    u = amplitude * np.sin(2.0 * np.pi * 2.0 * TIME)
    return Record(TIME, u, u, name=name)


def test_of_nested_amplitudes_the_smaller_ones_are_left_out_whole():
    records = [record(amplitude, str(amplitude)) for amplitude in (1.0, 8.0, 2.0, 4.0)]
    found = left_out(records)
    folds = np.split(found.blocks.fold, 4)
    assert [np.unique(part).size for part in folds] == [1, 4, 1, 1]
    assert len({int(part[0]) for part in (folds[0], folds[2], folds[3])}) == 3
    assert found.telling


def test_no_smoother_density_is_taken_where_the_least_error_is_what_to_expect():
    found = left_out([record(amplitude, str(amplitude)) for amplitude in (1.0, 8.0, 2.0, 4.0)])
    best = np.full(found.blocks.block.size, 1.0)
    other = 1.0 + 0.1 * np.random.default_rng(0).standard_normal(found.blocks.block.max() + 1)[found.blocks.block]
    assert found.as_good(best, other)
    assert not replace(found, like=True).as_good(best, other)


def lasting(share, name):
    return record(1.0, name).take(slice(0, int(share * TIME.size)))


@pytest.mark.parametrize(
    ("shares", "beyond"),
    [((1.0, 0.5, 0.7), {0}), ((1.0, 1.0, 0.5), set()), ((0.97, 1.0, 0.99), set()), ((1.0,), set())],
)
def test_the_record_that_lasts_longest_is_the_one_that_a_curve_of_time_is_extrapolated_on(shares, beyond):
    records = [lasting(share, str(k)) for k, share in enumerate(shares)]
    curves = [registry.build("effects", "gain-with-time", {})]
    assert extrapolated(curves, records) == beyond
    assert not extrapolated([registry.build("effects", "creep", {})], records)
    found = left_out(records, beyond)
    for k, fold in enumerate(np.split(found.blocks.fold, np.cumsum([one.time.size for one in records])[:-1])):
        assert (np.unique(fold).size > 1) == (k in beyond or len(records) == 1)


def test_one_smaller_amplitude_is_too_few_to_tell():
    assert not left_out([record(1.0, "small"), record(8.0, "large")]).telling


@pytest.mark.parametrize(("amplitude", "telling"), [(2.0, False), (np.linspace(2.0, 0.2, TIME.size), True)])
def test_a_lone_record_tells_of_other_amplitudes_only_where_it_has_some(amplitude, telling):
    assert left_out([record(amplitude, "alone")]).telling == telling


def test_a_lone_loop_is_cut_into_blocks():
    u = np.sin(np.linspace(0.0, 2.0 * np.pi, 300))
    found = left_out([Record(np.arange(300.0), u, u)])
    assert found.blocks.folds == 4
    assert not found.telling


def test_only_of_a_lone_record_is_the_last_part_predicted_from_what_came_before():
    alone = last_part([record(1.0, "alone")])
    assert alone.sum() == 400
    assert np.all(np.diff(alone.astype(int)) >= 0)
    assert not last_part([record(1.0, "one"), record(2.0, "other")]).any()


def test_the_last_part_goes_little_further_than_what_comes_before():
    growing = record(np.geomspace(0.001, 1.0, TIME.size), "growing")
    last = last_part([growing])
    assert last.any()
    assert np.ptp(growing.input) <= 1.6 * np.ptp(growing.input[~last])
    assert last.sum() < 400


def test_every_record_is_an_excitation_and_those_between_the_others_are_inner():
    found = excitations([record(amplitude, str(amplitude)) for amplitude in (1.0, 8.0, 2.0, 4.0)])
    assert found.apart == (0, 1, 2, 3)
    assert found.inner == (2, 3), "one more is smaller, one larger, than all others"
    assert found.varied


@pytest.mark.parametrize(("amplitude", "varied"), [(2.0, False), (np.linspace(2.0, 0.2, TIME.size), True)])
def test_cycles_of_a_lone_record_are_excitations_of_one_kind_or_of_several(amplitude, varied):
    found = excitations([record(amplitude, "alone")])
    assert len(found.apart) > 1
    assert not found.inner
    assert found.varied == varied
    assert np.isin(found.number, found.apart).mean() > 0.6


@pytest.mark.parametrize("periods", [1.0, 2.0])
def test_nothing_of_a_lone_loop_can_be_left_out(periods):
    """Nor of two: a half that begins in the middle does not cross it often enough."""
    u = np.sin(np.linspace(0.0, 2.0 * np.pi * periods, 300))
    found = excitations([Record(np.arange(300.0), u, u)])
    assert found.apart == ()
    assert found.only_one


def test_a_short_record_of_several_amplitudes_is_more_than_one_loop():
    phase = np.linspace(0.0, 2.5, 500)
    u = np.linspace(1.0, 0.3, phase.size) * np.sin(2.0 * np.pi * phase)
    found = excitations([Record(phase, u, u)])
    assert found.apart == ()
    assert not found.only_one
