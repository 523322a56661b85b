"""Duhem's hysteresis as of Coleman and Hodgdon: an output that goes towards a curve along the input's path.

[1] B. D. Coleman, M. L. Hodgdon, Int. J. Eng. Sci. 24 (1986) 897: a constitutive relation for rate-independent
    hysteresis in ferromagnetically soft materials.
[2] J. W. Macki, P. Nistri, P. Zecca, SIAM Review 35 (1993) 94: Duhem models among mathematical models of hysteresis.

Legend: u input, y output, f the curve that y goes towards, g the slope with which it leaves a reversal, alpha how fast
it goes there along the input's path.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Example, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models._data import STEEPEST, input_span, offset, output_span, sense, sided, steepness

TALLEST = 5.0
"""Largest heights of a box, in ranges of the output."""


@dataclass(frozen=True)
class Duhem(Model):
    """Duhem: an output that goes towards a curve along the input's path, Coleman and Hodgdon's law [1].

    y' = alpha |u'| (f(u) - y) + g(u) u' [1, 2];  f = slope u + height tanh((u - centre) / width),
    g = f' - lost - (lost_height / width) / cosh^2((u - centre) / width). Rate-independent, linear in the last four
    parameters. Minor loops drift towards the curve: what came before is forgotten along the path, not wiped out by a
    larger swing. Where lost and lost_height are not negative the loop runs anticlockwise, output over input; where
    they are not positive, clockwise. The box takes the side on which the records' loops run.

    Ours: f and g are these functions, where [1] leaves them open, so that the loop is high where the curve is steep,
    or everywhere. A curve c(u) beside it is this law again, with f + c and g + c'. With height = lost_height = 0 it is
    `bouc-wen` with gamma = 0. At the first sample y lies on f. The constant is the effect bias, or record-offset.
    """

    parameters = (
        Parameter("alpha", 1e-1, 1e3, "1/{input}", "log", meaning="how fast the output goes towards the curve"),
        Parameter("centre", -1.0, 1.0, "{input}", meaning="of the curve's steep part"),
        Parameter("width", 0.02, 2.0, "{input}", "log", meaning="of the curve's steep part", positive=True),
        Parameter("slope", -5.0, 5.0, "{output}/{input}", meaning="of the curve beyond its steep part"),
        Parameter("height", -5.0, 5.0, "{output}", meaning="of the curve's steep part, half of it"),
        Parameter("lost", 0.0, 5.0, "{output}/{input}", meaning="slope that a reversal takes from the curve's"),
        Parameter("lost_height", 0.0, 5.0, "{output}", meaning="height that it takes from the curve's steep part"),
    )
    linear = ("slope", "height", "lost", "lost_height")
    properties = ("rate-independent",)
    own_shapes: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("cubic-stiffness", "parallel-curve"), "with a curve f of another shape this law does the same by itself"
    )
    example = Example(
        4.0,
        {"alpha": 1.2, "centre": 0.2, "width": 1.4, "slope": 0.3, "height": 1.0, "lost": 0.1, "lost_height": 0.6},
        stream=27,
    )

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels.duhem import duhem

        y = np.empty((signal.input.shape[0], p.alpha.size))
        duhem(signal.input, np.stack(p), y)
        return y

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The output goes to the curve over a thousandth of the input's span to thirty spans; the steep part in the
        input's range, from a fiftieth of the span to twice of it wide; slopes up to 50 ratios of the spans, heights up
        to five times the range of the output."""
        alpha, centre, width, slope, height, lost, lost_height = self.parameters
        span, side = input_span(records), sense(records)
        low = min(float(np.min(record.input)) for record in records)
        high = max(float(np.max(record.input)) for record in records)
        middle = 0.5 * (low + high)
        steepest, tallest = STEEPEST * steepness(records), TALLEST * output_span(records)
        return (
            alpha.within(0.03 / span, 1000.0 / span),
            centre.within(middle - 0.5 * span, middle + 0.5 * span),
            width.within(0.02 * span, 2.0 * span),
            slope.within(-steepest, steepest),
            height.within(-tallest, tallest),
            sided(lost, steepest, side),
            sided(lost_height, tallest, side),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        return offset(records)
