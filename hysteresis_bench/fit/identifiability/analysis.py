"""What the data can tell about the parameters: standard errors, correlation, and what they cannot see.

The Jacobian at the optimum comes from central differences of one swarm a record. Its singular values say
how many directions of parameter space the output sees at all; the rest are told as what does act: products
of powers, or sums. What is seen has a covariance, from residuals that may be correlated in time.

[1] D. W. K. Andrews, Heteroskedasticity and autocorrelation consistent covariance matrix estimation,
    Econometrica 59 (1991) 817; Bartlett weights of Newey and West, Econometrica 55 (1987) 703.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.identifiability.combinations import MOST, Blindness, Combination, blind_groups, listed
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.kernels import levenberg_marquardt
from hysteresis_bench.parameters import Space

STEP = np.finfo(float).eps ** (1 / 3)
"""Central differences, in scaled parameters: where truncation and rounding are alike."""
MARGIN = 10.0
"""A direction is unseen when its effect is below this many times the error of the differences."""
FOLLOWED, FLAT = 40, 1e-10
"""Iterations of a profile's fits at most, and the relative fall of the sum of squares by which one ends."""
STRONG = 0.99
"""Correlations above this are told."""


@dataclass(frozen=True, eq=False)
class Identifiability:
    """What the records tell about the parameters near some values.

    names : of the d parameters
    values, standard_errors : (d,) in units; an error is inf where the data cannot tell the parameter
    correlation : (d, d); NaN where an error is inf
    singular_values : (d,) of the Jacobian, falling, in units of the output for a parameter times e (positive
        box) or moved through its whole box; summed over samples
    uncertainty : (d,) standard error along each singular direction, in the same scaled parameters
    rank : directions that the output sees at all, noise or not
    determined : directions of these known better than a factor of e, or than the whole box
    directions : (d, d), a column each, in scaled parameters
    noise_rms : of the residuals;  effective_samples : how many uncorrelated samples they are worth
    blind : what the output cannot see, group by group
    """

    names: tuple[str, ...]
    values: Array
    standard_errors: Array
    correlation: Array
    singular_values: Array
    uncertainty: Array
    directions: Array
    rank: int
    determined: int
    noise_rms: float
    effective_samples: float
    blind: tuple[Blindness, ...]

    @property
    def acting(self) -> tuple[Combination, ...]:
        """What the output depends on: the combinations of the blind groups, and every other parameter by itself."""
        blind = {name for blindness in self.blind for name in blindness.names}
        alone = tuple(Combination("product", ((name, 1.0),)) for name in self.names if name not in blind)
        return tuple(combination for blindness in self.blind for combination in blindness.combinations) + alone

    def sentences(self) -> tuple[str, ...]:
        """What a user must know before believing the parameters; empty where the output sees every direction, and each
        is known better than a factor of e. How well a parameter is known is for its standard error to say."""
        sentences = []
        if self.rank < len(self.names):
            sentences.append(f"The output sees {self.rank} of {len(self.names)} directions of the parameters.")
        sentences += [str(blindness) for blindness in self.blind]
        for direction in range(self.determined, self.rank):
            weights = np.abs(self.directions[:, direction])
            moved = [name for name, weight in zip(self.names, weights, strict=True) if weight > 0.3 * weights.max()]
            sentences.append(f"Noise hides how {listed(moved, MOST)} act{'s' if len(moved) == 1 else ' together'}.")
        for i, j in np.argwhere(np.triu(np.abs(np.nan_to_num(self.correlation)), 1) > STRONG):
            sentences.append(f"{self.names[i]} and {self.names[j]} are correlated by {self.correlation[i, j]:.4f}.")
        return tuple(dict.fromkeys(sentences))  # of two directions of the same parameters one


