"""The headline of a diagnosis: every reason once."""

from types import SimpleNamespace as Of

from hysteresis_bench.diagnosis.doubt.agreement import Agreement
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.findings.words import Outcome, headline, warnings


def outcome_of(adopted, needs, rmse=0.3):
    stage = Of(held_out=None, fitted=Of(rmse=rmse))
    evidence = Of(noise=Of(floor=0.1), floor=0.1)
    final = Of(names=frozenset(), at_bound=(), values={})
    full = Of(stack=Of(records=(), model=Of(advice=lambda _: ())))
    return Outcome(
        before=stage,
        after=stage,
        adopted=adopted,
        found=Of(follows=True, evidence=evidence, final=final, full=full, given_up=None),
        ties=(),
        left=Of(matters=True, slow=False),
        units={"output": "um"},
        model="dahl",
        doubt=Doubt(agreement=Agreement(needs, dict.fromkeys(needs, 0.3), {})),
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
