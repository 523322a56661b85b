"""What the final system leaves: does it matter, and which terms describe it?"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.evidence.autocorrelated import effective_samples, equally_loud, f_tail, overlooked
from hysteresis_bench.diagnosis.evidence.evidence import Evidence
from hysteresis_bench.diagnosis.evidence.noise import clipped_rms
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG, floor_of
from hysteresis_bench.diagnosis.evidence.residual_tests import OVERALL, ResidualTest
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.diagnosis.findings.stages import Stage, left_by
from hysteresis_bench.diagnosis.findings.terms import Equation, find_terms
from hysteresis_bench.diagnosis.reading.measured_apart import measured_apart
from hysteresis_bench.diagnosis.search.selection import MISFIT
from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.statistics import LEVEL as OF_A_TEST

REMAINS = 1.1
"""RMSE over noise from which what is left matters."""

TELLING = 0.03
"""Share of the residual's variance from which a dependence matters."""

DEPENDENCE = 4
"""Columns of a dependence, as on the input."""

MOSTLY = 0.5
"""Share of the mean square that a constant must be to be told: more than all else. With half of it a model is told so
that misses the shape as well, with twice of it none."""

WHITE, LONGEST = 0.1, 20
"""Of what is left, the share that the noise from sample to sample may have in whether it is as loud throughout: so many
samples are averaged, at most. Such noise may be louder at some times than at others."""

UNLIKELY = 0.01
"""p-value below which noise of one loudness does not come in such bursts, and below which what was held out is missed
by more than what was fitted."""

BURSTS = "What is left is loud at some times and quiet at others, as noise seldom is."

OF_THE_NOISE = ("noise-floor", "whiteness", "offset")
"""Tests that slow noise fails, beside those of the scatter; it passes all that ask for a cause."""


@dataclass(frozen=True)
class Remainder:
    """equation : what describes the residual, None where it does not matter
    matters : something with a cause is left, or a residual that is too small a sample to tell
    slow : nothing is left but noise that changes slowly: correlated from sample to sample, without any cause that was
        measured, described by no term, as loud at one time as at another, and no louder where nothing was fitted; and
        of so many independent samples that a cause of `WRONG` times the noise would have been seen in it
    heavy : nothing is left but noise of heavy tails: not correlated, without a cause or a term either, and most samples
        are no louder than the noise
    louder : where nothing was fitted, clearly more is left than where it was
    shape : a sentence, where it repeats itself along the input or the output, comes in bursts, is far above the noise
        of the record that it is left of, or is that of records, or halves of them, at other scales or times
    alone : records in which it depends on something by itself, though not in all together. In made noise that is white
        or falls off within some samples one does in 1 of 160 cases, in 1/f noise in 25 of 30
    """

    equation: Equation | None
    matters: bool
    slow: bool
    heavy: bool
    louder: bool
    shape: str = ""
    alone: tuple[str, ...] = ()

    @property
    def noise(self) -> bool:
        """Is nothing left but noise, though louder than most samples are from one to the next?"""
        return self.slow or self.heavy

    def told_as_noise(self, times: float) -> str:
        """A sentence;  times : what is left over the noise from sample to sample"""
        correlated, kind = (
            ("is correlated, but", "slow noise, or a cause beside the input that these data do not show")
            if self.slow
            else ("is not correlated,", "noise of heavy tails, where few samples are far off")
        )
        here = f"here in all records together, though in {listed(self.alone)} it seems to" if self.alone else "here"
        return (
            f"What is left is {rounded(times)} times the noise from sample to sample and {correlated} depends on "
            f"nothing that was measured {here}, and no term describes it: {kind}."
        )

    def of_a_cause(self) -> Remainder:
        """After something predicted it where it was not fitted, which nothing can of noise."""
        return replace(self, matters=self.matters or self.noise, slow=False, heavy=False)


def remainder(stage: Stage, evidence: Evidence, parameters: int) -> Remainder:
    """What is left at the end of a diagnosis, over all fitted records.

    parameters : how many the stage's fit uses up, of a density the effective number"""
    views, floor = evidence.views, evidence.floor
    scope = OVERALL if len(views) > 1 else views[0].record.name
    tests = [test for test in stage.tests if test.record == scope and test.significant]
    loud = stage.fitted.rmse > REMAINS * floor and any(test.name == "noise-floor" for test in tests)
    telling = _telling(tests)
    residuals, simulated = left_by(stage, views)
    louder = _louder(stage, residuals, floor, parameters)
    apart = measured_apart([view.record for view in views], simulated, residuals, floor)
    missed = _missed_by_its_own_noise(stage, views, residuals, floor) or apart
    if stage.fitted.rmse <= floor or not (loud or telling):
        return Remainder(None, bool(missed), False, False, louder, missed)
    equation = find_terms([view.record for view in views], residuals, simulated)
    caused = [test for test in telling if test.name not in OF_THE_NOISE]
    white = not any(test.name == "whiteness" for test in tests)
    noise = not (caused or equation.terms or louder or missed)
    # what is not known of a smoothed input is loud where the output goes steeply
    smoothed = any(view.record.input_error > 0.0 for view in views)
    bursts = noise and not (white or smoothed) and equally_loud(_averaged(residuals, floor)) < UNLIKELY
    slow = noise and not white and not bursts and _hidden(residuals, len(tests)) <= WRONG * floor
    heavy = noise and white and clipped_rms(np.concatenate(residuals))[0] <= REMAINS * floor
    ripple = max((t for t in telling if t.name.startswith("ripple")), key=lambda t: t.share, default=None)
    shape = f"{ripple.words.capitalize().partition(', p =')[0]}." if ripple else BURSTS if bursts else missed
    seems = [t for t in _telling(stage.tests) if t.significant and t.record != scope and t.name not in OF_THE_NOISE]
    alone = tuple(dict.fromkeys(test.record for test in seems))
    return Remainder(equation, not (slow or heavy), slow, heavy, louder, shape, alone)


