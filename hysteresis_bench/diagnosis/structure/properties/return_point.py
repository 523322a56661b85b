"""Return-point memory: after an inner loop the output is what it was before.

[1] J. P. Sethna et al., Phys. Rev. Lett. 70 (1993) 3347;  wiping out: I. D. Mayergoyz, Phys. Rev. Lett. 56 (1986) 1518.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.structure.cells import MOST, judged
from hysteresis_bench.diagnosis.structure.course import Branch, Course
from hysteresis_bench.diagnosis.structure.curves import Curve, measured
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Finding

DEEP = 0.05
"""Share of the input's range that an inner loop must span."""
WITHOUT = (
    "No inner loop closes: the input never comes back to a reversal without passing the one before. "
    "Return-point memory cannot be tested."
)


def return_point(course: Course) -> Finding:
    """The output where the input comes back to its last reversal but one, against what it was there."""
    found, curves = [], []
    pairs = list(zip(course.branches[:-2], course.branches[1:-1], course.branches[2:], strict=True))
    for outer, away, back in pairs[:: max(1, -(-len(pairs) // MOST))]:
        if not _inner(course, outer, away, back):
            continue
        before = _at_end(outer, away.start, course)
        after = _on_the_way(back, away.start, course)
        if before is not None and after is not None:
            row = np.zeros(course.y.size)
            row[back.samples] += after
            row[outer.samples] -= before
            found.append(row)
            curves.append(_loop(away, back, away.start))
    if not found:
        return Finding("return-point memory", WITHOUT)
    rows = np.array(found)
    left = rows @ course.y
    p, _ = judged(course, rows, left, 2.0 * (course.tolerance**2 + course.repeats**2) * left.size)
    share, noise = course.share(float(np.sqrt(np.mean(left**2)))), course.share(course.noise.rms)
    where = "an inner loop should close" if left.size == 1 else f"{left.size} inner loops should close"
    why = "no law with return-point memory closes so badly" if p < LEVEL else f"they close (p = {p:.2g})"
    words = f"where {where} the output differs by {share:.2g} % of the range (RMS), the noise is {noise:.2g} %: {why}."
    return Finding("return-point memory", words, share, p, noise=noise, curves=tuple(curves[:6]), along="input")


def _inner(course: Course, outer: Branch, away: Branch, back: Branch) -> bool:
    """An excursion from the end of `outer` that turns before the reversal before, and comes back."""
    same = outer.record == away.record == back.record and away.order == outer.order + 1 and back.order == away.order + 1
    if not same:
        return False
    size = abs(back.start - away.start)
    returns = outer.way * (back.u[-1] - away.start) >= 0.0
    return bool(returns and size > DEEP * course.span_u and size < away.depth - 0.002 * course.span_u)


def _at_end(branch: Branch, value: float, course: Course) -> Array | None:
    """Weights of the samples of its last part that give the output at the reversal, (samples,)."""
    return _one_sided(branch.way * (value - branch.u), course)


def _on_the_way(branch: Branch, value: float, course: Course) -> Array | None:
    """Weights of the samples before the value that give the output there."""
    to_go = branch.way * (value - branch.u)
    passed = np.flatnonzero(to_go < 0.0)
    if passed.size:  # the curve may bend there: only what lies before it counts
        to_go = np.where(np.arange(to_go.size) < passed[0], to_go, np.inf)
    return _one_sided(to_go, course)


def _one_sided(to_go: Array, course: Course) -> Array | None:
    inside = (to_go <= course.field) & (to_go >= -1e-9 * course.span_u)
    x = to_go[inside] / course.field
    if x.size < 5 or x.max() < 0.5 or x.min() > 0.3:
        return None
    weights = np.zeros(to_go.size)
    weights[inside] = np.linalg.pinv(np.column_stack([np.ones_like(x), x, x**2]))[0]
    return weights


def _loop(away: Branch, back: Branch, value: float) -> Curve:
    """The inner loop, for a picture."""
    inside = away.way * (value - back.u) <= 0.0
    return measured(np.concatenate([away.u, back.u[inside]]), np.concatenate([away.y, back.y[inside]]))
