"""An accepted description: terms that a residual was found to consist of, added to the output like an effect."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect
from hysteresis_bench.diagnosis.findings.terms import Equation, Term
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal


@dataclass(frozen=True)
class Description(Effect):
    """Terms that describe what a diagnosis left, as `diagnose --accept-terms` found them: a description, not physics.

    y = x + sum of coefficient (term - mean), x the response; what terms there are `diagnosis.terms` says.

    terms : one a term, with the fields of `Term` (kind, value, centre, resolution), and coefficient and mean;
        none changes nothing
    """

    acts = "added"
    family = "law"
    nuisance = True
    parameters: ClassVar[tuple[Parameter, ...]] = ()

    terms: tuple[dict[str, Any], ...] = ()

    def __post_init__(self) -> None:
        wanted = {"kind", "value", "centre", "resolution", "coefficient", "mean"}
        for number, term in enumerate(self.terms, 1):
            if set(term) != wanted:
                raise ValueError(f"term {number} must have {', '.join(sorted(wanted))}; it has {', '.join(term)}.")

    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        output = inner(signal)
        if not self.terms:
            return output
        records = [Record(signal.time, np.ascontiguousarray(u), None) for u in signal.input.T]
        added = np.zeros_like(output)
        for part in self.terms:
            term = Term(part["kind"], part["value"], part["centre"], part["resolution"])
            if term.of_output:
                columns = [term.column(records[0], one) for one in output.T]
            else:
                columns = [term.column(record) for record in records]
            added += part["coefficient"] * (np.column_stack(columns) - part["mean"])
        return output + added


def accepted(equation: Equation) -> Description:
    """The effect that adds an equation's terms."""
    return Description(
        tuple(
            {
                "kind": part.term.kind,
                "value": part.term.value,
                "centre": part.term.centre,
                "resolution": part.term.resolution,
                "coefficient": part.coefficient,
                "mean": part.mean,
            }
            for part in equation.terms
        )
    )
