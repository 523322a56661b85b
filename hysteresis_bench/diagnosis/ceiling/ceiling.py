"""What the best black box reaches on excitations left out: a ceiling beside the named model, as the noise is a floor.

The black box is a ridge regression on columns of the measured input, of time and of path (`bank`), alone or on top of
what the named model leaves. Inner folds choose which, with its columns and its penalty; outer ones, which had no say,
judge it and the named model alike: the same samples left out, the same weights, the same offset. Only through the few
parameters of named models that inner folds compare does the outer one have a say in the choice.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.ceiling.bank import Bank
from hysteresis_bench.diagnosis.ceiling.folds import folds_of
from hysteresis_bench.diagnosis.ceiling.nested import Nested
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.hypotheses.fitter import Fitter
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.fit.unseen.advantage import CLEAR, advantage
from hysteresis_bench.fit.unseen.whole import extrapolated
from hysteresis_bench.kernels.root_mean_square import rms

REMAINS = 1.1
"""Times the floor up to which the named model comes down to the noise. On 83 made cases, 72 of which lacked a law or
an effect, this, `SHARE` and `CLEAR` told 66 of those and one of the others; 66 too with 1.05 or 1.2."""
SHARE = 0.1
"""Of the named model's excess over the floor (mean square), which a black box must explain to do clearly better. Half
of it told 66, twice 64; half of `CLEAR` 67, twice 63; one of the others, or none."""
FEWEST = 3
"""Folds from which a black box can find what is missing: with two it learns from one excitation alone."""
MOST = 8000
"""Samples that are judged."""

COLUMNS = ("a curve of the input", "past extrema", "past extrema and lags", "past extrema, lags, time and path")
"""Of each level of `bank`."""
NOTHING = "which adds nothing to it"


@dataclass(frozen=True)
class Ceiling:
    """RMSE on excitations left out, unit of the output.

    named : of the named model;  black_box : of the best black box;  alone : of the best one that does not know the
    named model;  advantage : of the black box, in standard errors of its mean square, paired over blocks
    columns : of the black box, in words;  left_out : in turn, in words, in so many folds;  unit : of the output
    floor : RMS below which nothing is judged;  noise : of the data;  repeats : by how much equal cycles differ, where
    that is clearly more;  told : what is left is told elsewhere, as noise;  law : as another law's
    """

    named: float
    black_box: float
    alone: float
    advantage: float
    columns: str
    left_out: str
    folds: int
    unit: str
    floor: float
    noise: float
    repeats: float | None
    told: bool = False
    law: bool = False

    @property
    def heard(self) -> float:
        """The floor; what the black box reaches, where the floor is put too high."""
        return min(self.floor, self.black_box)

    @property
    def reached(self) -> bool:
        """Does the named model leave the noise?"""
        return self.named <= REMAINS * self.heard

    @property
    def better(self) -> bool:
        """Does the black box do clearly better?"""
        gain, excess = self.named**2 - self.black_box**2, self.named**2 - self.heard**2
        return not self.reached and self.advantage > CLEAR and gain > SHARE * excess

    @property
    def finds_nothing(self) -> bool:
        """Does the black box, judged by enough folds, find nothing of what the named model leaves above the noise?"""
        return not self.reached and not self.better and self.folds >= FEWEST

    @property
    def words(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        said = (
            f"On excitations left out ({self.left_out}) the named model reaches {self.named:.3g}{unit} and a black box "
            f"({self.columns}) {self.black_box:.3g}; the noise is {self.noise:.3g}"
            f"{f', and repeats differ by {self.repeats:.3g}' if self.repeats else ''}."
        )
        if self.reached:
            return f"{said} The named model comes down to the noise of all records together."
        if self.better:
            return (
                f"{said} The black box does clearly better, by {rounded(self.advantage)} standard errors: what is "
                "missing is in these data, in the law or as an effect."
            )
        if self.repeats and self.named <= REMAINS * self.repeats:
            return (
                f"{said} The black box does not do clearly better, and what is left is no more than repeats differ by: "
                "noise that changes slowly, or something beside the input."
            )
        if self.folds < FEWEST:
            return (
                f"{said} The black box does not do clearly better, which says little after a fit to "
                "one other excitation: add some."
            )
        if self.law:  # a black box beside the wrong law may not find what the right one knows
            return f"{said} The black box does not do clearly better; another law does."
        said = (
            f"{said} The black box does not do clearly better: what is left, {rounded(self.named / self.floor)} times "
            "the noise, is nothing that it finds in the input's history or in a smooth course of time or path."
        )
        if self.told:
            return said
        return (
            f"{said} Rather than search for further effects of these, measure another quantity that may act, such as a "
            "load or the temperature of another part, repeat an excitation to hear slow noise, or add excitations."
        )

    def as_dict(self) -> dict[str, Any]:
        """For diagnosis.json."""
        known = {key: value for key, value in asdict(self).items() if key not in ("told", "law")}
        return {**known, "reached": self.reached, "clearly_better": self.better, "words": self.words}


def ceiling(fitter: Fitter, named: Hypothesis, floor: float, noise: Noise) -> Ceiling:
    """Of the fitted records.  named : the final system;  floor : RMS below which nothing is judged"""
    # neither folds nor sums may depend on the order in which the records came
    records = tuple(sorted(fitter.stack.records, key=lambda record: record.name))
    effects = [fitter.stack.effect(name) for name in sorted(named.names)]
    folds = folds_of(records, extrapolated(effects, records))
    left = fitter.errors_without(named, records, folds.blocks)
    number = np.repeat(np.arange(len(records)), [record.measured.size for record in records])
    centred = registry.RECORD_OFFSET in named.names
    parts = [record.measured - np.mean(record.measured) if centred else record.measured for record in records]
    targets = np.column_stack([np.concatenate(parts), left])
    stride = -(-number.size // MOST)
    folds, targets, number = folds.every(stride), targets[::stride], number[::stride]
    nested = Nested(Bank(records, stride), folds, targets, number, centred)
    own, black_box, alone = (np.empty(number.size) for _ in range(3))
    found = []
    for fold in folds.outer:
        bare, beside, free = nested.without(fold), nested.chosen(fold, beside=True), nested.chosen(fold, beside=False)
        best = min((bare, beside, free), key=lambda one: one.score)
        found.append(NOTHING if best is bare else COLUMNS[best.level] + (", beside it" if best is beside else ""))
        own[fold.judged], alone[fold.judged] = bare.errors, free.errors
        black_box[fold.judged] = best.errors
    return Ceiling(
        named=rms(own),
        black_box=rms(black_box),
        alone=rms(alone),
        advantage=float(advantage(black_box, own, folds.blocks)),
        columns=max(sorted({*found}), key=found.count),
        left_out=folds.how,
        folds=folds.blocks.folds,
        unit=records[0].units.get("output", "1"),
        floor=floor,
        noise=noise.floor,
        repeats=noise.repeat_rms if noise.coloured else None,
    )
