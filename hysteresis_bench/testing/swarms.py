"""What a swarm's answer must be: its shape, finite numbers, its columns strangers, its arguments untouched."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record
from hysteresis_bench.testing.contract import expect

MANY_CORNERS = 512
"""Of a box with more corners, so many are drawn."""
ALIKE = {"rtol": 1e-9, "atol": 1e-12}
"""How far sums in another order may differ, atol as a share of the largest answer."""


def drawn(box: Sequence[Parameter], swarm: int, seed: int = 0) -> Array:
    """Values all over a box, (dimension, swarm).

    They can be written, and lie side by side, as those of a fit do: for any others kernels are compiled once more.
    """
    if not box:
        return np.empty((0, swarm))
    return Space(tuple(box)).from_unit(np.random.default_rng(seed).random((len(box), swarm)))


def corners(box: Sequence[Parameter]) -> Array:
    """The corners of a box, (dimension, corners), at most MANY_CORNERS of them."""
    edges = np.array([(one.lower, one.upper) for one in box]).reshape(-1, 2)
    if 2 ** len(box) <= MANY_CORNERS:
        return np.ascontiguousarray(np.array(list(product(*edges))).T).reshape(len(box), 2 ** len(box))
    upper = np.random.default_rng(0).random((len(box), MANY_CORNERS)) < 0.5
    return np.where(upper, edges[:, 1:], edges[:, :1])


def expect_shape(simulated: object, samples: int, swarm: int) -> None:
    """Raises Broken unless an answer is float64[samples, swarm]."""
    expect(isinstance(simulated, np.ndarray), f"it answers a {type(simulated).__name__}, no array.")
    assert isinstance(simulated, np.ndarray)
    expect(
        simulated.shape == (samples, swarm),
        f"of {samples} samples and {swarm} particles it answers the shape {simulated.shape}; "
        f"(samples, swarm) is {(samples, swarm)}.",
    )
    expect(simulated.dtype == np.float64, f"it answers {simulated.dtype}; float64 is asked.")


def expect_finite(simulated: Array, values: Array, names: Sequence[str], where: str) -> None:
    """Raises Broken for the first column with a NaN or an infinity; values : (dimension, swarm)"""
    bad = np.flatnonzero(~np.all(np.isfinite(simulated), axis=0))
    if bad.size:
        told = ", ".join(f"{name} = {value:.4g}" for name, value in zip(names, values[:, bad[0]], strict=True))
        sample = int(np.flatnonzero(~np.isfinite(simulated[:, bad[0]]))[0])
        expect(False, f"{where} it answers {simulated[sample, bad[0]]} at sample {sample} for {told}.")


def expect_strangers(system: System, record: Record, values: Array) -> None:
    """Raises Broken where a column depends on the others, or on whether its input is its own; (dimension, swarm)"""
    together = system.simulate(record.signal, values)
    scale = float(np.max(np.abs(together[np.isfinite(together)]), initial=0.0))
    for j in range(values.shape[1]):
        alone = system.simulate(record.signal, values[:, j : j + 1])
        expect(
            _alike(alone[:, 0], together[:, j], scale),
            f"particle {j} of {values.shape[1]} gets another answer than alone: "
            f"they differ by {np.max(np.abs(alone[:, 0] - together[:, j])):.2g}.",
        )
    own = record.signal.with_input(np.repeat(record.input[:, None], values.shape[1], axis=1))
    expect(
        _alike(system.simulate(own, values), together, scale),
        "an input a particle, (samples, swarm), gets another answer than the same input shared, (samples, 1).",
    )


def _alike(one: Array, other: Array, scale: float) -> bool:
    return one.shape == other.shape and np.allclose(one, other, rtol=ALIKE["rtol"], atol=ALIKE["atol"] * scale)


def expect_untouched(system: System, record: Record, values: Array) -> None:
    """Raises Broken where simulating changes what it was given, or unlocks the record's arrays, which are locked."""
    measured = [record.time, record.input, *record.columns.values()]
    given = [*measured, values]
    kept = [array.copy() for array in given]
    try:
        system.respond(record, values)
    except ValueError as error:
        unwritable = "read-only" in str(error) or "WRITEABLE" in str(error)
        expect(not unwritable, "it writes into what it was given; make an array of its own.")
        raise
    same = all(np.array_equal(*pair) for pair in zip(given, kept, strict=True))
    locked = not any(array.flags.writeable for array in measured)
    expect(same and locked, "it writes into what it was given, which the next trial would find changed.")
