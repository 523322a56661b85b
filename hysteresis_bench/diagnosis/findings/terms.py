"""What no effect explains, as an equation: a sparse regression of the residual. A description, not physics.

Orthogonal matching pursuit [1] over a library of terms, on a residual made white (`autocorrelated`): the term that
explains most joins, as long as an F test with autocorrelated errors, corrected for the number of terms it was
chosen from, says that it is no accident; then terms that do not help to predict blocks of samples left out are
dropped. Ours: the pursuit's stopping rule, because samples of a residual are not independent.

[1] Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, Asilomar Conf. Signals Syst. Comput. 27 (1993) 40.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.evidence import autocorrelated, covariates
from hysteresis_bench.fit.unseen.blocks import blocked
from hysteresis_bench.signals import Record

LEVEL = 0.01
"""p-value of the F test up to which a term joins, over all terms that it was chosen from."""

MOST = 6
"""Terms of an equation that a person still reads."""

SHARE = 0.01
"""Of the residual's variance that the equation must explain on samples left out, and each term add."""

PLAYS = (0.05, 0.1, 0.2, 0.4, 0.7)
"""Half-widths, as shares of half the input's range."""

LAGS = 5
BLOCKS = 20
FOLDS = 5


@dataclass(frozen=True)
class Term:
    """One term of the library: a function of a record's input, time and modelled output.

    kind : u, u2, u3, rate, |rate|, branch, branch u, y, y2, last, since, |since|, play, lag, time, log time,
    cycle, cycle u
    value : half-width of a play (unit of u), time constant of a lag or of log time (unit of time), else 0
    centre : of the input, taken off before powers and products; resolution : least movement that is a reversal
    """

    kind: str
    value: float = 0.0
    centre: float = 0.0
    resolution: float = 0.0

    @property
    def rate(self) -> bool:
        """Does it need a time base?"""
        return self.kind in ("rate", "|rate|", "lag", "time", "log time")

    @property
    def of_output(self) -> bool:
        """Is it a function of the modelled output?"""
        return self.kind in ("y", "y2")

    def column(self, record: Record, simulated: Array | None = None) -> Array:
        """(samples,) of the whole record, history included; simulated : (samples,) the model's output.
        Raises ValueError where a term of the output gets none."""
        u, time = record.input, record.time
        x = u - self.centre
        if self.of_output:
            if simulated is None:
                raise ValueError(f"the term {self.kind} needs the model's output")
            return simulated if self.kind == "y" else simulated**2
        if self.kind in ("u", "u2", "u3"):
            return x ** {"u": 1, "u2": 2, "u3": 3}[self.kind]
        if self.kind in ("rate", "|rate|"):
            rate = np.gradient(u, time)
            return rate if self.kind == "rate" else np.abs(rate)
        if self.kind == "play":
            return covariates.play(x, self.value)
        if self.kind == "lag":
            return covariates.low_pass(time, x, self.value) - x
        if self.kind in ("time", "log time"):
            elapsed: Array = time - time[0]
            return elapsed if self.kind == "time" else np.log1p(elapsed / self.value)
        turns = covariates.turning_points(u, self.resolution)
        if self.kind in ("branch", "branch u"):
            branch = covariates.branch(u, turns)
            return branch if self.kind == "branch" else branch * x
        if self.kind in ("cycle", "cycle u"):
            cycle = covariates.cycle(u.size, turns)
            return cycle if self.kind == "cycle" else cycle * x
        last = covariates.last_extremum(u, turns) - self.centre
        return {"last": last, "since": x - last, "|since|": np.abs(x - last)}[self.kind]

    @property
    def symbol(self) -> str:
        """As in an equation."""
        x = "u" if self.centre == 0 else f"(u {'-' if self.centre > 0 else '+'} {abs(self.centre):.4g})"
        return {
            "u": x, "u2": f"{x}^2", "u3": f"{x}^3", "rate": "du/dt", "|rate|": "|du/dt|", "branch": "sign(du/dt)",
            "branch u": f"sign(du/dt) {x}", "y": "y", "y2": "y^2", "last": "u_last_extremum",
            "since": "(u - u_last_extremum)", "|since|": "|u - u_last_extremum|", "play": f"play(u, {self.value:.4g})",
            "lag": f"(lag(u, {self.value:.4g}) - u)", "time": "t", "log time": f"log(1 + t / {self.value:.4g})",
            "cycle": "cycle", "cycle u": f"cycle {x}",
        }[self.kind]  # fmt: skip

    def unit(self, record: Record) -> str:
        """Unit of the coefficient: the output's over the column's."""
        output, u, time = (record.units.get(key, "1") for key in ("output", "input", "time"))
        column = {
            "u2": f"{u}^2", "u3": f"{u}^3", "rate": f"({u}/{time})", "|rate|": f"({u}/{time})", "branch": "", 
            "y": output, "y2": f"{output}^2", "time": time, "log time": "", "cycle": "",
        }.get(self.kind, u)  # fmt: skip
        return output if column in ("", "1") else f"{output}/{column}"


