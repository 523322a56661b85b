"""How fast the free-energy kernel is, and how much faster than relays of the same accuracy.

python benchmarks/free_energy.py
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from numba import njit
from table import Line, fastest, show

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.free_energy import magnetization, quadrature

SAMPLES, SWARM, ROUNDS = 2000, 48, 3
NODES, GRIDS = (16, 32, 64, 128), (40, 80, 160)
COERCIVE, SPREAD, INTERACTION = 1.0, 0.25, 0.6


@njit(error_model="numpy", fastmath={"contract", "reassoc"})
def relays(field: Array, coercive: Array, density: Array, interaction: Array, weight: Array) -> Array:
    """Equations (1) to (3) relay by relay, the inner loop vectorised: (samples,)."""
    rows, columns = coercive.size, interaction.size
    signed = np.empty((rows, columns))
    for i in range(rows):
        for j in range(columns):
            signed[i, j] = weight[j] if interaction[j] > 0.0 else -weight[j]
    magnetized = np.empty(field.size)
    for k in range(field.size):
        total = 0.0
        for i in range(rows):
            up, down = coercive[i] - field[k], -coercive[i] - field[k]
            row = 0.0
            for j in range(columns):
                value = weight[j] if interaction[j] >= up else signed[i, j]
                value = -weight[j] if interaction[j] <= down else value
                signed[i, j] = value
                row += value
            total += density[i] * row
        magnetized[k] = total
    return magnetized


def grid(rows: int, columns: int) -> tuple[Array, Array, Array, Array]:
    """H_c and its density, H_I and its density, each normalised to 1."""
    offsets = np.linspace(-3.5, 3.5, rows)
    density = np.exp(-(offsets**2))
    interaction = ((np.arange(columns) + 0.5) / columns - 0.5) * 10.0 * INTERACTION
    weight = np.exp(-(interaction**2) / (2 * INTERACTION**2))
    coercive = COERCIVE * np.exp(2 * SPREAD * (SPREAD + offsets))
    return coercive, density / density.sum(), interaction, weight / weight.sum()


def kernels() -> Iterator[tuple[str, Callable[[], Array], int, float]]:
    """(kernel, a run of it, its particle-samples, its relative RMS error against 4001 nodes)."""
    phase = np.linspace(0.0, 1.0, SAMPLES)
    field = 4.0 * np.sin(16 * np.pi * phase) * (1.0 - 0.7 * phase)
    spread = np.exp(np.random.default_rng(0).normal(0.0, 0.3, (3, SWARM)))
    swarm = np.array([[COERCIVE], [SPREAD], [INTERACTION]]) * spread
    swarm[:, 0] = COERCIVE, SPREAD, INTERACTION
    zero, one = np.zeros(SWARM), np.ones(SWARM)

    def played(nodes: int, span: float = 3.0) -> Array:
        return magnetization(field[:, None], zero, one, *swarm, *quadrature("trapezoid", nodes, span))

    exact = played(4001, 5.0)
    extent = np.ptp(exact, axis=0)
    for nodes in NODES:
        error = float(np.sqrt(np.mean(((played(nodes) - exact) / extent) ** 2)))
        yield f"free-energy, {nodes} nodes", partial(played, nodes), SAMPLES * SWARM, error
    for size in GRIDS:
        axes = grid(size, 2 * size)
        error = float(np.sqrt(np.mean((relays(field, *axes) - exact[:, 0]) ** 2)) / extent[0])
        yield f"relays, {size} x {2 * size}", partial(relays, field, *axes), SAMPLES, error


def main() -> None:
    found = {name: (run, size, error) for name, run, size, error in kernels()}
    seconds = fastest({name: run for name, (run, _, _) in found.items()}, ROUNDS)
    costs = {name: 1e9 * seconds[name] / size for name, (_, size, _) in found.items()}
    errors = {name: error for name, (_, _, error) in found.items()}
    show("free energy, and brute-force relays", "ns a particle-sample", [Line(*one) for one in costs.items()])
    show("free energy, and brute-force relays", "relative error", [Line(*one) for one in errors.items()])
    ours, relay = list(found)[: len(NODES)], list(found)[len(NODES) :]
    pairs = ((one, next((mine for mine in ours if errors[mine] <= errors[one]), None)) for one in relay)
    ratios = [Line(f"{one} / {mine}", costs[one] / costs[mine]) for one, mine in pairs if mine]
    show("relays over as good a free energy", "times the time", ratios)


if __name__ == "__main__":
    main()
