"""Of all sets of effects that were fitted on the way, one that does clearly better than what the search ended with.

The search goes from set to set, one effect at a time, and a set that it passed by may have been fitted beside a worse
one, or before a free form stood in a name's place. What was fitted is known: the end does not depend on the way.
"""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.selection import MISFIT, MOST, NAMED, REACHED, Selection
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage


def best_of_all(selection: Selection, current: Hypothesis) -> Hypothesis:
    """Of all that were fitted, what should stand in the place of the current set, the simplest where there are
    several."""
    for _ in range(MOST):
        better = [one for one in selection.known.values() if takes_the_place(selection, one, current)]
        if not better:
            break
        current = selection.refitted(selection.simplest(better))
    return current


def takes_the_place(selection: Selection, one: Hypothesis, current: Hypothesis) -> bool:
    """Does a set that claims no more predict samples left out clearly better than the current one? With more parameters
    it must explain more than what then remains over the noise. Near the noise no names are given up for a curve; far
    from it a free form that joins may be following the law's own fault."""
    if current.rmse <= REACHED * selection.floor:
        return False
    if not fits(selection, one) and (one.names - current.names) & {*selection.forms}:
        return False
    if claims(one) > claims(current) or one.cv_rmse >= current.cv_rmse:
        return False
    if any(selection.fitter.drowned(one, name) for name in selection.adopted(one)):
        return False
    clear = advantage(one.left_out, current.left_out, selection.fitter.blocks) > CLEAR
    return clear and selection.share(current, one) > (NAMED if len(one.values) > len(current.values) else 0.0)


def fits(selection: Selection, one: Hypothesis) -> bool:
    """Does it come near the noise? What even curves do not explain is the law's, and they its stand-ins."""
    return one.rmse <= MISFIT * selection.floor


def claims(hypothesis: Hypothesis) -> int:
    """How many effects a set has beside the records' offsets."""
    return len(hypothesis.names - {*registry.OFFSETS})
