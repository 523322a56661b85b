"""What a free form promises beside what every effect does: a curve without a formula that stands for its family."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect


@dataclass(frozen=True, eq=False)
class Curve:
    """What a free form found, to be drawn and told.

    x, y : (points,);  along, of : what they are, in words;  x_unit, y_unit : may name {input}, {output} and {time}
    logarithmic : x is told in decades
    """

    x: Array
    y: Array
    along: str
    of: str
    x_unit: str = "1"
    y_unit: str = "1"
    logarithmic: bool = False


class FreeForm(Effect):
    """An effect that stands for its family as a whole, where no formula of it does as well. It is never a candidate by
    itself.

    Its parameters with a null are coefficients, in which it is linear or nearly so; the others say where it bends.
    """

    ranges: ClassVar[tuple[str, ...]] = ()
    """Parameters that tell the range of the data: a diagnosis fixes them in the middle of their box."""

    limits: ClassVar[tuple[str, ...]] = ()
    """Parameters whose box may end in a limiting curve, such as one without a bend: at its edge nothing is amiss."""

    @abstractmethod
    def curve(self, p: Any) -> Curve:
        """What was found, of one set of parameters: p as in Effect.apply, a number each."""