def _telling(tests: Sequence[ResidualTest]) -> list[ResidualTest]:
    """Those of a dependence that is a good part of what is left."""
    return [
        t for t in tests if t.share > TELLING and t.name not in ("noise-floor", "offset") and "scatter" not in t.name
    ]


def _missed_by_its_own_noise(stage: Stage, views: Sequence[View], residuals: Sequence[Array], floor: float) -> str:
    """A sentence of the record that is missed by most of its own noise, where that is more than `WRONG` times it, and
    than all records are by theirs; else "". A few samples that are far off do not count.

    What changes faster than the samples of one record follow passes for noise there, and hides in that of all records
    what is left of a record whose samples do follow."""
    loud = {test.record for test in stage.tests if test.name == "noise-floor" and test.significant}
    beyond = [
        (clipped_rms(part)[0] / floor_of([view], view.noise), view)
        for view, part in zip(views, residuals, strict=True)
        if view.record.name in loud
    ]
    most, view = max(beyond, key=lambda one: one[0], default=(0.0, views[0]))
    if most <= WRONG * max(1.0, stage.fitted.rmse / floor):
        return ""
    own = floor_of([view], view.noise)
    return (
        f"{view.record.name} is missed by {rounded(most)} times its own noise, {own:.3g} where that of all records is "
        f"{floor:.3g}: what changes faster than the samples of another record follow may pass for noise there."
    )


def _averaged(residuals: Sequence[Array], floor: float) -> list[Array]:
    """Means of so many samples that the noise from one to the next counts for little."""
    left = float(np.mean(np.concatenate(residuals) ** 2)) - floor**2
    samples = int(np.clip(math.ceil(floor**2 / (WHITE * left)) if left > 0.0 else LONGEST, 1, LONGEST))
    return [part[: part.size // samples * samples].reshape(-1, samples).mean(axis=1) for part in residuals]


def _hidden(residuals: Sequence[Array], tests: int) -> float:
    """RMS of the largest cause that one of so many tests may have overlooked in the residual.

    One loop is a handful of independent samples, whatever their number: whether what is left of it is noise or the
    law's fault, nobody can tell. Twice the noise is too much: of six made cases with slow noise (4 times that from
    sample to sample) it is 1 to 1.4 times, of a measured ferrite's loops 7.5 times. With half the limit five of the six
    are told as unexplained; with twice of it nothing changes."""
    rms = float(np.sqrt(np.mean(np.concatenate(residuals) ** 2)))
    return rms * math.sqrt(overlooked(effective_samples(residuals), DEPENDENCE, OF_A_TEST / max(tests, 1)))


def _louder(stage: Stage, residuals: Sequence[Array], floor: float, parameters: int) -> bool:
    """Is what was held out missed by more than what was fitted, and than the noise? Both are as loud in every record.

    An F test of the mean squares, with as many effective samples as one of the fitted records has; twice as much is too
    much by any test."""
    if stage.held_out is None:
        return False
    squares = [part**2 for part in residuals]
    level = float(np.mean(np.concatenate(squares)))
    ratio = stage.missed**2 / max(level, floor**2)
    effective = effective_samples([part - level for part in squares])
    corrected = ratio * effective / (effective + 2.0 * parameters)
    p = f_tail(corrected, effective / len(residuals), effective - parameters)
    return ratio > WRONG**2 or (ratio > MISFIT**2 and p < UNLIKELY)


def other_zero(stage: Stage, floor: float, unit: str) -> str:
    """Is what was held out missed by little more than a constant? Then its zero lies elsewhere, and the shape is right.

    A sentence, or "" where the error is near the noise, or another one;  unit : of the output, as it is told
    """
    held_out = stage.held_out
    if held_out is None or held_out.rmse <= WRONG * floor or stage.constant**2 < MOSTLY * held_out.rmse**2:
        return ""
    rest = max(held_out.rmse**2 - stage.constant**2, 0.0) ** 0.5
    return (
        f" Of that {stage.constant:.3g}{unit} is a constant: where the zero of what was held out lies, what was fitted "
        f"does not tell; without it {rest:.3g}{unit} is left."
    )
