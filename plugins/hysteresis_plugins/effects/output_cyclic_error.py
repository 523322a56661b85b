"""Cyclic error of the output: its sensor is wrong by as much once a line of its scale, or once a fringe."""

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
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import output_span

HIDDEN = 0.06
"""Of the largest response, the amplitude in made data at full strength."""


def _sinusoid(inner: Response, u: Array, hiding: Hiding) -> Array:
    y = inner(u)
    return y + HIDDEN * hiding.strength * abs(hiding.top) * np.sin(_ripple.hidden(y, abs(hiding.top), hiding))


def _quadrature(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Heydemann's: the two signals of an interferometer have offsets and unequal gains, and are not at right angles."""
    y, s = inner(u), hiding.strength
    turn = _ripple.hidden(y, abs(hiding.top), hiding)
    length = abs(hiding.top) / (np.pi * _ripple.hidden_periods(hiding))  # of a fringe, over 2 pi
    first, second = np.cos(turn) + 0.3 * s, (1.0 - 0.3 * s) * np.sin(turn + 0.2 * s) - 0.2 * s
    return np.asarray(y + length * np.angle((first + 1j * second) * np.exp(-1j * turn)))


@dataclass(frozen=True)
class OutputCyclicError(Effect):
    """The output's sensor has an error that repeats itself along its scale, once a line, a tooth or a fringe.

    y = x + sine s + cosine c, s = sin w + second sin 2 w + second_aside cos 2 w, w = 2 pi x / period, c as s
    with either harmonic a quarter of its period earlier, x the response: the first and second order errors of
    interferometers and encoders, whose signals have offsets, unequal gains and a wrong phase [1, 2]. Ours: the second
    is told over the first, and is the smaller.

    The error has a minimum at every line of the residual along the output, so a fit should begin at what `starts`
    proposes.

    [1] P. L. M. Heydemann, Appl. Opt. 20 (1981) 3382.
    [2] C.-M. Wu, R. D. Deslattes, Appl. Opt. 37 (1998) 6696.
    """

    acts = "output"
    family = "cyclic error"
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_sinusoid,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_quadrature,)
    parameters = _ripple.parameters("{output}", "{output}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.ripple import add_ripple

        output = own(inner(signal), signal)
        add_ripple(output, output, p.period, _ripple.waves(p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Amplitudes up to a tenth of the output's range."""
        most = 0.1 * (output_span(records) or 1.0)
        return _ripple.box(self.parameters, [record.measured for record in records], most)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return _ripple.inapplicable(records, [record.measured for record in records])

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]] | None:
        """The clearest periods along the output that the residuals leave to the response."""
        courses = [record.measured - left for record, left in zip(records, residuals, strict=True)]
        return _ripple.proposals(courses, residuals)
