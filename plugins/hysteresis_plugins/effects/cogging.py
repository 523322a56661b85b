"""Cogging: beside the hysteresis acts a force that repeats itself along the input."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
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

HIDDEN = 0.1
"""Of the largest response, the amplitude in made data at full strength."""


def _sinusoid(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(u) + HIDDEN * hiding.strength * hiding.top * np.sin(_ripple.hidden(u, hiding.amplitude, hiding))


def _skewed(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Teeth that are steeper on one side."""
    turn = _ripple.hidden(u, hiding.amplitude, hiding)
    return inner(u) + HIDDEN * hiding.strength * hiding.top * np.sin(turn) / (1.0 + 0.5 * np.cos(turn))


def _detents(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A triangle: between two detents the force is straight."""
    return inner(u) + HIDDEN * hiding.strength * hiding.top * np.arcsin(
        np.sin(_ripple.hidden(u, hiding.amplitude, hiding))
    )


@dataclass(frozen=True)
class Cogging(Effect):
    """Beside the hysteresis acts a force that repeats itself along the input, such as a motor's cogging.

    y = x + sine s + cosine c, s = sin w + second sin 2 w + second_aside cos 2 w, w = 2 pi u / period, c as s
    with either harmonic a quarter of its period earlier, x the response: the first two harmonics, as of a linear
    motor's cogging [1]. Ours: the second is told over the first, and is the smaller.

    Two amplitudes are linear, the period is not: the error has a minimum at every line of the residual along the input,
    so a fit should begin at what `starts` proposes.

    [1] P. J. Hor, Z. Q. Zhu, D. Howe, J. Rees-Jones, IEEE Trans. Magnetics 34 (1998) 3544.
    """

    acts = "law"
    family = "cyclic error"
    affine = True
    linear = _ripple.AMPLITUDES
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "input-cyclic-error": "where a loop is equally steep, an error of the input is one of the output",
        "output-cyclic-error": "of a thin, straight loop, what repeats itself along the input does so along the output",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_sinusoid,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_skewed, _detents)
    parameters = _ripple.parameters("{output}", "{input}")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.ripple import add_ripple

        output = own(inner(signal), signal)
        add_ripple(output, signal.input, p.period, _ripple.waves(p))
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Amplitudes up to a fifth of the output's range."""
        return _ripple.box(self.parameters, [record.input for record in records], 0.2 * (output_span(records) or 1.0))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return _ripple.inapplicable(records, [record.input for record in records])

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]] | None:
        """The clearest periods along the input."""
        return _ripple.proposals([record.input[record.scored] for record in records], residuals)
