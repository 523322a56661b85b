"""Every effect that was considered, and every step of the search, as a table shows them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.findings.stages import Stage
from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.diagnosis.findings.ties import Tie
from hysteresis_bench.diagnosis.search.round import Round
from hysteresis_bench.diagnosis.search.search import Found


@dataclass(frozen=True, eq=False)
class Candidate:
    """An effect that was considered, on top of the final system; an adopted one, against the system without it.

    p : of the nested-model test, not corrected;  advantage : standard errors by which it won on blocks left out
    share : of the mean square left over the noise without it, what it explains; NaN where nothing is left
    cv_rmse : NaN where it is not applicable, for the `reason`;  parameters : its own, in units
    stand_in : it is in the final model, and stands in for the law there
    """

    effect: str
    applicable: bool
    reason: str = ""
    adopted: bool = False
    rmse: float = float("nan")
    cv_rmse: float = float("nan")
    p: float = float("nan")
    advantage: float = float("nan")
    parameters: Mapping[str, float] | None = None
    at_bound: tuple[str, ...] = ()
    tied_with: tuple[str, ...] = ()
    share: float = float("nan")
    stand_in: bool = False


@dataclass(frozen=True)
class Step:
    """One step of the search: what was there, what each candidate made of it, what was taken.

    cv_rmse : by candidate
    """

    names: tuple[str, ...]
    rmse: float
    cv_rmse: Mapping[str, float]
    p: Mapping[str, float]
    chosen: str


def step_of(at: Round) -> Step:
    return Step(
        tuple(sorted(at.current.names)),
        at.current.rmse,
        {name: hypothesis.cv_rmse for name, hypothesis in at.hypotheses.items()},
        {name: test.p for name, test in at.tests.items()},
        at.chosen,
    )


def candidates_of(found: Found, ties: Sequence[Tie], stand_ins: Sequence[str]) -> tuple[Candidate, ...]:
    """Adopted ones first, then what stands in for the law, then by the error on blocks left out; what cannot be tried
    at the end."""
    rows = [row for name in found.selection.candidates if (row := _candidate(found, name, ties))]
    rows = [replace(row, adopted=False, stand_in=True) if row.effect in stand_ins else row for row in rows]
    rows.sort(key=lambda row: (not row.adopted, not row.stand_in, row.cv_rmse))
    return (*rows, *(Candidate(name, False, reason) for name, reason in found.impossible.items()))


def _candidate(found: Found, name: str, ties: Sequence[Tie]) -> Candidate | None:
    adopted = name in found.best.names
    smaller = found.without[name] if adopted else found.best
    larger = found.best if adopted else found.beyond.hypotheses.get(name)
    if larger is None:
        return None
    test, gain = found.selection.compared(smaller, larger)
    share = found.selection.share(smaller, larger) if found.selection.excess(smaller) > 0.0 else float("nan")
    prefix = f"{name}."
    return Candidate(
        name,
        True,
        adopted=adopted,
        rmse=larger.rmse,
        cv_rmse=larger.cv_rmse,
        p=test.p,
        advantage=gain,
        share=float(np.clip(share, 0.0, 1.0)),
        parameters={key.removeprefix(prefix): v for key, v in larger.values.items() if key.startswith(prefix)},
        at_bound=tuple(key for key in larger.at_bound if key.startswith(prefix)),
        tied_with=tuple(
            one.rival if one.effect == name else one.effect for one in ties if name in (one.effect, one.rival)
        ),
    )


def description_row(equation: Equation, before: Stage) -> Candidate:
    """What an accepted description did; p of its least significant term."""
    left_out = before.fitted.rmse * float(np.sqrt(max(1.0 - equation.share, 0.0)))
    return Candidate(
        registry.DESCRIPTION,
        True,
        adopted=True,
        rmse=left_out,
        cv_rmse=left_out,
        p=max(part.p for part in equation.terms),
        share=equation.share,
        parameters={part.term.symbol: part.coefficient for part in equation.terms},
    )