@dataclass(frozen=True)
class FittedTerm:
    """A term with its coefficient in units; `mean` of its column over the fitted samples is taken off; `p` is corrected
    for the terms that it was chosen from."""

    term: Term
    coefficient: float
    standard_error: float
    unit: str
    mean: float
    p: float


@dataclass(frozen=True)
class Equation:
    """What describes the residual, measured minus modelled. Without terms: nothing does.

    share : of the residual's variance about each record's mean, explained on samples left out
    """

    terms: tuple[FittedTerm, ...]
    share: float

    def evaluate(self, record: Record, simulated: Array | None = None) -> Array:
        """(samples,) to be added to the model's output; simulated : (samples,) that output. Its mean over the
        fitted samples is zero: constants are left to bias and record-offset."""
        parts = [part.coefficient * (part.term.column(record, simulated) - part.mean) for part in self.terms]
        return np.sum(parts, axis=0) if parts else np.zeros(record.time.size)

    def __str__(self) -> str:
        if not self.terms:
            return "residual = nothing that these terms describe"
        parts = [f"{part.coefficient:+.4g} {part.unit} * {part.term.symbol}" for part in self.terms]
        return "residual = " + " ".join(parts) + " + constant"


def find_terms(
    records: Sequence[Record], residuals: Sequence[Array], simulated: Sequence[Array] | None = None
) -> Equation:
    """Describe the residual by a few terms.

    residuals : (scored samples,) a record, measured minus modelled
    simulated : (samples,) a record, the model's output, history included; without it there is no term of y
    """
    outputs = [None] * len(records) if simulated is None else list(simulated)
    library = _library(records, with_output=simulated is not None)
    columns = [
        np.column_stack([term.column(record, output)[record.scored] for term in library])
        for record, output in zip(records, outputs, strict=True)
    ]
    scale = np.std(np.vstack(columns), axis=0)
    usable = scale > 1e-9 * np.max(np.abs(np.vstack(columns)), axis=0, initial=0.0)
    library = [term for term, varies in zip(library, usable, strict=True) if varies]
    columns = [part[:, usable] / scale[usable] for part in columns]
    chosen, levels = _pursue(residuals, columns)
    chosen = _pruned(residuals, columns, chosen)
    share = _share(residuals, columns, chosen)
    if not chosen or share < SHARE:
        return Equation((), 0.0)
    coefficients, errors = _fit(residuals, [part[:, chosen] for part in columns])
    means = np.mean(np.vstack(columns)[:, chosen], axis=0) * scale[usable][chosen]
    fitted = [
        FittedTerm(
            library[index],
            float(c / size),
            float(error / size),
            library[index].unit(records[0]),
            float(mean),
            levels[index],
        )
        for index, c, error, size, mean in zip(chosen, coefficients, errors, scale[usable][chosen], means, strict=True)
    ]
    return Equation(tuple(fitted), share)


def _library(records: Sequence[Record], with_output: bool) -> list[Term]:
    joined = np.concatenate([record.input for record in records])
    low, high = float(joined.min()), float(joined.max())
    centre, half = float(f"{0.5 * (low + high):.4g}"), 0.5 * (high - low)
    resolution = max(covariates.resolution_of(record.input) for record in records)
    kinds = [
        "u", "u2", "u3", "rate", "|rate|", "branch", "branch u", "last", "since", "|since|", "time", "cycle", "cycle u",
    ]  # fmt: skip
    library = [Term(kind, 0.0, centre, resolution) for kind in kinds + (["y", "y2"] if with_output else [])]
    library += [Term("play", float(f"{share * half:.3g}"), centre) for share in PLAYS if half > 0]
    if all(record.timed for record in records):
        step = min(float(np.median(np.diff(record.time))) for record in records)
        longest = max(float(record.time[-1] - record.time[0]) for record in records)
        constants = [float(f"{c:.3g}") for c in np.geomspace(2.0 * step, max(longest / 3.0, 4.0 * step), LAGS)]
        return library + [Term("lag", c, centre) for c in constants] + [Term("log time", c) for c in constants[1::2]]
    return [term for term in library if not term.rate]


