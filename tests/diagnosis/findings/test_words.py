"""The headline of a diagnosis: every reason once."""

from dataclasses import dataclass, replace
from types import SimpleNamespace as Of

from hysteresis_bench.diagnosis.doubt.agreement import Agreement
from hysteresis_bench.diagnosis.doubt.cause import Cause
from hysteresis_bench.diagnosis.doubt.doubt import Doubt
from hysteresis_bench.diagnosis.findings.remainder import Remainder
from hysteresis_bench.diagnosis.findings.words import Outcome, headline, warnings
from hysteresis_bench.diagnosis.search.fallback import Fallback


@dataclass(frozen=True)
class Silent:
    """A law without advice."""

    parts: int = 4

    def advice(self, records):
        return ()


def outcome_of(adopted, needs, rmse=0.3, held_out=None, slow=False, held_out_before=None, **more):
    """held_out_before : as `held_out` where None;  more : of the search's findings"""
    held = None if held_out is None else Of(rmse=held_out)
    between = more.get("between", 0.0)
    known = {"names": (), "problem": Of(system=None), "values": None, "between": between, "constant": 0.0}
    known["missed"] = rmse if held_out is None else held_out
    stage = Of(held_out=held, fitted=Of(rmse=rmse), **known)
    bare = replace_held_out(stage, held_out_before) if held_out_before else stage
    evidence = Of(noise=Of(floor=0.1), floor=0.1, unknown=0.0, told="the noise is 0.1")
    final = Of(names=frozenset(), at_bound=(), values={})
    full = Of(stack=Of(records=(), model=Silent()))
    return Outcome(
        before=bare,
        after=stage,
        adopted=adopted,
        found=Of(
            follows=True,
            evidence=evidence,
            final=final,
            full=full,
            given_up=more.get("given_up"),
            ceiling=Of(finds_nothing=more.get("finds_nothing", False)),
        ),
        ties=(),
        left=Remainder(
            equation=None,
            matters=not slow and rmse > 0.11,
            slow=slow,
            heavy=False,
            louder=(held_out or 0.0) > 1.25 * max(rmse, 0.1),
            shape=more.get("shape", ""),
        ),
        units={"output": "um"},
        model="dahl",
        doubt=Doubt(agreement=Agreement(needs, dict.fromkeys(needs, 0.3), {})) if needs else Doubt(),
        alone=False,
    )


def replace_held_out(stage, rmse):
    return Of(**{**vars(stage), "held_out": Of(rmse=rmse)})


def test_what_repeats_itself_is_told_last():
    sentence = "The residual repeats itself 12 times over the range of the input (84% of its variance)."
    assert headline(outcome_of((), {}, rmse=0.5, shape=sentence)).endswith(f"explains. {sentence}")


def test_stand_ins_are_told_together_where_the_reason_is_one():
    needs = {"dahl": ("input-lag", "bias"), "lugre": ()}
    said = headline(outcome_of(("bias", "saturation", "input-lag"), needs))
    shape = "bias and saturation (without dynamics, any law may have the like in its shape)"
    assert f"{shape}, and input-lag (lugre does without) may stand in for the law." in said
    assert said.count("dynamics") == 1


def test_a_stand_in_alone_is_told_with_its_reason():
    said = headline(outcome_of(("input-lag",), {"dahl": ("input-lag",), "lugre": ()}))
    assert said.endswith("input-lag (lugre does without) may stand in for the law.")


def test_free_forms_far_from_the_noise_stand_in_for_the_law_and_what_is_beside_them_is_doubted():
    beside, alone = (
        replace(outcome_of(adopted, {}, rmse=0.17), doubt=Doubt(free=("lags-before",)))
        for adopted in (("creep", "lags-before"), ("lags-before",))
    )
    assert beside.named == ("creep",)
    assert headline(beside).startswith("The model may lack creep: ")
    assert headline(beside).endswith("lags-before may stand in for the law.")
    assert "What is named may stand in for that." in " ".join(warnings(beside))
    assert headline(alone).startswith("No effect is named, as what helps may be the law's own: ")


