"""Parameters that act only together: directions without effect, told as products of powers or as sums.

If the output does not change along a direction of parameter space, every function of the parameters that
it depends on has a gradient across that direction. In logarithms such a gradient is the exponents of a
product, and where the model's form is the reason, they are small integers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import Literal

import numpy as np

from hysteresis_bench.arrays import Array

ZERO = 1e-3
"""An entry this small beside the largest of its vector is none."""

MOST = 8
"""Parameters, or combinations of them, that a sentence tells; of more it counts the others."""


@dataclass(frozen=True)
class Combination:
    """A product of powers, or a weighted sum, of parameters on which the output depends.

    weights : exponents or factors by name
    """

    kind: Literal["product", "sum"]
    weights: tuple[tuple[str, float], ...]

    def value(self, values: Mapping[str, float]) -> float:
        """What the combination comes to; values : by name, in units."""
        if self.kind == "sum":
            return sum(weight * values[name] for name, weight in self.weights)
        product: float = prod(values[name] ** weight for name, weight in self.weights)
        return product

    def __str__(self) -> str:
        if self.kind == "sum":
            terms = [f"{'-' if w < 0 else '+'} {_factor(abs(w))}{name}" for name, w in self.weights]
            return " ".join(terms).removeprefix("+ ")
        above = " ".join(_power(name, w) for name, w in self.weights if w > 0) or "1"
        below = [_power(name, -w) for name, w in self.weights if w < 0]
        if not below:
            return above
        return f"{above} / {below[0]}" if len(below) == 1 else f"{above} / ({' '.join(below)})"


@dataclass(frozen=True)
class Blindness:
    """A group of parameters of which the output determines only some combinations.

    names : the group;  combinations : what acts on the output
    fix : parameters that, once fixed, let the others of the group be found
    """

    names: tuple[str, ...]
    combinations: tuple[Combination, ...]
    fix: tuple[str, ...]

    def __str__(self) -> str:
        if not self.combinations:
            return (
                f"{listed(self.names, MOST)} {'does' if len(self.names) == 1 else 'do'} not act on these data at all."
            )
        acting = listed([str(combination) for combination in self.combinations])
        if len(self.combinations) > MOST:
            acting = f"{len(self.combinations)} combinations of them"
        count, fix = "one" if len(self.fix) == 1 else str(len(self.fix)), listed(self.fix, MOST)
        return f"{listed(self.names, MOST)} act only through {acting}: fix {count}, for example {fix}."


def blind_groups(names: Sequence[str], values: Array, lost: Array) -> tuple[Blindness, ...]:
    """The groups of parameters that directions without effect tie together.

    values : (d,) in units;  lost : (d, k), a basis of the directions without effect, in units
    """
    if lost.shape[1] == 0:
        return ()
    size = np.where(values == 0.0, np.max(np.abs(lost), axis=1) + (values == 0.0), np.abs(values))
    vectors = sparsest((lost / size[:, None]).T)
    return tuple(_group(names, values, size, members) for members in _connected(vectors))


def sparsest(space: Array) -> Array:
    """A basis with the fewest non-zero entries of the row space of `space` (r, n); small integers where they fit."""
    basis: list[Array] = []
    for vector in circuits(space):
        if np.linalg.matrix_rank(np.array([*basis, vector]), tol=ZERO) > len(basis):
            basis.append(vector)
    return np.array(basis)


def circuits(space: Array) -> list[Array]:
    """All vectors of least support in the row space of `space` (r, n), the sparsest first.

    Such a vector vanishes on r - 1 independent columns, and these determine it: all are tried.
    """
    rank, columns = space.shape
    orthonormal = np.linalg.svd(space, full_matrices=False)[2]
    candidates = []
    for zeros in combinations(range(columns), rank - 1):
        _, singular, right = np.linalg.svd(orthonormal[:, zeros].T)
        if rank > 1 and singular[-1] < ZERO:
            continue
        candidates.append(tidy(right[-1] @ orthonormal))
    distinct = {tuple(np.nonzero(vector)[0]): vector for vector in candidates}
    return sorted(distinct.values(), key=lambda v: (np.count_nonzero(v), np.abs(v).sum(), tuple(np.nonzero(v)[0])))


def tidy(vector: Array) -> Array:
    """The vector without tiny entries, scaled to small integers where it has such a multiple."""
    return _whole(np.where(np.abs(vector) < ZERO * np.abs(vector).max(), 0.0, vector))


def listed(words: Sequence[str], most: int | None = None) -> str:
    """a, b and c; of more than `most` the others are counted."""
    if most and len(words) > most:
        words = [*words[:most], f"{len(words) - most} more"]
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _whole(vector: Array) -> Array:
    """The vector scaled to small integers where it has such a multiple, else to a median entry of 1; the first
    entry that is not 0 is positive."""
    support = vector[vector != 0.0]
    vector = vector * np.sign(support[0])
    scaled: Array = vector / np.sort(np.abs(support))[support.size // 2]
    for multiple in range(1, 7):
        whole = vector * multiple / np.min(np.abs(support))
        nearest: Array = np.round(whole)
        if np.max(np.abs(whole)) < 12 and np.max(np.abs(whole - nearest)) < 0.01:
            return nearest
    return scaled


def _connected(vectors: Array) -> list[tuple[list[int], Array]]:
    """Columns that share a vector, directly or through others, and the vectors of each such group."""
    left = list(vectors)
    groups = []
    while left:
        members, mine = set(np.nonzero(left[0])[0].tolist()), [left.pop(0)]
        while touching := [i for i, vector in enumerate(left) if members & set(np.nonzero(vector)[0].tolist())]:
            mine.append(left.pop(touching[0]))
            members |= set(np.nonzero(mine[-1])[0].tolist())
        groups.append((sorted(members), np.array(mine)))
    return groups


def _group(names: Sequence[str], values: Array, size: Array, group: tuple[list[int], Array]) -> Blindness:
    members, vectors = group[0], group[1][:, group[0]]
    group_names = tuple(names[i] for i in members)
    relative = np.where(values[members] < 0.0, -size[members], size[members])
    products = _across(vectors * np.sign(relative))  # in logarithms, where a value is not 0
    sums = np.array([_whole(product / relative) for product in products]).reshape(products.shape)
    # near one point a sum can look like a product of odd powers, and the reverse: the plainer one is told
    as_sum = np.any(values[members] == 0.0) or _plainness(sums) < _plainness(products)
    kind: Literal["product", "sum"] = "sum" if as_sum else "product"
    acting = tuple(
        Combination(kind, tuple((name, float(w)) for name, w in zip(group_names, vector, strict=True) if w != 0.0))
        for vector in (sums if as_sum else products)
    )
    return Blindness(group_names, acting, tuple(group_names[i] for i in _fixable(vectors)))


def _plainness(basis: Array) -> float:
    """Small for small integers, infinite for anything else."""
    return float(np.abs(basis).sum()) if np.all(basis == np.round(basis)) else np.inf


def _across(vectors: Array) -> Array:
    """The sparsest basis of what is orthogonal to the vectors (k, n): (n - k, n)."""
    count, columns = vectors.shape
    if count == columns:
        return np.zeros((0, columns))
    return sparsest(np.linalg.svd(vectors)[2][count:])


def _fixable(vectors: Array) -> list[int]:
    """Columns that, once fixed, leave none of the directions free; first the ones that merely scale like another."""
    pairs = [np.nonzero(v)[0] for v in circuits(vectors) if np.count_nonzero(v) == 2]
    partners = [sum(int(column in pair) for pair in pairs) for column in range(vectors.shape[1])]
    chosen: list[int] = []
    for column in sorted(range(vectors.shape[1]), key=lambda c: (-partners[c], c)):
        if np.linalg.matrix_rank(vectors[:, [*chosen, column]], tol=ZERO) > len(chosen):
            chosen.append(column)
    return sorted(chosen)


def _power(name: str, exponent: float) -> str:
    shown = f"{exponent:.3g}"
    return name if shown == "1" else f"{name}^{shown}"


def _factor(weight: float) -> str:
    shown = f"{weight:.3g}"
    return "" if shown == "1" else f"{shown} "
