"""An effect is named around a wrong law only where no law does without it."""

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.agreement import agreement, alike
from hysteresis_bench.diagnosis.doubt.cause import Cause
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.doubt.other_laws import Contender


def law(name, rmse, *effects):
    return Contender(name, effects, np.array([rmse]))


ASKED = law("asked", 5.0, "input-lag", "saturation")


def test_what_every_law_needs_is_agreed_and_the_others_are_told_in_their_order():
    agreed = agreement(ASKED, [law("b", 3.0, "input-lag"), law("a", 2.0, "input-lag"), law("c", 4.0, "input-lag")])
    assert list(agreed.needs) == ["asked", "a", "b", "c"]
    assert agreed.effects == {"input-lag": ()}


def test_one_law_that_does_without_is_enough_to_doubt_an_effect():
    agreed = agreement(ASKED, [law("a", 2.0, "input-lag"), law("b", 3.0, "input-lag"), law("c", 4.0)])
    assert agreed.effects == {}
    assert agreed.without("input-lag") == "c does without"


def test_effects_that_are_mistaken_for_each_other_count_as_one_and_the_frequent_one_is_told():
    others = [law("a", 2.0, "eddy-current"), law("b", 3.0, "input-lag"), law("c", 4.0, "resonance", "fatigue")]
    agreed = agreement(ASKED, others)
    assert agreed.effects == {"input-lag": ("eddy-current", "resonance")}


def test_two_like_effects_are_both_told_where_every_law_needs_two():
    others = [
        law("a", 2.0, "creep", "resonance"),
        law("b", 3.0, "creep", "input-lag"),
        law("c", 4.0, "creep", "resonance"),
    ]
    agreed = agreement(law("asked", 5.0, "resonance", "creep"), others)
    assert agreed.effects == {"creep": (), "resonance": ("input-lag",)}
    assert {*Doubt(None, agreed).holding(["creep", "resonance"])} == {"creep", "resonance"}


def test_what_has_no_dynamics_is_part_of_a_law_however_many_need_it():
    others = [law(name, 2.0, "saturation", "backlash", "asymmetry", "creep") for name in "abc"]
    agreed = agreement(law("asked", 5.0, "saturation", "backlash", "asymmetry", "creep"), others)
    assert agreed.effects == {"creep": ()}
    assert "shape" in agreed.without("backlash")


def test_without_a_witness_only_a_part_of_the_shape_is_refused():
    assert agreement(ASKED, []).effects == {"input-lag": ()}


def test_likeness_goes_both_ways_and_a_place_inside_the_law_is_no_likeness():
    assert alike("input-lag", "eddy-current")
    assert alike("eddy-current", "input-lag")
    assert alike("drift", "fatigue")  # of one family
    assert not alike("backlash", "eddy-current")
    assert not alike("saturation", "input-lag")


def test_without_a_doubt_all_that_was_adopted_holds():
    assert Doubt().holding(["creep", "saturation"]) == {"creep": (), "saturation": ()}
    assert Doubt().asks_for(["creep"]) == []


def test_of_two_like_effects_only_the_one_that_the_better_law_needs_holds():
    doubted = Doubt(Cause("better", ("saturation",), 1.0, 5.0))
    assert list(doubted.holding(["asymmetry", "backlash", "saturation"])) == ["saturation"]
    assert list(doubted.holding(["asymmetry", "backlash"])) == ["asymmetry"]  # in its place
    assert doubted.asks_for(["backlash"]) == ["saturation"]


def test_beside_an_agreement_only_what_the_better_law_needs_too_holds():
    agreed = agreement(ASKED, [law(name, 2.0, "input-lag", "drift") for name in "abc"])
    assert Doubt(None, agreed).holding(["resonance"]) == {"resonance": ("input-lag",)}
    assert Doubt(Cause("better", ("saturation",), 1.0, 5.0), agreed).holding(["input-lag"]) == {}


def test_free_forms_far_from_the_noise_are_no_names_and_what_is_named_beside_them_holds():
    doubted = Doubt(free=("lags-before",))
    assert doubted.holding(["creep", "lags-before"]) == {"creep": ()}
    assert doubted.asks_for(["creep", "lags-before"]) == []


def test_what_a_law_says_to_be_its_own_shape_is_not_held_and_the_rest_is():
    doubted = Doubt(own={"cubic-stiffness": "with another curve it does the same"})
    assert doubted.raised
    assert not doubted.of_the_law
    assert doubted.undecided
    assert doubted.holding(["cubic-stiffness", "resonance"]) == {"resonance": ()}


def test_shapes_that_laws_call_their_own_are_effects_that_are_tried():
    for law in registry.names("models"):
        for name, why in registry.build("models", law).own_shapes.items():
            assert name in registry.names("effects")
            assert why[0].islower()
            assert why[-1].isalpha()