def test_a_law_that_comes_down_to_the_noise_is_not_said_to_fail():
    needs = {"dahl": ("input-lag",), "lugre": ()}
    whatever = Doubt(agreement=Agreement(needs, {}, {"input-lag": ()}))
    named = headline(replace(outcome_of(("input-lag",), needs, 0.1), doubt=whatever))
    assert "dahl alone does not follow the data; with these effects it does." in named
    far, near = (headline(outcome_of(("input-lag",), needs, rmse)) for rmse in (0.3, 0.1))
    assert "The law itself does not follow the data, and no other one here does clearly better." in far
    assert "dahl alone does not follow the data; with what helps it does." in near
    assert "itself" not in near
    far, near = (" ".join(warnings(outcome_of(("input-lag",), needs, rmse=rmse))) for rmse in (0.3, 0.1))
    assert "The final system still leaves 3 times the noise" in far
    assert "still leaves" not in near


def test_what_no_black_box_finds_either_is_not_blamed_on_the_law_alone():
    """As where a zero walks at random, or the input is measured with noise."""
    needs = {"dahl": ("input-lag",), "lugre": ()}
    silent = outcome_of(("input-lag",), needs, finds_nothing=True)
    causes = "slow noise, noise of the input, a cause that was not measured, or the law's own fault"
    assert f"no black box does clearly better: what is left may be {causes}." in headline(silent)
    assert f"a black box finds nothing in the input's past: {causes}." in " ".join(warnings(silent))
    assert "`--set parts=8` may follow more closely what is left." in " ".join(warnings(silent))
    assert "does not follow" not in headline(silent) + " ".join(warnings(silent))


def test_errors_on_records_left_out_are_told_as_such_with_their_unit():
    cause = Cause("lugre", ("creep",), 0.05, 0.2)
    outcome = replace(outcome_of(("creep",), {}), doubt=Doubt(cause=cause))
    said = headline(outcome)
    left_out = "on fitted records left out in turn lugre with creep leaves 0.05 um, dahl with all that helps it leaves"
    assert f"What is left is the law's: {left_out} 0.2 um." in said
    assert "on parts of what was fitted, left out in turn, lugre with creep" in headline(replace(outcome, alone=True))


def test_what_does_not_predict_the_held_out_records_is_not_said_to_explain_the_data():
    sound = outcome_of(("creep",), {}, rmse=0.1, held_out=0.12)
    assert not sound.unexplained
    assert not sound.doubtful
    missed = outcome_of(("creep",), {}, rmse=0.1, held_out=2.1)
    assert missed.unexplained
    assert missed.doubtful
    assert "may lack creep" in headline(missed)
    assert headline(missed).endswith("What was held out is missed by 21 times the noise: something is lacking.")
    by_a_little = outcome_of(("creep",), {}, rmse=0.1, held_out=0.15)
    assert by_a_little.unexplained
    assert "may lack creep" in headline(by_a_little)
    assert headline(by_a_little).endswith("What was held out is missed by 1.5 times the noise: something is lacking.")
    noisy = outcome_of(("creep",), {}, rmse=0.3, held_out=0.35, slow=True)
    assert "What is left is 3 times the noise from sample to sample: slow noise, or a cause" in headline(noisy)
    assert not noisy.unexplained, "slow noise is in both alike"
    assert not noisy.doubtful
    assert outcome_of(("creep",), {}, rmse=0.3, held_out=2.1, slow=True).unexplained


def test_what_was_held_out_and_is_missed_by_a_little_is_told():
    told = (
        "What was held out is missed by 1.8 times the noise, what was fitted by 1: what was fitted does not tell all."
    )
    assert told in " ".join(warnings(outcome_of(("creep",), {}, rmse=0.1, held_out=0.18)))
    assert "missed by" not in " ".join(warnings(outcome_of(("creep",), {}, rmse=0.1, held_out=0.11)))
    assert "missed by" not in " ".join(warnings(outcome_of(("creep",), {}, rmse=0.3, held_out=0.35, slow=True)))


