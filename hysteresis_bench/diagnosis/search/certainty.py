"""How sure is each name? What is known of a claim, and how often such claims were right on made cases.

All hypotheses of a search are judged by their errors on the same blocks of samples, each left out of the fit. Blocks
are drawn anew with replacement [1], and each time the hypothesis is taken that predicts best; of those about as good,
the one of fewest parameters. How often an effect is among what is taken is its selection frequency [2]. It is told, and
is no probability: a wrong law, or a formula that nobody has, makes a wrong name win every draw; on the made cases below
it was 1 for 108 of 114 claims, the 6 wrong ones among them. What is left beside the names, how many there are, and how
many are tied tell more. A logistic regression of "the claim is right" on these numbers turns them into one [3].

[1] H. R. Kuensch, Ann. Statist. 17 (1989) 1217: blocks, as neighbouring samples are alike.
[2] N. Meinshausen, P. Buehlmann, J. R. Statist. Soc. B 72 (2010) 417.
[3] J. Platt, in: Advances in Large Margin Classifiers, MIT Press (2000) 61.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import default_rng

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.search.selection import ALIKE, Selection
from hysteresis_bench.fit.unseen.blocks import Blocks

DRAWS = 1000

CALIBRATION = (4.13, -0.28, -1.27, 0.72)
"""Constant, then weights of `Certainty.numbers`, fitted to 114 claims of 94 cases of the rig `hidden-effects`: six
laws, none to three effects, own and other formulas, imperfect records, and a few wrong laws. Fitted to 19 of 20 parts
and told of the twentieth, they were off by 0.048 on average. It has seen few wrong claims: below 0.8 it is a guess."""

SEEN = 1.2
"""Times the noise that may be left for a probability to be told: 106 of the 114 claims had no more. On the virtual rig
of a shape memory alloy, at 7.6 times the noise, the regression told 0.9 for two names that are not there."""


@dataclass(frozen=True)
class Certainty:
    """Of one claimed name.

    frequency : share of the bootstrap's draws in which the effect was taken
    left : RMSE over the noise on what was left out, of the final system, or of the better law with its effects
    names, rivals : how many effects are claimed, and how many are tied with this one
    """

    frequency: float
    left: float
    names: int
    rivals: int

    @property
    def numbers(self) -> Array:
        """What the calibration knows of a claim, (3,): log of what is left; names beside this one; log of one more
        than the rivals."""
        return np.array([np.log(max(self.left, 1.0)), self.names - 1.0, np.log1p(self.rivals)])

    @property
    def probability(self) -> float | None:
        """Of the effect, or of one tied with it, being there; None where more is left than the made cases left."""
        if self.left > SEEN:
            return None
        constant, *weights = CALIBRATION
        return float(1.0 / (1.0 + np.exp(-constant - self.numbers @ np.array(weights))))


def certainties(
    selection: Selection, final: Hypothesis, rivals: Mapping[str, int], left: float, seed: int
) -> dict[str, Certainty]:
    """Of every claimed name.

    final : what was selected;  rivals : claimed names, with how many are tied with each;  left : as in `Certainty`
    """
    known, blocks = list(selection.known.values()), selection.fitter.blocks
    found = frequencies([*known, final], blocks, list(rivals), seed) if rivals else {}
    return {name: Certainty(found[name], left, len(rivals), count) for name, count in rivals.items()}


def frequencies(hypotheses: Sequence[Hypothesis], blocks: Blocks, names: Sequence[str], seed: int) -> dict[str, float]:
    """Selection frequency of each name.

    hypotheses : with errors left out on the same samples;  blocks : of these samples
    """
    squares = np.column_stack([np.bincount(blocks.block, one.left_out**2) for one in hypotheses])
    samples = np.bincount(blocks.block).astype(float)
    count = samples.size
    drawn = default_rng(seed).multinomial(count, np.full(count, 1.0 / count), size=DRAWS).astype(float)
    errors = drawn @ squares / (drawn @ samples)[:, None]
    least = errors.min(axis=1, keepdims=True)
    parameters = np.array([len(one.values) for one in hypotheses], dtype=float)
    # of those about as good the one of fewest parameters; of these the best
    rank = np.where(errors <= ALIKE**2 * least, parameters + errors / (ALIKE**2 * least + 1e-300) * 0.5, np.inf)
    taken = np.argmin(rank, axis=1)
    return {name: float(np.mean(np.array([name in one.names for one in hypotheses])[taken])) for name in names}
