"""Which law is taken: what a richer one gains must be more than its parameters are worth on so many blocks."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench.diagnosis.laws.choice import choose, ranking
from hysteresis_bench.diagnosis.laws.law import Law
from hysteresis_bench.fit.smooth.smoothing import _unchosen
from hysteresis_bench.fit.unseen.blocks import blocked

PLAIN = 10.0


def law(name: str, error: float, parameters: int) -> Law:
    return Law(name, unseen=np.full(400, error), parameters=parameters)


@pytest.mark.parametrize(("blocks", "chosen"), [(20, "dahl"), (200, "preisach")])
def test_a_richer_law_needs_more_blocks(blocks, chosen):
    laws = [law("preisach", 1.0, 19), law("dahl", 1.2, 5)]
    name, words = choose(laws, PLAIN, blocked([400], [blocks], 4))
    assert name == chosen
    assert ("5 parameters in place of 19" in words) == (chosen == "dahl")


def test_parameters_do_not_weigh_where_what_is_asked_is_like_what_was_left_out():
    laws = [law("preisach", 1.0, 19), law("dahl", 1.2, 5)]
    name, words = choose(laws, PLAIN, blocked([400], [20], 4), like=True)
    assert name == "preisach"
    assert "its 19 parameters, in place of the 5 of dahl, do not weigh" in words


@pytest.mark.parametrize(("noise", "first"), [(1.0, "dahl"), (0.9, "preisach")])
def test_at_the_noise_equal_laws_are_ranked_by_their_parameters(noise, first):
    laws = [law("preisach", 1.0, 6), law("dahl", 1.015, 5), law("bouc-wen", 1.05, 4), Law("lugre", "why not")]
    wearing = replace(law("bouc-wen-generalized", 0.5, 4), gap=0.1)
    away = replace(law("polynomial", 0.5, 3), outside=0.9)
    found = ranking([*laws, wearing, away], noise, blocked([400], [100], 4))
    assert found[0] == first
    assert found[-2:] == ("bouc-wen-generalized", "polynomial")  # moves on in a settled loop; runs away


def test_no_law_is_taken_where_the_polynomial_does_better():
    assert choose([law("dahl", 11.0, 5), Law("lugre", "why not")], PLAIN, blocked([400], [20], 4))[0] == ""


def test_a_law_that_runs_away_is_not_taken():
    laws = [replace(law("dahl", 1.0, 5), outside=0.45), law("lugre", 1.1, 7), law("bouc-wen", 2.0, 4)]
    name, words = choose(laws, PLAIN, blocked([400], [200], 4))
    assert name == "lugre"
    assert "Not taken: dahl (45 % of it), beyond the range of the fitted outputs" in words
    alike = [replace(one, outside=0.45) for one in laws]  # as where the device itself goes on
    assert choose(alike, PLAIN, blocked([400], [200], 4))[0] == "dahl"


def test_a_fold_is_judged_by_what_the_others_chose():
    blocks = blocked([8], [4], 2)
    first, second = blocks.fold == 0, blocks.fold == 1
    chosen, other = np.where(first, 1.0, 3.0), np.where(first, 5.0, 2.0)
    found = _unchosen(chosen, [other], blocks)
    np.testing.assert_array_equal(found[first], 5.0)  # without it, the other one does best
    np.testing.assert_array_equal(found[second], 3.0)