def test_held_out_records_of_too_few_samples_are_told_in_place_of_what_is_missed():
    few, enough = (
        " ".join(warnings(outcome_of(("creep",), {}, rmse=0.1, held_out=0.18, between=between)))
        for between in (0.04, 0.02)
    )
    assert "The samples of what was held out are few for this law: finer steps" in few
    assert "0.04 (RMS), 0.4 times the noise. Its error says little." in few
    assert "does not tell all" not in few
    assert "does not tell all" in enough


def test_agreement_on_what_was_fitted_does_not_vouch_for_names_that_fail_on_what_was_held_out():
    needs = {"dahl": ("input-lag",), "bouc-wen": ("input-lag",), "lugre": ("input-lag",)}
    assert not outcome_of(("input-lag",), needs, rmse=0.3, held_out=0.35).doubtful
    assert outcome_of(("input-lag",), needs, rmse=0.12, held_out=1.6).doubtful


def test_a_name_that_held_out_records_contradict_is_not_claimed():
    worse = outcome_of(("creep", "saturation"), {}, rmse=0.1, held_out=0.25, held_out_before=0.2)
    assert worse.refuted
    assert worse.named == ()
    assert worse.stand_ins == ("creep", "saturation")
    assert worse.unexplained
    carried = "No effect is named, as what helps on what was fitted does not carry over: with it, on what was held out"
    assert headline(worse).startswith(f"{carried} the RMSE does NOT fall, it goes from 0.2 to 0.25")
    (first, *_) = warnings(worse)
    assert first.startswith("creep and saturation were selected on what was fitted, and were not named")


def test_what_the_noise_may_have_done_to_a_held_out_record_contradicts_no_name():
    near = outcome_of(("creep",), {}, rmse=0.1, held_out=0.104, held_out_before=0.1)
    assert not near.refuted
    assert near.named == ("creep",)
    below = outcome_of(("creep",), {}, rmse=0.1, held_out=0.1, held_out_before=0.05)
    assert not below.refuted, "both are within the noise"


def test_what_nothing_could_test_is_given_up_aloud():
    untested = Fallback(("creep", "saturation"), 0.4, 1.1, 1.1, tested=False)
    (said, *_) = warnings(outcome_of((), {}, given_up=untested))
    assert "creep and saturation had been selected and were given up" in said
    assert "which leaves 4 times the noise with them and 11 times the noise without" in said
    worse = Fallback(("creep",), 0.2, 0.21, 0.3, worse_on=("slow",))
    (said, *_) = warnings(outcome_of((), {}, given_up=worse))
    assert "was 0.2 with it and 0.21 without (bare: 0.3). slow was predicted clearly worse with than without." in said


def test_what_one_excitation_shows_far_from_the_noise_is_no_name():
    alone = replace(outcome_of(("creep",), {}, rmse=0.3), doubt=Doubt(untested=True))
    assert alone.named == ()
    assert alone.stand_ins == ("creep",)
    assert headline(alone).startswith("No effect is named, as what helps may be the law's own")


def test_a_zero_that_lies_elsewhere_is_not_blamed_on_the_law():
    missed = outcome_of(("creep",), {}, rmse=0.11, held_out=0.4)
    said = " ".join(warnings(missed))
    assert "the model's own law does not follow these data" in said
    elsewhere = replace(missed, after=Of(**{**vars(missed.after), "constant": 0.38}))
    assert "own law does not follow" not in " ".join(warnings(elsewhere))
    assert "Of that 0.38 um is a constant" in headline(elsewhere)


def test_a_shape_of_the_law_s_own_is_told_with_why_and_no_effect_is_named():
    own = Doubt(own={"creep": "with another curve this law does the same"})
    outcome = replace(outcome_of(("creep",), {}, rmse=0.1), doubt=own)
    assert outcome.unexplained
    said = headline(outcome)
    assert said.startswith("No effect is named, as what helps may be the law's own: with it, ")
    assert said.endswith("creep (with another curve this law does the same) may stand in for the law.")
