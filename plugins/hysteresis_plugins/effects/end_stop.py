"""End stop: on one side the output meets something stiffer, or an instrument's range ends there."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import offset, output_span

LEVEL = 0.4
"""Of the largest response, where made data meet the stop, so that smaller drives and one-sided ones reach it."""

SHARP, WIDE = 1e-3, 0.125
"""Of the measured range: a corner that is rounded over less leaves no trace, over more it is a saturation. Stops by
other formulas were found at 0.04 to 0.08; with twice it one saturation by another formula was told as a stop."""

BEGUN = (0.01, 0.1)
"""Of the measured range, roundings from which a search begins."""


def _elastic(inner: Response, u: Array, hiding: Hiding) -> Array:
    y = inner(u)
    held: Array = np.where(y > LEVEL * hiding.top, y + hiding.strength * (LEVEL * hiding.top - y), y)
    return held


def _rounded(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Met gradually, over a tenth of the largest response to either side."""
    y, width = inner(u), 0.1 * hiding.top
    held: Array = y - hiding.strength * width * np.logaddexp(0.0, (y - LEVEL * hiding.top) / width)
    return held


def _padded(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A pad that stiffens as it is pressed."""
    y = inner(u)
    beyond = np.maximum(y - LEVEL * hiding.top, 0.0)
    held: Array = y - beyond + beyond / (1.0 + 4.0 * hiding.strength * beyond / hiding.top)
    return held


def _stiffening(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Felt from the middle on, ever more."""
    y = inner(u)
    rise = np.maximum(y / hiding.top, 0.0)
    held: Array = y - hiding.top * rise * np.tanh(1.5 * hiding.strength * rise**2)
    return held


def _from_below(form: HiddenForm) -> HiddenForm:
    """The same on the other side."""

    def below(inner: Response, u: Array, hiding: Hiding) -> Array:
        return -form(lambda v: -inner(v), u, hiding)

    return below


@dataclass(frozen=True)
class StopAbove(Effect):
    """Above a level the output goes on by a share less: a bilinear contact [1], met at once or gradually.

    y = x - share (d + sqrt(d² + rounding²)) / 2, d = x - level, x the response; with no rounding x - share max(d, 0).
    share = 1 is a rigid stop, or the end of an instrument's range; less of it is an elastic one, share = contact
    stiffness / (contact stiffness + own stiffness). Ours: the box of the share goes a quarter beyond 1, so that a rigid
    one does not lie at its edge; the corner is rounded to a hyperbola, as of a pad or of an instrument that gives way
    gradually. The box of the rounding is logarithmic and ends above its null 0, at a width that leaves no trace.

    [1] S. W. Shaw, P. J. Holmes, A periodically forced piecewise linear oscillator, Journal of Sound and Vibration 90
    (1983) 129-155.
    """

    acts = "output"
    family = "curve of the output"
    levels: ClassVar[tuple[float, float]] = (0.2, 1.0)
    """That are searched, in shares of the way from the lowest measured output to the highest."""
    held_back: ClassVar[float] = 0.97
    """Quantile of the measured output at which a search begins: what a stop holds back lies together at its level."""
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "saturation": "where the output reaches one end of its range only, both flatten that end",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_elastic,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_rounded, _padded, _stiffening)
    parameters = (
        Parameter("level", -1.0, 1.0, "{output}", meaning="of the response at which the stop is met"),
        Parameter("share", 0.0, 1.25, null=0.0, meaning="of what would pass the stop that it holds back"),
        Parameter("rounding", 1e-3, 1.0, "{output}", "log", null=0.0, meaning="width over which the stop is met"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.end_stop import stop_above

        output = own(inner(signal), signal)
        stop_above(output, p.level, p.share, p.rounding)
        return output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Levels in four fifths of the measured range, wherever its zero may be; corners rounded over a thousandth to
        an eighth of it."""
        level, share, rounding = self.parameters
        span = output_span(records) or 1.0
        y = _outputs(records)
        found = [at for way in self.levels for at in _of_the_response(records, float(np.min(y) + way * np.ptp(y)))]
        return level.within(min(found), max(found)), share, rounding.within(SHARP * span, WIDE * span)

    def inapplicable(self, records: Sequence[Record]) -> str:
        return "the output never moves" if output_span(records) == 0.0 else ""

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """A rigid stop where the outputs end that it would hold back, met at once or gradually."""
        levels = _of_the_response(records, float(np.quantile(_outputs(records), self.held_back)))
        span = output_span(records) or 1.0
        return [{"level": level, "share": 1.0, "rounding": w * span} for level in levels for w in BEGUN]


@dataclass(frozen=True)
class StopBelow(StopAbove):
    """Below a level the output goes on by a share less: `stop-above` on the other side."""

    levels = (0.0, 0.8)
    held_back = 1.0 - StopAbove.held_back
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_from_below(_elastic),)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (
        _from_below(_rounded),
        _from_below(_padded),
        _from_below(_stiffening),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.effects.end_stop import stop_below

        output = own(inner(signal), signal)
        stop_below(output, p.level, p.share, p.rounding)
        return output


def _outputs(records: Sequence[Record]) -> Array:
    return np.concatenate([record.measured for record in records])


def _of_the_response(records: Sequence[Record], output: float) -> list[float]:
    """Where the response may be at this output: the stop acts before an offset, which is known about only."""
    return [output, output - offset(records)] if offset(records) else [output]
