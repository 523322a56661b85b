"""How sure a name is: what the bootstrap counts, and what the probability must do."""

import numpy as np
import pytest

from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.certainty import Certainty, frequencies
from hysteresis_bench.fit.unseen.blocks import blocked

BLOCKS = blocked([960], [48], 4)


def hypothesis(names, left_out, parameters=3):
    values = {str(number): 0.0 for number in range(parameters)}
    return Hypothesis(frozenset(names), values, left_out, left_out, ())


def test_what_wins_everywhere_is_always_taken_and_a_coin_is_taken_half_of_the_time():
    rng = np.random.default_rng(1)
    noise = rng.standard_normal(960)
    good, bad = hypothesis({"creep"}, noise), hypothesis({"drift"}, 3.0 * noise)
    assert frequencies([good, bad], BLOCKS, ["creep", "drift"], 0) == {"creep": 1.0, "drift": 0.0}
    halves = np.where(np.arange(960) % 40 < 20, 3.0, 1.0)  # each is three times as wrong on every other block
    one, other = hypothesis({"creep"}, halves), hypothesis({"drift"}, 4.0 - halves)
    found = frequencies([one, other], BLOCKS, ["creep", "drift"], 0)
    assert found["creep"] + found["drift"] == pytest.approx(1.0)
    assert 0.3 < found["creep"] < 0.7


def test_of_those_about_as_good_the_one_of_fewest_parameters_is_taken():
    left = np.random.default_rng(2).standard_normal(960)
    small, large = hypothesis(set(), 1.005 * left, 2), hypothesis({"creep"}, left, 4)
    assert frequencies([small, large], BLOCKS, ["creep"], 0) == {"creep": 0.0}


def test_the_same_seed_gives_the_same_frequencies():
    rng = np.random.default_rng(3)
    pair = [hypothesis({"creep"}, rng.standard_normal(960)), hypothesis({"drift"}, rng.standard_normal(960))]
    assert frequencies(pair, BLOCKS, ["creep"], 7) == frequencies(pair, BLOCKS, ["creep"], 7)


def test_what_is_left_makes_a_name_less_sure_and_no_name_is_certain():
    clean, left = Certainty(1.0, 1.0, 1, 0), Certainty(1.0, 1.15, 1, 0)
    assert 0.0 < left.probability < clean.probability < 1.0
    assert Certainty(1.0, 2.0, 1, 0).probability is None  # of so much left the made cases know too little
    assert Certainty(1.0, 1.0, 3, 0).probability < clean.probability
