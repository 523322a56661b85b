"""Does a law of fewer parameters follow the records as well, with the same effects?

Laws are ranked before their effects are known. One that contains the right one, as a generalized law contains the one
that it generalizes, may take up a part of an effect, come before it, and follow no better once the effect is known.
"""

from __future__ import annotations

from collections.abc import Sequence

from hysteresis_bench.diagnosis.doubt.doubt import SCREENED
from hysteresis_bench.diagnosis.doubt.other_laws import OtherLaws
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.laws.choice import TIED
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.search.search import Found


def simpler_law(asked: str, found: Found, laws: Sequence[str], seed: int) -> str:
    """The first that leaves as little (`TIED`) of `SCREENED` samples as `asked`, with all that was found; "" if none.

    found : around the law `asked`;  laws : others, that of fewest parameters first
    """
    stack = found.thin.stack
    few, effects = thinned(views_of(stack.records), SCREENED), found.selection.adopted(found.best)
    around = OtherLaws(asked, stack, few, effects, found.selection.floor, seed)
    least = TIED * around.screened(asked).rmse if laws else 0.0
    return next((law for law in laws if around.screened(law).rmse <= least), "")
