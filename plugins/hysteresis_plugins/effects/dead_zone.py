"""Dead zones: within a range nothing moves, as where a valve's spool overlaps its ports or a sensor does not answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, HiddenForm, Hiding, Response
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._in_place import own
from hysteresis_plugins.effects._ranges import input_span, motionless, offset, output_span

WIDEST = 0.4
"""Half-width, in ranges: 0.5 would let no motion through."""

INSIDE = 0.2
"""Of the range, from either end, where no centre is looked for: a dead zone at an end is a saturation."""

SHARP, ROUND = 1e-3, 0.125
"""Width of the edges' rounding, in ranges."""

PROPOSED = ((0.04, 2e-3), (0.12, 2e-3), (0.12, 0.05))
"""Half-widths and roundings from which to fit, in ranges."""


def _without(x: Array, half: float) -> Array:
    """What goes beyond half to either side."""
    return np.sign(x) * np.maximum(np.abs(x) - half, 0.0)


def _overlapped(inner: Response, u: Array, hiding: Hiding) -> Array:
    return inner(_without(u, 0.25 * hiding.strength * hiding.amplitude))


def _one_sided(inner: Response, u: Array, hiding: Hiding) -> Array:
    """The ports overlap on one side only."""
    return inner(np.where(u > 0.0, _without(u, 0.35 * hiding.strength * hiding.amplitude), u))


def _rounded(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Edges that are rounded by use: sqrt(x² + h²) - h in the place of the corner."""
    half = 0.35 * hiding.strength * hiding.amplitude
    return inner(np.sign(u) * (np.hypot(u, half) - half))


def _leaking(inner: Response, u: Array, hiding: Hiding) -> Array:
    """Between the edges a fifth leaks through."""
    half = 0.35 * hiding.strength * hiding.amplitude
    return inner(0.2 * u + 0.8 * _without(u, half))


def _deaf(inner: Response, u: Array, hiding: Hiding) -> Array:
    return _without(inner(u), 0.15 * hiding.strength * hiding.top)


def _waking(inner: Response, u: Array, hiding: Hiding) -> Array:
    """A sensor that answers little to little."""
    y, half = inner(u), 0.25 * hiding.strength * hiding.top
    return np.sign(y) * (np.hypot(y, half) - half)


@dataclass(frozen=True)
class InputDeadZone(Effect):
    """A dead zone of the input, such as of a valve whose spool overlaps its ports: within it nothing moves [1].

    v = u - share (held(u - centre) - held(-centre)), held(d) = min(max(d, -half_width), half_width); the model sees v.
    Unlike `backlash` it has no memory. Ours: about any centre, so that one side may be wider than the other, or all of
    it lie aside, and 0 stays 0; of less than the share 1 something leaks through; the edges are rounded to hyperbolas,
    held(d) = (|d + half_width| - |d - half_width|) / 2 with sqrt(x² + rounding²) for |x|. The box of the share begins
    at a half, as less is a bend (an output that is cut off had got one), and goes a quarter beyond 1, so that a dead
    zone that lets nothing through does not lie at its edge; that of the rounding ends above its null 0.

    [1] G. Tao, P. V. Kokotovic, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, Wiley (1996).
    """

    acts = "input"
    family = "curve of the input"
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_overlapped, _one_sided)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_rounded, _leaking)
    parameters = (
        Parameter("share", 0.5, 1.25, meaning="of the motion within the dead zone that does not pass"),
        Parameter("half_width", 0.0, 1.0, "{input}", null=0.0, meaning="of the dead zone"),
        Parameter("centre", -1.0, 1.0, "{input}", meaning="of the dead zone"),
        Parameter("rounding", 1e-3, 1.0, "{input}", "log", null=0.0, meaning="width over which its edges are rounded"),
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        if not np.any(p.half_width):  # the model sees the very input, still shared by the swarm
            return inner(signal)
        return inner(signal.with_input(_passed(signal.input, p)))

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Half-widths up to 0.4 ranges of the input, centres in three fifths of it."""
        return _box(self.parameters, [record.input for record in records], input_span(records))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return motionless(records)

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """About zero, where the input crosses it, or else about the middle of its range."""
        return _starts(self.box(records), input_span(records), [0.0])


@dataclass(frozen=True)
class OutputDeadZone(Effect):
    """A dead zone of the output, such as of a sensor that does not answer to little [1].

    y = x - share (held(x - centre) - held(-centre)), x the response, held and what is ours of it as of
    `input-dead-zone`.

    [1] G. Tao, P. V. Kokotovic, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, Wiley (1996).
    """

    acts = "output"
    family = "curve of the output"
    mistaken_for: ClassVar[Mapping[str, str]] = {
        "input-dead-zone": "of a thin loop a dead zone of the output is one of the input",
    }
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = (_deaf,)
    other_forms: ClassVar[tuple[HiddenForm, ...]] = (_waking,)
    parameters = tuple(
        replace(parameter, unit=parameter.unit.replace("input", "output")) for parameter in InputDeadZone.parameters
    )

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = own(inner(signal), signal)
        return _passed(output, p) if np.any(p.half_width) else output

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Half-widths up to 0.4 ranges of the output, centres in three fifths of it."""
        return _box(self.parameters, [record.measured for record in records], output_span(records))

    def inapplicable(self, records: Sequence[Record]) -> str:
        return "the output never moves" if output_span(records) == 0.0 else ""

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]]:
        """About zero, or where the output is with no input."""
        return _starts(self.box(records), output_span(records), [0.0, offset(records)])


def _passed(x: Array, p: Any) -> Array:
    from hysteresis_bench.kernels.rounded_dead_zone import rounded_dead_zone

    found: Array = rounded_dead_zone(x, p.share, p.half_width, p.centre, p.rounding)
    return found


def _box(own_parameters: tuple[Parameter, ...], courses: Sequence[Array], span: float) -> tuple[Parameter, ...]:
    share, half_width, centre, rounding = own_parameters
    low, high = min(float(one.min()) for one in courses), max(float(one.max()) for one in courses)
    edge, span = INSIDE * (high - low) or -1.0, span or 1.0  # a course that never moves has a box as well
    return (
        share,
        half_width.within(0.0, WIDEST * span),
        centre.within(low + edge, high - edge),
        rounding.within(SHARP * span, ROUND * span),
    )


def _starts(box: tuple[Parameter, ...], span: float, centres: Sequence[float]) -> list[dict[str, float]]:
    centre = box[2]
    middle = 0.5 * (centre.lower + centre.upper)
    found = {at if centre.lower <= at <= centre.upper else middle for at in centres}
    return [
        {"share": 1.0, "half_width": wide * span, "centre": at, "rounding": width * span}
        for at in sorted(found)
        for wide, width in PROPOSED
    ]