def analyse(problem: Problem, values: Array, correlated: bool = True) -> Identifiability:
    """Identifiability near `values` (dimension,), in units, usually the optimum.

    correlated : let standard errors grow with the residuals' autocorrelation, as [1]
    Raises ValueError where there are no more samples than parameters, or where the output is not finite.
    """
    scale, values = _scale(problem, values), np.asarray(values, dtype=float)
    if problem.samples <= values.size:
        raise ValueError(f"{problem.samples} samples cannot determine {values.size} parameters")
    jacobian, error, simulated = _jacobian(problem, values, scale)
    if not (np.all(np.isfinite(jacobian)) and np.all(np.isfinite(simulated))):
        raise ValueError("the simulated output is not finite near these values")
    left, singular, right = np.linalg.svd(jacobian, full_matrices=False)
    directions = right.T
    rounding = np.finfo(float).eps ** (2 / 3) * np.linalg.norm(simulated)
    unseen = singular <= MARGIN * np.maximum(np.linalg.norm(error @ directions, axis=0), rounding)
    rank = int(np.argmax(unseen)) if unseen.any() else values.size
    seen, lost = directions[:, :rank], directions[:, rank:]

    measured = [record.measured for record in problem.records]
    residuals = np.split(simulated - np.concatenate(measured), np.cumsum([m.size for m in measured])[:-1])
    autocovariance = _autocovariance(residuals, correlated) * problem.samples / (problem.samples - rank)
    spread = _smoothed(left[:, :rank], residuals, autocovariance) / np.outer(singular[:rank], singular[:rank])
    covariance = seen @ spread @ seen.T
    uncertainty = np.concatenate([np.sqrt(np.diag(spread)), np.full(values.size - rank, np.inf)])
    deviation = np.sqrt(np.diag(covariance))
    deviation[np.linalg.norm(lost, axis=1) > 1e-3] = np.inf
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = np.where(np.isinf(np.add.outer(deviation, deviation)), np.nan, covariance)
        correlation = correlation / np.outer(deviation, deviation)
    return Identifiability(
        problem.space.names,
        values,
        deviation * scale,
        correlation,
        singular,
        uncertainty,
        directions,
        rank,
        determined=int(np.sum(uncertainty < 1.0)),
        noise_rms=float(np.sqrt(np.mean(np.concatenate(residuals) ** 2))),
        effective_samples=problem.samples / _inflation(autocovariance),
        blind=blind_groups(problem.space.names, values, scale[:, None] * lost),
    )


def analyse_others(problem: Problem, values: Array, taken: Collection[str]) -> tuple[Identifiability, Array]:
    """Identifiability of the parameters beside those that are `taken` for known, such as the weights of a smooth
    density, of which no single one means anything; and standard errors of all, inf of those, (dimension,) in units."""
    others = np.array([name not in taken for name in problem.space.names])
    known = {name: float(value) for name, value in zip(problem.space.names, values, strict=True) if name in taken}
    system = replace(problem.system, fixed={**problem.system.fixed, **known})
    space = Space(tuple(p for p, other in zip(problem.space.parameters, others, strict=True) if other))
    found = analyse(Problem(system, problem.records, space, problem.loss), values[others])
    errors = np.full(values.size, np.inf)
    errors[others] = found.standard_errors
    return found, errors


@dataclass(frozen=True, eq=False)
class Profile:
    """The best fit with one parameter held at each value of a grid.

    grid : (points,) in units;  values : (dimension, points) of all parameters, in units
    squares : (points,) sum of squared errors;  ratio : (points,) likelihood ratio against the best of all,
        n ln(squares / least): below 3.84 a value is within the 95 % interval where residuals are uncorrelated
    """

    name: str
    grid: Array
    values: Array
    squares: Array
    ratio: Array


def profile(problem: Problem, name: str, grid: Array, *, values: Array) -> Profile:
    """Profile likelihood of one parameter: the others are fitted anew from the neighbouring grid value.

    grid : inside the parameter's box, any order;  values : (dimension,) where to begin, usually the optimum.
    Raises ValueError for an unknown name or a grid that leaves the box.
    """
    names = problem.space.names
    if name not in names:
        raise ValueError(f"no parameter {name!r}; there are: {', '.join(names)}")
    row = names.index(name)
    parameter = problem.space.parameters[row]
    grid = np.sort(np.asarray(grid, dtype=float))
    if not (parameter.lower <= grid[0] and grid[-1] <= parameter.upper):
        raise ValueError(f"{name}: the grid leaves the box, {parameter.lower:g} to {parameter.upper:g}")
    others = np.arange(len(names)) != row
    optimum = np.clip(problem.space.to_unit(np.reshape(values, (-1, 1)))[:, 0], 0.0, 1.0)
    points = np.repeat(optimum[:, None], grid.size, axis=1)
    points[row] = np.clip(problem.space.to_unit(np.where(others[:, None], values[:, None], grid))[row], 0.0, 1.0)

    def full(free: Array, chains: Array) -> Array:
        swarm = points[:, chains]
        swarm[others] = free
        return swarm

    def follow(starts: Array) -> tuple[Array, Array]:
        return levenberg_marquardt.descend(
            lambda free, chains: problem.residuals(full(free, chains)),
            lambda free, chains: np.fmin(problem.squares(full(free, chains)), problem.worst),
            np.clip(starts, 1e-9, 1.0 - 1e-9),
            iterations=FOLLOWED,
            converged=FLAT,
        )

    # from the optimum, then from what the neighbour on the optimum's side has found
    found, squares = follow(points[others])
    inwards = np.arange(grid.size) - np.sign(np.arange(grid.size) - int(np.argmin(np.abs(points[row] - optimum[row]))))
    again, less = follow(found[:, inwards])
    points[others] = np.where(less < squares, again, found)
    squares = np.fmin(squares, less)
    least = min(float(squares.min()), float(problem.squares(optimum[:, None])[0]))
    ratio = problem.samples * np.log(np.maximum(squares, 1e-300) / max(least, 1e-300))
    return Profile(name, grid, problem.space.from_unit(points), squares, ratio)


