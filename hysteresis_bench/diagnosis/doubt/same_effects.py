"""Other laws with the effects that were found around one: does one of fewer parameters, or any, follow as well?

Laws are ranked before their effects are known. One that contains the right one, as a generalized law contains the one
that it generalizes, may take up a part of an effect, come before it, and follow no better once the effect is known.
Where two effects act, a wrong law may come before the right one, which lacks both; one of them may be found around it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hysteresis_bench.diagnosis.doubt.doubt import SCREENED
from hysteresis_bench.diagnosis.doubt.other_laws import Contender, OtherLaws
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.hypotheses.expected_error import TIED, weighed
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.diagnosis.search.search import Found


def simpler_law(asked: str, found: Found, laws: Sequence[str], seed: int) -> str:
    """The first that leaves as little (`TIED`) of `SCREENED` samples as `asked`, with all that was found; "" if none.

    found : around the law `asked`;  laws : others, that of fewest parameters first
    """
    around = _around(asked, found, seed)
    least = TIED * around.screened(asked).rmse if laws else 0.0
    return next((law for law in laws if around.screened(law).rmse <= least), "")


def better_law(asked: str, found: Found, parameters: Mapping[str, int], options: DiagnosisOptions) -> str:
    """Of the laws that leave less of `SCREENED` samples than `asked` with all that was found, the one of which least is
    expected (times 1 + parameters / blocks, as of `expected_error`); "" where none does, or nothing was found.

    found : around the law `asked`;  parameters : how many the others have
    """
    around, blocks = _around(asked, found, options.seed), int(found.thin.blocks.block.max()) + 1
    if not (around.effects and parameters):
        return ""
    with Workers[Contender](around, options.processes, options.on_step, options.kept) as workers:
        own, *others = workers.map([("screened", law) for law in (asked, *parameters)])
    better = [one for one in others if one.rmse < own.rmse]
    expected = {one.model: weighed(one.rmse, parameters[one.model], blocks) for one in better}
    return min(expected, key=lambda law: expected[law], default="")


def _around(asked: str, found: Found, seed: int) -> OtherLaws:
    stack, selection = found.thin.stack, found.selection
    few = thinned(views_of(stack.records), SCREENED)
    return OtherLaws(asked, stack, few, selection.adopted(found.best), selection.floor, seed, found.final.values)
