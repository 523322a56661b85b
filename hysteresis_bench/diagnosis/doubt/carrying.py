"""Does an effect carry the loop alone? Then it is the law, and the one that was asked about has no part in it.

Rayleigh's law beside a law, and a bank of plays before it, are laws of hysteresis by themselves. Where they are
effects, the law keeps a loop of its own without them: a fifth of the whole or more in seven made cases, of three laws
and two effects. Where the records were another law's, in four cases of Preisach's, it kept 6 % at most.
"""

from __future__ import annotations

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.fit.least_squares import split
from hysteresis_bench.free_forms import FreeForm
from hysteresis_bench.signals import Record

KEPT = 0.1
"""Share of the loop that a law keeps without the effect. With half of it one of these four cases passes for an effect;
with twice it none of the seven effects is refused."""

ORDER = 7
"""Of the curve of the input that is no loop."""


def carrying(found: Found) -> tuple[str, ...]:
    """Adopted effects that are laws by themselves, without which the law has next to no loop."""
    fitter, final = found.thin, found.final
    names = [name for name in found.selection.adopted(final) if _is_law(name)]
    if not names:
        return ()
    records, (_, values) = fitter.stack.records, fitter.fitted(final)
    space = fitter.stack.problem(final.names).space
    off = [
        p.null if p.null is not None and p.name.split(".")[0] in names else value
        for p, value in zip(space.parameters, values, strict=True)
    ]
    whole, alone = (
        [_loop(record, errors) for record, errors in zip(records, split(left, records), strict=True)]
        for left in (fitter.errors(final.names, values), fitter.errors(final.names, np.array(off)))
    )
    return tuple(names) if sum(alone) < KEPT * sum(whole) else ()


def _is_law(name: str) -> bool:
    effect = registry.effect(name)
    by_itself = effect.acts == "law" or issubclass(effect, FreeForm)
    return effect.family == "law" and by_itself and name not in registry.offered()


def _loop(record: Record, errors: Array) -> float:
    """RMS of what a response is off a curve of the input."""
    u, y = record.input[record.scored], record.measured - errors
    basis = np.polynomial.chebyshev.chebvander((u - np.mean(u)) / (np.ptp(u) or 1.0), ORDER)
    loop = y - basis @ np.linalg.lstsq(basis, y, rcond=None)[0]
    return float(np.sqrt(np.mean(loop**2)))