def outputs(problem: Problem, values: Array) -> Array:
    """Scored samples of all records; values : (dimension, swarm), in units -> (samples, swarm)."""
    values = np.ascontiguousarray(values)
    return np.concatenate([problem.system.respond(record, values)[record.scored] for record in problem.records])


def _scale(problem: Problem, values: Array) -> Array:
    """What a scaled parameter is measured in: its own value in a positive box (so, its logarithm), else the box."""
    lower = np.array([parameter.lower for parameter in problem.space.parameters])
    upper = np.array([parameter.upper for parameter in problem.space.parameters])
    return np.where((lower > 0) & (values > 0), values, upper - lower)


def _jacobian(problem: Problem, values: Array, scale: Array) -> tuple[Array, Array, Array]:
    """Jacobian in scaled parameters, an estimate of its error, and the output: (samples, d) twice, (samples,)."""
    dimension = values.size
    steps = STEP * scale
    lower = np.array([parameter.lower for parameter in problem.space.parameters])
    upper = np.array([parameter.upper for parameter in problem.space.parameters])
    # a value at its bound is moved inside by the two steps that the differences need
    inside = (lower <= values) & (values <= upper)
    centre = np.where(inside, np.clip(values, lower + 2 * steps, upper - 2 * steps), values)
    shifts = np.diag(steps)
    moved = [centre[:, None] + factor * shifts for factor in (1.0, -1.0, 2.0, -2.0)]
    swarm = outputs(problem, np.hstack([values[:, None], *moved]))
    plus, minus, plus2, minus2 = (swarm[:, 1 + k * dimension : 1 + (k + 1) * dimension] for k in range(4))
    near, far = (plus - minus) / (2 * STEP), (plus2 - minus2) / (4 * STEP)
    return near, (near - far) / 3.0, swarm[:, 0]


def _autocovariance(residuals: list[Array], correlated: bool) -> Array:
    """Of the residuals, lag 0 upwards, tapered by Bartlett's weights to the bandwidth of [1] for an AR(1)."""
    samples = sum(part.size for part in residuals)
    variance = sum(part @ part for part in residuals) / samples
    if not correlated or variance == 0.0:
        return np.array([variance])
    first = sum(part[1:] @ part[:-1] for part in residuals) / samples / variance
    persistence = 4.0 * first**2 / (1.0 - min(first**2, 0.9999)) ** 2
    longest = max(part.size for part in residuals) // 4
    bandwidth = int(np.clip(np.ceil(1.1447 * (persistence * samples) ** (1 / 3)), 1, max(1, longest)))
    lags = [
        sum(part[lag:] @ part[: max(part.size - lag, 0)] for part in residuals) / samples for lag in range(bandwidth)
    ]
    return np.array(lags) * (1.0 - np.arange(bandwidth) / bandwidth)


def _inflation(autocovariance: Array) -> float:
    """How much more a mean varies than with uncorrelated residuals."""
    if autocovariance[0] == 0.0:
        return 1.0
    return float(2.0 * autocovariance.sum() / autocovariance[0] - 1.0)


def _smoothed(columns: Array, residuals: list[Array], autocovariance: Array) -> Array:
    """columns^T R columns, R the covariance matrix of the residuals; records are independent. (r, r)"""
    parts = np.split(columns, np.cumsum([part.size for part in residuals])[:-1])
    total = np.zeros((columns.shape[1],) * 2)
    for part in parts:
        for lag, covariance in enumerate(autocovariance[: part.shape[0]]):
            product = covariance * (part[lag:].T @ part[: part.shape[0] - lag])
            total += product if lag == 0 else product + product.T
    return total
