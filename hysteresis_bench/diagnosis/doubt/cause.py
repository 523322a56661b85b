"""Is the law itself the cause of what is left? Then effects that were adopted may only stand in for it.

Where the final system predicts excitations left out worse than the noise allows, or needs a curve without a formula, or
two formulas without dynamics, every other law is fitted to a part of the samples, with the effects in question. Those
that do best there are fitted to all, and effects that they do not need are taken off again. A law that predicts clearly
better, and leaves less than half of the excess over the noise, is told as the cause; so is one that needs no curve and
predicts as well as a system with one, unless it has more parameters, and the curve is all of the shape that was
adopted, if it is any: a richer law follows one curve as well, and shows nothing. Nor does one where the law that was
asked about needs no curve either to predict as well. At the noise no law predicts clearly better, so that those of more
parameters are not asked there. Two formulas without dynamics may make another law of the asked one: a law that predicts
as well without any, with no more parameters, is told as the cause. What was adopted and is not needed around that law
is a stand-in: it stays in the model, where it helps to predict, and is not named.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.diagnosis.doubt.agreement import is_shape
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.search.fallback import unseen_rmse
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import NAMED, REACHED
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage
from hysteresis_bench.fit.unseen.blocks import Blocks
from hysteresis_bench.signals import Record

PURSUED = 3
"""Laws that are fitted to all samples: those that leave least of the few."""

SHAPES = 2
"""Formulas without dynamics that are needed to reach the noise, from which they may make another law of the asked one.
With 1, a saturation behind Bouc-Wen was no longer named, whose loops another law follows as well (1 of 6 made cases
with one such effect; with 2, none of 9 with two); with 4, hardly any is asked."""

AT_NULL = 1e-3
"""Of its box, within which a weight of a curve counts as none."""

NOBODY = Contender("", (), np.empty(0))


@dataclass(frozen=True)
class Cause:
    """A law that predicts clearly better, or as well with less around it.

    effects : of those in question, what this law needs
    unseen, own : RMSE on excitations left out of the fit (of a lone record, on its blocks), of this law with
    `effects`, and of the law that was asked about with all that was adopted
    """

    model: str
    effects: tuple[str, ...]
    unseen: float
    own: float

    @property
    def as_well(self) -> bool:
        """Does it predict as well, and no better?"""
        return self.own <= REACHED * self.unseen


def law_as_cause(
    found: Found,
    own: Contender,
    screened: Sequence[Contender],
    most: float,
    few: tuple[Record, ...],
    workers: Workers[Contender],
) -> Cause | None:
    """None where no other law does clearly better.

    own : the law that was asked about with all that was adopted, and its errors on records left out of the fit
    screened : the laws that may stand in its place, fitted to the `few` samples
    most : as of `most_parameters`
    """
    fitter, floor = found.thin, found.selection.floor
    imitated = made_of_shapes(own, floor)
    own_few = replace(fitter, stack=replace(fitter.stack, records=few))
    left = own_few.errors(found.final.names, fitter.fitted(found.final)[1])
    reach = float(np.sqrt(np.mean(left**2))) * (REACHED if forms_of(own.effects) or imitated else 1.0)
    promising = [one.model for one in sorted(screened, key=lambda one: one.rmse)[:PURSUED] if one.rmse < reach]
    predicting = workers.map([("predicting", name) for name in promising])
    best = min(predicting, key=lambda one: one.rmse, default=NOBODY)
    if not clearly_better(best, own, floor, fitter.blocks):
        reached = REACHED * max(own.rmse, floor)
        as_well = [one for one in predicting if one.parameters <= most and one.rmse <= reached]
        as_well = [one for one in as_well if not (imitated and any(map(is_shape, one.effects)))]
        best = min(as_well, key=lambda one: one.rmse, default=NOBODY)
    return None if best is NOBODY else Cause(best.model, best.effects, best.rmse, own.rmse)


def most_parameters(found: Found, own: Contender) -> float:
    """So many has a law that is told as the cause as it predicts as well, at most; with 0 none is."""
    curves, imitated = forms_of(own.effects), made_of_shapes(own, found.selection.floor)
    reached = REACHED * max(own.rmse, found.selection.floor)
    if not (imitated or (curves and not _without_curves(found, reached))):
        return 0
    return _in_use(found.thin, found.final) if imitated or sum(map(is_shape, own.effects)) < SHAPES else np.inf


def made_of_shapes(one: Contender, floor: float) -> bool:
    """Do formulas reach the noise, `SHAPES` of them without dynamics? With the law they may make another one."""
    shapes = sum(map(is_shape, one.effects))
    return one.rmse <= REACHED * floor and shapes >= SHAPES and not forms_of(one.effects)


def clearly_better(one: Contender, other: Contender, floor: float, blocks: Blocks) -> bool:
    """Does it do clearly better on records left out, and explain more than then remains of the excess over the noise?

    floor : RMS of the noise;  blocks : of the samples"""
    explained, excess = other.rmse**2 - one.rmse**2, other.rmse**2 - floor**2
    explains = other.rmse > REACHED * one.rmse and explained > NAMED * excess
    return bool(explains and advantage(one.errors, other.errors, blocks) > CLEAR)


def _without_curves(found: Found, reached: float) -> bool:
    """Does the law that was asked about with formulas alone, of those that were tried, predict as well?"""
    known = found.selection.known.values()
    plain = [one for one in known if one.rmse <= reached and not forms_of(tuple(one.names))]
    return bool(plain) and unseen_rmse(found.thin, min(plain, key=lambda one: one.cv_rmse)) <= reached


def _in_use(fitter: Fitter, final: Hypothesis) -> int:
    """Parameters of a system that are not at their nulls: a curve uses as many of its own as it needs."""
    space = fitter.stack.problem(final.names).space
    nulls = ((p, p.null, final.values[p.name]) for p in space.parameters)
    return sum(null is None or abs(value - null) > AT_NULL * (p.upper - p.lower) for p, null, value in nulls)
