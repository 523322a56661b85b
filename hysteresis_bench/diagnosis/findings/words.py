"""A diagnosis in sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hysteresis_bench.contracts import Model
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.findings.result import Stage, Verdict
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis.search.hypotheses import Trial
from hysteresis_bench.fit.combinations import listed
from hysteresis_bench.registry import DESCRIPTION, OFFSETS
from hysteresis_bench.signals import Record

WRONG = 2.0
"""Times the noise that the final system may leave before its names are doubted."""


def headline(
    verdict: Verdict,
    adopted: Sequence[str],
    alone: bool,
    before: Stage,
    after: Stage,
    noise: Noise,
    floor: float,
    ties: Sequence[Tie],
    units: Mapping[str, str],
) -> str:
    """The verdict, with the error before and after; an effect that is tied is never named alone, and one beside
    which much more than the noise is left is named with a doubt."""
    unit = "" if units.get("output", "1") == "1" else f" {units['output']}"
    first, last = (stage.held_out or stage.fitted for stage in (before, after))
    where = "on what was held out" if after.held_out else "on what was fitted"
    if alone:
        return "The output does not follow the input: the model explains less than half of it, and no effect is named."
    effects = [name for name in adopted if name != DESCRIPTION]
    if effects:
        named = listed([_or_its_rivals(name, ties) for name in effects])
        moves = "falls" if last.rmse < first.rmse else "does NOT fall, it goes"
        lacks = "may lack" if after.fitted.rmse > WRONG * floor else "lacks"
        found = f"The model {lacks} {named}: {where} the RMSE {moves} from {first.rmse:.3g} to {last.rmse:.3g}{unit}"
    else:
        found = f"No effect that is known here is missing: {where} the RMSE is {last.rmse:.3g}{unit}"
    told = f"{found}; the noise is {noise.floor:.3g}."
    if DESCRIPTION in adopted:
        told += " Terms that describe what was left, without explaining it, have been added."
    if verdict == "unexplained-residual":
        told += " Something is left that no effect explains."
    return told


def _or_its_rivals(name: str, ties: Sequence[Tie]) -> str:
    rivals = [tie.rival for tie in ties if tie.effect == name]
    return f"{name} (or {', '.join(rivals)}: these records cannot tell)" if rivals else name


def carries_over(before: Stage, after: Stage) -> bool:
    """Does what was adopted also help where it was not fitted? True where nothing was held out."""
    return before.held_out is None or after.held_out is None or after.held_out.rmse <= before.held_out.rmse


def warnings(
    model: Model,
    records: Sequence[Record],
    final: Trial,
    after: Stage,
    alone: bool,
    floor: float,
    noise: float,
    ties: Sequence[Tie],
) -> tuple[str, ...]:
    """What a user must know before believing the names. floor : RMS from which anything is judged"""
    told = list(model.advice(records)) if not final.names & {*OFFSETS} else []
    if after.fitted.rmse > WRONG * floor and not alone:
        told.append(
            f"The final system still leaves {after.fitted.rmse / floor:.2g} times the noise: the model's own law does "
            "not follow these data, and what is named may stand in for that."
        )
    if alone:
        told.append("The output does not follow the input; whatever would fit it is no diagnosis.")
    for name in final.at_bound:
        effect = name.rpartition(".")[0]
        said = f"{name} lies at the edge of its box ({final.values[name]:.4g})"
        told.append(f"{said}: {effect} may stand in for something else." if effect else f"{said}.")
    if len(records) == 1:
        told.append(
            "One record only: what is held out comes from the same experiment, at the same speed and amplitude."
        )
    if noise < 0.5 * floor:  # what lies between the samples puts every floor a little above the noise
        told.append("The data have next to no noise; below a few parts in ten thousand of the range nothing is judged.")
    for one in ties:
        told.append(f"{one.effect} and {one.rival} cannot be told apart on these records: {one.reason}.")
    return tuple(told)