def _pursue(residuals: Sequence[Array], columns: Sequence[Array]) -> tuple[list[int], dict[int, float]]:
    """Indices of the terms that join, and the corrected p of each when it joined."""
    chosen: list[int] = []
    levels: dict[int, float] = {}
    one = autocorrelated.constants(residuals)
    e = np.concatenate(list(residuals))
    while len(chosen) < MOST and len(chosen) < columns[0].shape[1]:
        apart = [np.column_stack([level, part[:, chosen]]) for level, part in zip(one, columns, strict=True)]
        left = autocorrelated.split(autocorrelated.left_over(e, np.vstack(apart)), residuals)
        filter_ = autocorrelated.autoregression(left)
        white, nuisance, candidates = (
            np.concatenate(autocorrelated.whitened(part, filter_)) for part in (left, apart, columns)
        )
        cleared = np.column_stack([autocorrelated.left_over(column, nuisance) for column in candidates.T])
        white = autocorrelated.left_over(white, nuisance)
        size = np.sum(cleared**2, axis=0)
        gains = np.where(
            size > 1e-8 * np.sum(candidates**2, axis=0), (white @ cleared) ** 2 / np.maximum(size, 1e-300), 0.0
        )
        gains[chosen] = 0.0
        index = int(np.argmax(gains))
        if gains[index] <= 0.0:
            break
        test = autocorrelated.f_test(
            residuals, [part[:, [index]] for part in columns], [part[:, chosen] for part in columns]
        )
        p = test.p * (columns[0].shape[1] - len(chosen))  # one was chosen from so many
        if p > LEVEL:
            break
        chosen.append(index)
        levels[index] = p
    return chosen, levels


def _pruned(residuals: Sequence[Array], columns: Sequence[Array], chosen: list[int]) -> list[int]:
    """Without the terms that add less than SHARE to what is explained of samples left out, the least first."""
    while len(chosen) > 1:
        without = [_share(residuals, columns, [other for other in chosen if other != index]) for index in chosen]
        least = int(np.argmax(without))
        if without[least] < _share(residuals, columns, chosen) - SHARE:
            break
        chosen = [index for place, index in enumerate(chosen) if place != least]
    return chosen


def _share(residuals: Sequence[Array], columns: Sequence[Array], chosen: Sequence[int]) -> float:
    """Of the variance about each record's mean, explained on blocks left out."""
    if not chosen:
        return 0.0
    fold = blocked([part.size for part in residuals], [BLOCKS] * len(residuals), FOLDS).fold
    e, one = np.concatenate(list(residuals)), np.vstack(autocorrelated.constants(residuals))
    x = np.hstack([one, np.vstack(columns)[:, list(chosen)]])

    def squares(design: Array) -> float:
        total = 0.0
        for number in range(FOLDS):
            inside = fold == number
            fit = np.linalg.lstsq(design[~inside], e[~inside], rcond=1e-10)[0]
            total += float(np.sum((e[inside] - design[inside] @ fit) ** 2))
        return total

    return 1.0 - squares(x) / max(squares(one), 1e-300)


def _fit(residuals: Sequence[Array], columns: Sequence[Array]) -> tuple[Array, Array]:
    """Least-squares coefficients, and the standard errors that these have with autocorrelated errors. Of what was made
    white they would be smaller, and the coefficients off where a column is late by a sample."""
    from scipy.signal import lfilter

    e, one = np.concatenate(list(residuals)), autocorrelated.constants(residuals)
    design = np.vstack([np.column_stack([level, part]) for level, part in zip(one, columns, strict=True)])
    inverse = np.linalg.pinv(design)
    coefficients = inverse @ e
    left = autocorrelated.split(e - design @ coefficients, residuals)
    filter_ = autocorrelated.autoregression(left)
    white = np.concatenate(autocorrelated.whitened(left, filter_))
    variance = float(white @ white) / max(white.size - coefficients.size, 1)
    ends = np.cumsum([part.size for part in residuals])[:-1]
    moved = [  # each coefficient, by every innovation of a record, and by as many before it
        lfilter([1.0], [1.0, *-filter_], np.hstack([part[:, ::-1], np.zeros_like(part)]))
        for part in np.split(inverse, ends, axis=1)
    ]
    errors = np.sqrt(variance * np.sum(np.hstack(moved) ** 2, axis=1))
    terms = columns[0].shape[1]
    return coefficients[-terms:], errors[-terms:]
