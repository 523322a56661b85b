"""The headline of a diagnosis: every reason once."""

from types import SimpleNamespace as Of

from hysteresis_bench.diagnosis.doubt.agreement import Agreement
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.findings.words import Outcome, headline, warnings


def outcome_of(adopted, needs, rmse=0.3, held_out=None, slow=False):
    held = None if held_out is None else Of(rmse=held_out)
    stage = Of(held_out=held, fitted=Of(rmse=rmse), problem=Of(system=None), values=None)
    evidence = Of(noise=Of(floor=0.1), floor=0.1)
    final = Of(names=frozenset(), at_bound=(), values={})
    full = Of(stack=Of(records=(), model=Of(advice=lambda _: ())))
    return Outcome(
        before=stage,
        after=stage,
        adopted=adopted,
        found=Of(follows=True, evidence=evidence, final=final, full=full, given_up=None),
        ties=(),
        left=Of(matters=not slow and rmse > 0.11, slow=slow),
        units={"output": "um"},
        model="dahl",
        doubt=Doubt(agreement=Agreement(needs, dict.fromkeys(needs, 0.3), {})) if needs else Doubt(),
        alone=False,
    )


def test_stand_ins_are_told_together_where_the_reason_is_one():
    needs = {"dahl": ("input-lag", "bias"), "lugre": ()}
    said = headline(outcome_of(("bias", "saturation", "input-lag"), needs))
    shape = "bias and saturation (without dynamics, any law may have the like in its shape)"
    assert f"{shape}, and input-lag (lugre does without) may stand in for the law." in said
    assert said.count("dynamics") == 1


def test_a_stand_in_alone_is_told_with_its_reason():
    said = headline(outcome_of(("input-lag",), {"dahl": ("input-lag",), "lugre": ()}))
    assert said.endswith("input-lag (lugre does without) may stand in for the law.")


def test_a_law_that_comes_down_to_the_noise_is_not_said_to_fail():
    needs = {"dahl": ("input-lag",), "lugre": ()}
    far, near = (headline(outcome_of(("input-lag",), needs, rmse)) for rmse in (0.3, 0.1))
    assert "The law itself does not follow the data, and no other one here does clearly better." in far
    assert "The law alone does not follow the data, and does with what is around it." in near
    assert "itself" not in near
    far, near = (" ".join(warnings(outcome_of(("input-lag",), needs, rmse=rmse))) for rmse in (0.3, 0.1))
    assert "The final system still leaves 3 times the noise" in far
    assert "still leaves" not in near


def test_what_does_not_predict_the_held_out_records_is_not_said_to_explain_the_data():
    sound = outcome_of(("creep",), {}, rmse=0.1, held_out=0.12)
    assert not sound.unexplained
    assert not sound.doubtful
    missed = outcome_of(("creep",), {}, rmse=0.1, held_out=2.1)
    assert missed.unexplained
    assert missed.doubtful
    assert "may lack creep" in headline(missed)
    assert headline(missed).endswith("What was held out is missed by 21 times the noise: something is lacking.")
    noisy = outcome_of(("creep",), {}, rmse=0.3, held_out=0.35, slow=True)
    assert not noisy.unexplained, "slow noise is in both alike"
    assert not noisy.doubtful
    assert outcome_of(("creep",), {}, rmse=0.3, held_out=2.1, slow=True).unexplained


def test_agreement_on_what_was_fitted_does_not_vouch_for_names_that_fail_on_what_was_held_out():
    needs = {"dahl": ("input-lag",), "bouc-wen": ("input-lag",), "lugre": ("input-lag",)}
    assert not outcome_of(("input-lag",), needs, rmse=0.3, held_out=0.35).doubtful
    assert outcome_of(("input-lag",), needs, rmse=0.12, held_out=1.6).doubtful
