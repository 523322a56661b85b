"""Cyclic error of the input: its sensor, or the gear that passes it on, is wrong by as much once a line or a tooth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects import _ripple
from hysteresis_plugins.effects._ranges import input_span

HIDDEN = 0.02
"""Of the largest drive, the amplitude in made data at full strength."""

SIDE = 3
"""Samples to either side over which the slope of the loop is taken."""


def _sinusoid(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u + HIDDEN * hiding.strength * hiding.amplitude * np.sin(_ripple.hidden(u, hiding.amplitude, hiding)))


def _run_out(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A disc that is off its centre: the angle that is read is an arc tangent's."""
    turn = _ripple.hidden(u, hiding.amplitude, hiding)
    off = np.arctan2(0.5 * np.sin(turn), 1.0 + 0.5 * np.cos(turn))
    return inner(u + HIDDEN * hiding.strength * hiding.amplitude * off)


@dataclass(frozen=True)
class InputCyclicError(Effect):
    """What acts is off the input by as much once a line, a tooth or a turn: an error of its sensor, or of a gear.

    v = u + sine s + cosine c, s = sin w + second sin 2 w + second_aside cos 2 w, w = 2 pi u / period, c as s
    with either harmonic a quarter of its period earlier, the model sees v: as of harmonic drives, whose error repeats
    itself twice a turn [1]. Ours: the second harmonic is told over the first, and is the smaller.

    The error has a minimum at every line of the residual along the input, so a fit should begin at what `starts`
    proposes.

    [1] T. D. Tuttle, W. P. Seering, IEEE Trans. Robotics and Automation 12 (1996) 368.
    """

    acts = "input"
    family = "cyclic error"
    affine = True
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_sinusoid,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_run_out,)
    parameters = _ripple.parameters("{input}", "{input}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.ripple import add_ripple

        if not (np.any(p.sine) or np.any(p.cosine)):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        acting = np.repeat(signal.input, p.sine.size // signal.input.shape[1], axis=1)
        add_ripple(acting, signal.input, p.period, _ripple.waves(p))
        return inner(signal.with_input(acting))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Amplitudes up to a thirtieth of the input's range: with the longest period that already turns it back."""
        return _ripple.box(self.parameters, [record.input for record in records], (input_span(records) or 1.0) / 30.0)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return _ripple.inapplicable(records, [record.input for record in records])

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]] | None:
        """The clearest periods along the input; the steeper the response, the larger is what they leave."""
        courses = [record.input[record.scored] for record in records]
        responses = [record.measured - left for record, left in zip(records, residuals, strict=True)]
        return _ripple.proposals(courses, residuals, list(map(_slopes, courses, responses)))


def _slopes(u: Array, y: Array) -> Array:
    """Of the output over the input, about each sample; up to three times the median."""
    du, dy = np.gradient(u), np.gradient(y)
    window = np.ones(2 * SIDE + 1)
    along, squares = (np.convolve(one, window, "same") for one in (du * dy, du * du))
    slopes: Array = along / np.maximum(squares, 1e-3 * squares.max())
    most = 3.0 * float(np.median(np.abs(slopes)))
    return np.clip(slopes, -most, most)
